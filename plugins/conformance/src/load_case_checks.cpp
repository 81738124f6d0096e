/// Checks of load cases: what they declare, how they move things.

#include "checks.hpp"
#include "deviations.hpp"
#include "maximise.hpp"
#include "trace.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <set>
#include <vector>

namespace hauberk::conformance {
namespace {

constexpr int states = 12;
constexpr double rounding = 1e-12;
constexpr double step = 0.05;  ///< largest, of differences

using Values = std::vector<double>;

/// Arguments of position, in one vector of unknowns (macro, e).
struct State {
  Values y;
  std::size_t macros;
  Vec3 X, T;

  PositionMap of(const LoadCase& load_case, const Values& at) const
  {
    PositionMap map;
    const std::span<const double> all(at);
    load_case.position(all.first(macros), all.subspan(macros), X, T, map);
    return map;
  }
  Values moved(std::size_t k, double s) const
  {
    Values out = y;
    out[k] += s;
    return out;
  }
};

State draw_state(const LoadCase& load_case, Random& random)
{
  State state;
  state.macros = static_cast<std::size_t>(load_case.macro_count());
  const auto movable = [&] {
    for (std::size_t k = 0; k < state.macros; ++k) {
      for (const double s : {-step, step}) {
        if (!load_case.admissible(std::span<const double>(state.moved(k, s)).first(state.macros)))
          return false;
      }
    }
    return true;
  };
  for (int draw = 0; draw < 100; ++draw) {
    state.y = draw_macro(load_case, random, 0.3);
    if (movable()) break;
  }
  const Values e = random.values(static_cast<std::size_t>(load_case.coordinate_count()), 0.5);
  state.y.insert(state.y.end(), e.begin(), e.end());
  state.X = random.vector(2.0);
  state.T = draw_translation(load_case, random);
  return state;
}

std::vector<Vec3> draw_positions(Eigen::Index elements, Random& random)
{
  std::vector<Vec3> X;
  for (Eigen::Index i = 0; i < elements; ++i) X.push_back(random.vector(3.0));
  return X;
}

/// Coefficients of the equalities among the coordinates of elements at X, one row each.
Eigen::MatrixXd equality_rows(const LoadCase& load_case, std::span<const Vec3> X,
                              std::span<const LinearEquality> held)
{
  const Eigen::Index coordinates = load_case.coordinate_count();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(held.size()),
                                               static_cast<Eigen::Index>(X.size()) * coordinates);
  for (std::size_t i = 0; i < held.size(); ++i) {
    for (const LinearTerm& t : held[i].terms) {
      require(t.element >= 0 && t.element < static_cast<int>(X.size()) && t.coordinate >= 0 &&
                  t.coordinate < coordinates,
              "'{}' has a term for element {} of {}, coordinate {} of {}", held[i].name, t.element, X.size(),
              t.coordinate, coordinates);
      rows(static_cast<Eigen::Index>(i), t.element * coordinates + t.coordinate) += t.coefficient;
    }
  }
  return rows;
}

void unknowns(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  const int macros = load_case.macro_count(), coordinates = load_case.coordinate_count();
  require(macros >= 1 && macros <= max_macro, "{} macroscopic unknowns; expected 1 to {}", macros, max_macro);
  require(coordinates >= 0 && coordinates <= max_coordinates,
          "{} coordinates of an element; expected 0 to {}", coordinates, max_coordinates);
  std::set<std::string> names;
  for (const MacroInfo& macro : load_case.macros()) {
    require(!macro.name.empty(), "a macroscopic unknown has no name");
    require(names.insert(macro.name).second, "there are two unknowns '{}'", macro.name);
  }
  require(!load_case.measure().empty(), "its measure has no name");
  const auto [positive, negative] = load_case.sense_names();
  require(!positive.empty() && !negative.empty() && positive != negative,
          "its senses are '{}' and '{}'; expected two names", positive, negative);
  Values m(static_cast<std::size_t>(macros));
  load_case.metric(m);
  for (std::size_t k = 0; k < m.size(); ++k)
    require(m[k] > 0.0 && std::isfinite(m[k]), "the metric of '{}' is {}; expected a positive number",
            load_case.macros()[k].name, m[k]);
}

void rest(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  for (int draw = 0; draw < states; ++draw) {
    State state = draw_state(load_case, trial.random);
    std::fill(state.y.begin(), state.y.end(), 0.0);
    const Vec3 x = state.of(load_case, state.y).x, expected = state.X + state.T;
    require((x - expected).norm() <= rounding * (1.0 + expected.norm()),
            "at rest the element at ({}, {}, {}) is at ({}, {}, {})", expected.x(), expected.y(),
            expected.z(), x.x(), x.y(), x.z());
  }
}

std::string unknown_name(const LoadCase& load_case, std::size_t k)
{
  const std::size_t macros = load_case.macro_count();
  return k < macros ? load_case.macros()[k].name : fmt::format("e[{}]", k - macros);
}

void first_derivatives(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  for (int draw = 0; draw < states; ++draw) {
    const State state = draw_state(load_case, trial.random);
    const PositionMap here = state.of(load_case, state.y);
    for (std::size_t k = 0; k < state.y.size(); ++k) {
      const Vec3 column = here.J.col(k);
      const Along moved = [&](double s) {
        const Vec3 x = state.of(load_case, state.moved(k, s)).x;
        return Values(x.begin(), x.end());
      };
      for (const Deviation& wrong : deviations(moved, {column.data(), 3}, step))
        fail("d {}/d {}: {}", "xyz"[wrong.component], unknown_name(load_case, k), text_of(wrong));
    }
    for (auto k = static_cast<Eigen::Index>(state.y.size()); k < PositionMap::n; ++k)
      require(here.J.col(k).isZero(0.0), "column {} of J belongs to no unknown and is not zero", k);
  }
}

void second_derivatives(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  for (int draw = 0; draw < states; ++draw) {
    const State state = draw_state(load_case, trial.random);
    const PositionMap here = state.of(load_case, state.y);
    const std::size_t n = state.y.size();
    for (std::size_t k = 0; k < n; ++k) {
      Values claimed(3 * n, 0.0);
      for (std::size_t i = 0; here.curved && i < 3 * n; ++i) claimed[i] = here.H[i % 3][i / 3][k];
      const Along moved = [&](double s) {
        const PositionMap map = state.of(load_case, state.moved(k, s));
        return Values(map.J.data(), map.J.data() + 3 * n);
      };
      for (const Deviation& wrong : deviations(moved, claimed, step))
        fail("d2 {}/d {} d {}{}: {}", "xyz"[wrong.component % 3],
             unknown_name(load_case, wrong.component / 3), unknown_name(load_case, k),
             here.curved ? "" : " (not curved, it says)", text_of(wrong));
    }
  }
}

/// What bends repeats along one vector at most, and the unknowns displace its images linearly: second
/// derivatives of an element and its image agree.
void require_linear_images(const LoadCase& load_case, const State& state)
{
  require(load_case.lattice_vectors() == 1, "it bends and has {} lattice vectors; expected none or one",
          load_case.lattice_vectors());
  State itself = state;
  itself.T.setZero();
  const PositionMap image = state.of(load_case, state.y), there = itself.of(load_case, state.y);
  const auto second = [](const PositionMap& map, std::size_t c, std::size_t a, std::size_t b) {
    return map.curved ? map.H[c][a][b] : 0.0;
  };
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t a = 0; a < state.y.size(); ++a) {
      for (std::size_t b = 0; b < state.y.size(); ++b) {
        const double here = second(image, c, a, b), other = second(there, c, a, b);
        require(
            std::abs(here - other) <= rounding * (1.0 + std::abs(other)),
            "it bends, and its images are not displaced linearly: d2 {}/d {} d {} is {:.6g} of an image and "
            "{:.6g} of the element",
            "xyz"[c], unknown_name(load_case, a), unknown_name(load_case, b), here, other);
      }
    }
  }
}

/// Images are displaced by D(macro, T), which is additive in T and the same for every element.
void images(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  if (!load_case.periodic()) skip("it is not periodic");
  for (int draw = 0; draw < states; ++draw) {
    const State state = draw_state(load_case, trial.random), other = draw_state(load_case, trial.random);
    const std::span<const double> macro = std::span<const double>(state.y).first(state.macros);
    const auto displaced = [&](const State& element, const Vec3& T) {
      const std::span<const double> e = std::span<const double>(element.y).subspan(element.macros);
      PositionMap image, itself;
      load_case.position(macro, e, element.X, T, image);
      load_case.position(macro, e, element.X, Vec3::Zero(), itself);
      return Vec3(image.x - itself.x);
    };
    const auto same = [](const Vec3& a, const Vec3& b) {
      return (a - b).norm() <= rounding * (1.0 + a.norm() + b.norm());
    };
    if (load_case.bends()) require_linear_images(load_case, state);
    const Vec3 T = state.T, U = other.T;
    const Vec3 D = displaced(state, T);
    require(same(D, displaced(other, T)),
            "the image by one translation is displaced by {:.6g} for one element and {:.6g} for another",
            D.norm(), displaced(other, T).norm());
    require(same(displaced(state, T + U), D + displaced(state, U)),
            "an image of an image is not the image by the sum of both translations: displaced by {:.6g} and "
            "{:.6g}",
            displaced(state, T + U).norm(), (D + displaced(state, U)).norm());
  }
}

/// A path between two states, its acceleration and the bound of it.
struct Path {
  static constexpr double h = 1e-4;  ///< of central differences

  State from;
  Values d;
  double s;

  double bound(const LoadCase& load_case) const
  {
    const std::span<const double> y(from.y), dy(d);
    return load_case.acceleration_bound(y.first(from.macros), dy.first(from.macros), y.subspan(from.macros),
                                        dy.subspan(from.macros), from.X, from.T);
  }
  Vec3 velocity(const LoadCase& load_case, double at) const
  {
    Values y = from.y;
    for (std::size_t k = 0; k < d.size(); ++k) y[k] += at * d[k];
    const PositionMap map = from.of(load_case, y);
    Vec3 v = Vec3::Zero();
    for (std::size_t k = 0; k < d.size(); ++k) v += map.J.col(k) * d[k];
    return v;
  }
  double acceleration(const LoadCase& load_case) const
  {
    return ((velocity(load_case, s + h) - velocity(load_case, s - h)) / (2.0 * h)).norm();
  }
  /// Everything that a search may change: the states, the element and its image, the place on the path.
  Values unknowns() const
  {
    Values out = from.y;
    out.insert(out.end(), d.begin(), d.end());
    out.insert(out.end(), from.X.begin(), from.X.end());
    out.insert(out.end(), from.T.begin(), from.T.end());
    out.push_back(s);
    return out;
  }
  Path with(const Values& x) const
  {
    const auto n = static_cast<std::ptrdiff_t>(d.size());
    Path path = *this;
    path.from.y.assign(x.begin(), x.begin() + n);
    path.d.assign(x.begin() + n, x.begin() + 2 * n);
    for (std::ptrdiff_t k = 0; k < 3; ++k) {
      path.from.X[k] = x[static_cast<std::size_t>(2 * n + k)];
      if (from.T[k] != 0.0) path.from.T[k] = x[static_cast<std::size_t>(2 * n + 3 + k)];
    }
    path.s = std::clamp(x.back(), h, 1.0 - h);
    return path;
  }
  /// Both ends are admissible, and nothing is farther than elements of a cell are.
  bool is_sensible(const LoadCase& load_case) const
  {
    constexpr double farthest = 4.0;
    Values end = from.y;
    for (std::size_t k = 0; k < d.size(); ++k) end[k] += d[k];
    const std::span<const double> a(from.y), b(end);
    const auto size = [](const Values& v) {
      double most = 0.0;
      for (const double x : v) most = std::max(most, std::abs(x));
      return most;
    };
    return load_case.admissible(a.first(from.macros)) && load_case.admissible(b.first(from.macros)) &&
           std::max({size(from.y), size(end), from.X.norm(), from.T.norm()}) <= farthest;
  }
};

void acceleration(Trial& trial)
{
  constexpr int samples = 64, searches = 6, sweeps = 40;
  constexpr double tolerance = 1e-6;
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  const auto require_bound = [&](const Path& path) {
    const double bound = path.bound(load_case), found = path.acceleration(load_case);
    require(std::isfinite(bound) && bound >= 0.0, "the bound of the acceleration is {}", bound);
    require(found <= bound + tolerance * (1.0 + found),
            "|x''| is {:.9g} at s = {:.4g} of a path whose bound is {:.9g}", found, path.s, bound);
  };
  for (int draw = 0; draw < 4 * states; ++draw) {
    const State from = draw_state(load_case, trial.random), to = draw_state(load_case, trial.random);
    Path path{from, Values(from.y.size()), 0.0};
    for (std::size_t k = 0; k < path.d.size(); ++k) path.d[k] = to.y[k] - from.y[k];
    for (int i = 0; i <= samples; ++i) {
      path.s = static_cast<double>(i) / samples;
      require_bound(path);
    }
    if (draw >= searches) continue;
    path.s = trial.random.between(0.2, 0.8);
    const auto excess = [&](const Values& x) {
      const Path at = path.with(x);
      if (!at.is_sensible(load_case)) return -std::numeric_limits<double>::infinity();
      return at.acceleration(load_case) / (at.bound(load_case) + tolerance);
    };
    const Values start = path.unknowns();
    require_bound(path.with(maximise(excess, start, Values(start.size(), 0.2), sweeps)));
  }
}

/// What a scene of another length makes of the same file. Lengths of states are in units of the file: an
/// unknown of power p is `length`^-p times as large there, places of elements are 1/`length` of theirs.
struct Rescaled {
  const LoadCase& load_case;
  double length;

  Values macro(const Values& of_file, const std::vector<MacroInfo>& infos) const
  {
    Values out = of_file;
    for (std::size_t k = 0; k < out.size(); ++k) out[k] *= std::pow(length, -infos[k].length_power);
    return out;
  }
  Vec3 position(const Values& scaled, const Vec3& X, const Vec3& T) const
  {
    const Values e(static_cast<std::size_t>(load_case.coordinate_count()), 0.0);
    PositionMap map;
    load_case.position(scaled, e, X / length, T / length, map);
    return length * map.x;
  }
};

/// The power p with which `of(p)` is the same in both scenes, for people.
std::string power_that_fits(const std::function<bool(int)>& same)
{
  for (int p = -4; p <= 4; ++p) {
    if (same(p)) return fmt::format("{} would agree", p);
  }
  return "no power would agree";
}

void length_powers(Trial& trial)
{
  constexpr double length = 2.0, exact = 1e-9;
  Problems problems;
  const Object one = trial.make(), two = trial.make(trial.section.values, problems, length);
  if (!two.load_case) skip("it refuses its section in a scene of another length");
  const LoadCase& load_case = *one.load_case;
  const Rescaled here{load_case, 1.0}, there{*two.load_case, length};
  const std::vector<MacroInfo>& infos = load_case.macros();
  const int power = load_case.value_length_power();
  for (int draw = 0; draw < states; ++draw) {
    const Values drawn = draw_macro(load_case, trial.random, 0.2);
    const Vec3 X = trial.random.vector(2.0), T = draw_translation(load_case, trial.random);
    const Direction direction = Direction::at_radians(trial.random.between(0.0, 3.0));
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      Values macro(drawn.size(), 0.0);
      macro[k] = drawn[k];
      const Values scaled = there.macro(macro, infos);
      if (!load_case.admissible(macro) || !two.load_case->admissible(scaled)) continue;
      const Vec3 x = here.position(macro, X, T);
      const auto fits = [&](int p) {
        Values other = macro;
        other[k] *= std::pow(length, -p);
        return (there.position(other, X, T) - x).norm() <= exact * (1.0 + x.norm());
      };
      require(fits(infos[k].length_power),
              "in a scene of another length, '{}' moves elements otherwise: its length_power is {}; {}",
              infos[k].name, infos[k].length_power, power_that_fits(fits));
      const double value = load_case.value(direction, macro), other = two.load_case->value(direction, scaled);
      const auto value_fits = [&](int p) {
        return std::abs(std::pow(length, p) * other - value) <= exact * (1e-3 + std::abs(value));
      };
      require(value_fits(power),
              "in a scene of another length, a state of '{}' has another value: value_length_power is {}; {}",
              infos[k].name, power, power_that_fits(value_fits));
    }
  }
}

void walls(Trial& trial)
{
  constexpr int elements = 5;
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  const std::vector<Vec3> X = draw_positions(elements, trial.random);
  const auto in_range = [&](const std::string& name, const std::vector<LinearTerm>& terms) {
    require(!name.empty(), "a wall or condition has no name");
    require(!terms.empty(), "'{}' has no terms", name);
    for (const LinearTerm& t : terms) {
      require(t.element >= 0 && t.element < elements && t.coordinate >= 0 &&
                  t.coordinate < load_case.coordinate_count() && std::isfinite(t.coefficient),
              "'{}' has a term for element {} of {}, coordinate {} of {}, coefficient {}", name, t.element,
              elements, t.coordinate, load_case.coordinate_count(), t.coefficient);
    }
  };
  for (const LinearInequality& wall : load_case.inequalities(X)) {
    in_range(wall.name, wall.terms);
    require(wall.offset >= 0.0 && std::isfinite(wall.offset), "the wall '{}' is violated at rest, by {}",
            wall.name, -wall.offset);
  }
  const std::vector<LinearEquality> held = load_case.equalities(X);
  if (held.empty()) return;
  for (const LinearEquality& condition : held) in_range(condition.name, condition.terms);
  const Eigen::MatrixXd rows = equality_rows(load_case, X, held);
  const auto rank = Eigen::FullPivLU<Eigen::MatrixXd>(rows).rank();
  require(rank == rows.rows(), "of {} conditions only {} are independent", held.size(), rank);
}

/// Coordinates with which `load_case` has the element at `x`, found by Gauss-Newton steps from zero.
Values coordinates_at(const LoadCase& load_case, const State& like, std::span<const double> macro,
                      const Vec3& x)
{
  constexpr int most_steps = 20;
  State at = like;
  at.y.assign(macro.begin(), macro.end());
  at.y.resize(at.macros + static_cast<std::size_t>(load_case.coordinate_count()), 0.0);
  for (int k = 0; k < most_steps; ++k) {
    const PositionMap map = at.of(load_case, at.y);
    const Eigen::MatrixXd J =
        map.J.middleCols(static_cast<Eigen::Index>(at.macros), load_case.coordinate_count());
    if (J.cols() == 0) break;
    const Eigen::VectorXd d = J.completeOrthogonalDecomposition().solve(x - map.x);
    for (Eigen::Index c = 0; c < d.size(); ++c) at.y[at.macros + static_cast<std::size_t>(c)] += d[c];
  }
  return at.y;
}

/// Largest violation of walls by one element with these coordinates; 0 or less: none.
double beyond_walls(const LoadCase& load_case, const Vec3& X, std::span<const double> e)
{
  double most = -std::numeric_limits<double>::infinity();
  for (const LinearInequality& wall : load_case.inequalities({&X, 1})) {
    double g = wall.offset;
    for (const LinearTerm& t : wall.terms) g += t.coefficient * e[t.coordinate];
    most = std::max(most, -g);
  }
  return most;
}

/// What a stricter load case allows, the one that names it allows, too, with the same value; and it holds
/// whatever that one holds.
void require_contained(const LoadCase& load_case, const StricterLoadCase& less, Random& random)
{
  require(!less.name.empty(), "a stricter load case has no name");
  require(less.load != nullptr, "'{}' is no load case", less.name);
  require(load_case.contains(*less.load), "it does not contain '{}', which it calls stricter", less.name);
  require(!less.load->contains(load_case), "'{}' is called stricter, and contains it", less.name);
  require(less.load->macro_count() == load_case.macro_count(),
          "'{}' has {} macroscopic unknowns instead of {}", less.name, less.load->macro_count(),
          load_case.macro_count());
  for (int draw = 0; draw < states; ++draw) {
    State state = draw_state(*less.load, random);
    const auto macro = std::span<const double>(state.y).first(state.macros);
    const auto e = std::span<double>(state.y).subspan(state.macros);
    // Just inside its walls, if there are any: what is allowed there is what another one may forbid.
    const Values drawn(e.begin(), e.end());
    const auto scaled_by = [&](double factor) {
      for (std::size_t c = 0; c < e.size(); ++c) e[c] = factor * drawn[c];
      return beyond_walls(*less.load, state.X, e);
    };
    double reach = 1.0;
    while (reach < 1e3 && scaled_by(reach) <= 0.0) reach *= 1.5;
    if (reach >= 1e3) reach = 1.0;
    while (scaled_by(reach) > 0.0 && reach > 1e-12) reach /= 1.5;
    const Vec3 x = state.of(*less.load, state.y).x;
    const Values y = coordinates_at(load_case, state, macro, x);
    const double off = (state.of(load_case, y).x - x).norm();
    require(off <= 1e-9 * (1.0 + x.norm()), "a state of '{}' is {:.3g} from any that it has", less.name, off);
    const double beyond = beyond_walls(load_case, state.X, std::span<const double>(y).subspan(state.macros));
    require(beyond <= rounding, "a state of '{}' is {:.3g} beyond its walls", less.name, beyond);
    const Direction direction = Direction::at_radians(random.between(-3.0, 3.0));
    const double own = load_case.value(direction, macro), other = less.load->value(direction, macro);
    require(std::abs(own - other) <= rounding * (1.0 + std::abs(own)),
            "the value of a state of '{}' is {:.9g} there and {:.9g} here", less.name, other, own);
    const auto rows = [&](const LoadCase& of) {
      const std::vector<MacroCondition> held = of.conditions(direction);
      Eigen::MatrixXd m(static_cast<Eigen::Index>(state.macros), static_cast<Eigen::Index>(held.size()));
      for (std::size_t k = 0; k < held.size(); ++k) {
        for (std::size_t i = 0; i < state.macros; ++i)
          m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = held[k].coefficients[i];
      }
      return m;
    };
    const Eigen::MatrixXd here = rows(load_case), there = rows(*less.load);
    Eigen::MatrixXd both(here.rows(), here.cols() + there.cols());
    both << here, there;
    require(both.cols() == 0 || Eigen::FullPivLU<Eigen::MatrixXd>(both).rank() ==
                                    (there.cols() == 0 ? 0 : Eigen::FullPivLU<Eigen::MatrixXd>(there).rank()),
            "'{}' does not hold what it holds", less.name);
  }
}

/// What moves several elements by the equalities of a stricter load case moves them by those of the one that
/// names it: both say which motions of all elements together are drifts.
void require_equalities_kept(const LoadCase& load_case, const StricterLoadCase& less, Random& random)
{
  constexpr Eigen::Index elements = 12;  // more than what load cases hold of one coordinate
  const Eigen::Index coordinates = less.load->coordinate_count(), own = load_case.coordinate_count();
  State state = draw_state(*less.load, random);
  const auto macro = std::span<const double>(state.y).first(state.macros);
  std::vector<Vec3> X = draw_positions(elements, random);
  for (Vec3& x : X) x.z() *= 0.1;  // far from where a bent sheet's normals meet
  const std::vector<LinearEquality> held = load_case.equalities(X);
  if (held.empty()) return;
  // Small motions: walls are the other check's.
  Eigen::VectorXd e(elements * coordinates);
  for (double& c : e) c = random.between(-1e-2, 1e-2);
  const Eigen::MatrixXd there = equality_rows(*less.load, X, less.load->equalities(X));
  if (there.rows() > 0) e -= there.completeOrthogonalDecomposition().solve(there * e);
  Eigen::VectorXd here(elements * own);
  for (Eigen::Index i = 0; i < elements; ++i) {
    State at = state;
    at.X = X[static_cast<std::size_t>(i)];
    at.T.setZero();
    at.y.resize(at.macros);
    at.y.insert(at.y.end(), e.data() + i * coordinates, e.data() + (i + 1) * coordinates);
    const Vec3 x = at.of(*less.load, at.y).x;
    const Values y = coordinates_at(load_case, at, macro, x);
    if ((at.of(load_case, y).x - x).norm() > 1e-12 * (1.0 + x.norm())) return;
    std::copy(y.begin() + static_cast<std::ptrdiff_t>(at.macros), y.end(), here.data() + i * own);
  }
  const Eigen::MatrixXd rows = equality_rows(load_case, X, held);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double off = std::abs(rows.row(i).dot(here));
    require(off <= 1e-9 * (1.0 + rows.row(i).norm()), "a state of '{}' is off the condition '{}' by {:.3g}",
            less.name, held[static_cast<std::size_t>(i)].name, off);
  }
}

void stricter(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  require(load_case.contains(load_case), "it does not contain itself");
  const std::vector<StricterLoadCase> all = load_case.stricter();
  if (all.empty()) skip("it names no stricter load case");
  for (const StricterLoadCase& less : all) {
    require_contained(load_case, less, trial.random);
    for (int draw = 0; draw < states; ++draw) require_equalities_kept(load_case, less, trial.random);
    for (const StricterLoadCase& least : less.load->stricter())
      require(least.load != nullptr && load_case.contains(*least.load), "it does not contain '{}' with '{}'",
              less.name, least.name);
  }
}

/// Lengths in the section are in file units and come with the scene's length: only their ratio counts.
void scaling(Trial& trial)
{
  Object object = trial.make();
  const Exercise exercise(object, trial);
  const Values before = exercise(object);
  Node values = trial.section.values;
  scale_lengths(values, trial.section.fields, 4.0);
  Problems problems;
  object = trial.make(values, problems, 4.0);
  if (!object.load_case) skip("it refuses its section with lengths times 4");
  const Values after = exercise(object);
  require(after.size() == before.size(), "{} answers, and {} for a file in another unit", before.size(),
          after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    require(std::abs(after[i] - before[i]) <= rounding * (1.0 + std::abs(before[i])),
            "in another unit of length, answer {} of {} is {:.12g} instead of {:.12g}", i + 1, before.size(),
            after[i], before[i]);
}

}  // namespace

void add_load_case_motion_checks(std::vector<Check>& out)
{
  const auto add = [&](const char* name, const char* about, void (*function)(Trial&)) {
    out.push_back(of_trial(name, PluginKind::load_case, about, function));
  };
  add("load_case.unknowns", "unknowns, measure and senses have names; the metric is positive", unknowns);
  add("load_case.rest", "at rest an element is at X + T", rest);
  add("load_case.first_derivatives", "J is the derivative of x: differences approach it with slope 2",
      first_derivatives);
  add("load_case.second_derivatives", "H is the derivative of J, and zero where it says it is not curved",
      second_derivatives);
  add("load_case.images", "an image of an image is an image; all elements are displaced alike", images);
  add("load_case.acceleration", "acceleration_bound bounds |x''| along every path", acceleration);
  add("load_case.length_powers",
      "the powers of length of unknowns and value are those by which scenes of two lengths differ",
      length_powers);
  add("load_case.walls", "walls hold at rest; conditions are independent; terms refer to what exists", walls);
  add("load_case.stricter", "states of stricter load cases are states of this one, with the same value",
      stricter);
  add("load_case.scaling", "only lengths relative to the scene's length count", scaling);
}

}  // namespace hauberk::conformance
