/// Checks of load cases: the load, the value, and which states are allowed.

#include "checks.hpp"
#include "deviations.hpp"
#include "maximise.hpp"

#include <fmt/ranges.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hauberk::conformance {
namespace {

constexpr int load_states = 12;
constexpr double load_rounding = 1e-12;

using Values = std::vector<double>;

void load(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  const std::size_t count = load_case.macro_count();
  bool pulls = false;
  for (const double theta : angles(trial.random, load_states)) {
    const Direction direction = Direction::at_radians(theta);
    Values t(count, std::numeric_limits<double>::quiet_NaN());
    load_case.load(direction, t);
    const double at_rest = load_case.value(direction, Values(count, 0.0));
    require(at_rest == 0.0, "the value at rest is {} at {:.4g} degrees; expected 0", at_rest, theta / degree);
    for (int draw = 0; draw < 3; ++draw) {
      const Values macro = draw_macro(load_case, trial.random, 0.3);
      for (std::size_t k = 0; k < count; ++k) {
        const Along moved = [&](double s) {
          Values at = macro;
          at[k] += s;
          return Values{load_case.value(direction, at)};
        };
        for (const Deviation& wrong : deviations(moved, {&t[k], 1}, 0.05))
          fail("the load on {} at {:.6g} degrees is not d value/d {}: {}", load_case.macros()[k].name,
               theta / degree, load_case.macros()[k].name, text_of(wrong));
        pulls = pulls || t[k] != 0.0;
      }
    }
  }
  require(pulls, "the load is zero at every angle");
}

/// The farthest admissible state along a direction, a little inside; not farther than 20.
Values far_state(const LoadCase& load_case, Random& random)
{
  const Values d = random.values(static_cast<std::size_t>(load_case.macro_count()), 1.0);
  double inside = 0.0, outside = 20.0;
  const auto at = [&](double s) {
    Values out = d;
    for (double& x : out) x *= s;
    return out;
  };
  if (load_case.admissible(at(outside))) return at(random.between(0.0, outside));
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (inside + outside);
    (load_case.admissible(at(middle)) ? inside : outside) = middle;
  }
  return at(inside * (1.0 - 1e-9));
}

void admissible(Trial& trial)
{
  constexpr int segments = 400, samples = 16;
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  const std::size_t count = load_case.macro_count();
  require(load_case.admissible(Values(count, 0.0)), "rest is not admissible");
  for (std::size_t k = 0; k < count; ++k) {
    Values macro(count, 0.0);
    macro[k] = std::nan("");
    require(!load_case.admissible(macro), "{} = not-a-number is admissible", load_case.macros()[k].name);
  }
  for (int draw = 0; draw < segments; ++draw) {
    const Values a = far_state(load_case, trial.random), b = far_state(load_case, trial.random);
    if (!load_case.admissible(a) || !load_case.admissible(b)) continue;
    for (int i = 1; i < samples; ++i) {
      Values middle(count);
      const double s = static_cast<double>(i) / samples;
      for (std::size_t k = 0; k < count; ++k) middle[k] = (1.0 - s) * a[k] + s * b[k];
      require(
          load_case.admissible(middle),
          "the admissible states are not convex: ({:.6g}) is not one, although it lies between ({:.6g}) and "
          "({:.6g})",
          fmt::join(middle, ", "), fmt::join(a, ", "), fmt::join(b, ", "));
    }
  }
}

/// Factor by which a macroscopic state lengthens a lattice translation.
double lengthening(const LoadCase& load_case, const Values& macro, const Vec3& T)
{
  const Values e(static_cast<std::size_t>(load_case.coordinate_count()), 0.0);
  PositionMap image, itself;
  load_case.position(macro, e, Vec3::Zero(), T, image);
  load_case.position(macro, e, Vec3::Zero(), Vec3::Zero(), itself);
  return (image.x - itself.x).norm() / T.norm();
}

void require_stretch(const LoadCase& load_case, const Values& macro, const Vec3& T)
{
  const auto [smallest, largest] = load_case.stretch_range(macro);
  const double factor = lengthening(load_case, macro, T);
  require(factor >= smallest * (1.0 - load_rounding) && factor <= largest * (1.0 + load_rounding),
          "a lattice translation is lengthened by {:.9g}, outside the range of stretch [{:.9g}, {:.9g}]",
          factor, smallest, largest);
}

/// The two parts of what a search changes; components in which the translation is 0 stay so.
std::pair<Values, Vec3> macro_and_translation(const Values& x, const Vec3& like)
{
  Vec3 T = like;
  for (std::size_t k = 0; k < 3; ++k) {
    if (T[k] != 0.0) T[k] = x[x.size() - 3 + k];
  }
  return {Values(x.begin(), x.end() - 3), T};
}

void stretch_range(Trial& trial)
{
  constexpr int searches = 8, sweeps = 40;
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  const auto at_rest =
      load_case.stretch_range(Values(static_cast<std::size_t>(load_case.macro_count()), 0.0));
  require(std::abs(at_rest.first - 1.0) <= load_rounding && std::abs(at_rest.second - 1.0) <= load_rounding,
          "at rest the range of stretch is [{}, {}]; expected [1, 1]", at_rest.first, at_rest.second);
  for (int draw = 0; draw < 8 * load_states; ++draw) {
    const Values macro = draw_macro(load_case, trial.random, 0.9);
    const auto [smallest, largest] = load_case.stretch_range(macro);
    require(smallest > 0.0 && smallest <= largest && std::isfinite(largest),
            "the range of stretch is [{}, {}] at an admissible state", smallest, largest);
    if (!load_case.periodic()) continue;
    const Vec3 T = draw_translation(load_case, trial.random);
    require_stretch(load_case, macro, T);
    if (draw >= searches) continue;
    const auto farthest_out = [&](const Values& x) {
      const auto [at, along] = macro_and_translation(x, T);
      if (!load_case.admissible(at) || along.norm() < 1e-3) return -std::numeric_limits<double>::infinity();
      const auto [least, most] = load_case.stretch_range(at);
      const double factor = lengthening(load_case, at, along);
      return std::max(factor / most, least / factor);
    };
    Values start = macro;
    start.insert(start.end(), T.begin(), T.end());
    const auto [worst, along] =
        macro_and_translation(maximise(farthest_out, start, Values(start.size(), 0.3), sweeps), T);
    require_stretch(load_case, worst, along);
  }
}

void boundedness(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  Random& random = trial.random;
  const std::size_t count = load_case.macro_count();
  std::vector<Values> loads;
  for (const double theta : angles(random, load_states)) {
    Values t(count);
    load_case.load(Direction::at_radians(theta), t);
    loads.push_back(t);
    loads.push_back(random.values(count, 1.0));
  }
  for (Values load : loads) {
    std::vector<Vec3> cycles;
    for (int given = 0; given <= 3; ++given) {
      const auto ask = [&] { return load_case.boundedness(load, cycles); };
      const Boundedness answer = ask();
      const auto unchanged = [&](const char* change) {
        require(ask() == answer, "with {} link cycles, {} changes whether the load is bounded", given,
                change);
      };
      for (double& t : load) t *= 3.0;
      unchanged("three times the load");
      std::reverse(cycles.begin(), cycles.end());
      unchanged("another order of the cycles");
      for (Vec3& T : cycles) T = -T;
      unchanged("the other sense of the cycles");
      const std::vector<Vec3> before = cycles;
      cycles.insert(cycles.begin(), Vec3::Zero());
      unchanged("a cycle that closes without a translation");
      cycles = before;
      if (given > 0) cycles.push_back(2.0 * cycles.front());
      unchanged("a cycle that is twice another one");
      cycles = before;
      cycles.push_back(draw_translation(load_case, random));
    }
  }
}

/// Turns and mirrors about the axes, some of any angle in the plane, and any turn in space.
std::vector<Mat3> isometries(Random& random)
{
  std::vector<Mat3> out;
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      for (const double z : {1.0, -1.0}) {
        const Mat3 signs = Vec3(x, y, z).asDiagonal();
        Mat3 swapped = signs;
        swapped.col(0).swap(swapped.col(1));
        out.push_back(signs);
        out.push_back(swapped);
        out.emplace_back(rotation_exp(Vec3(0.0, 0.0, random.between(-3.0, 3.0))) * signs);
      }
    }
  }
  out.push_back(rotation_exp(random.vector(1.5)));
  return out;
}

/// How far an element at X in the image at T stays from x when its coordinates are chosen best.
double distance_from(const LoadCase& load_case, const Values& macro, const Vec3& X, const Vec3& T,
                     const Vec3& x)
{
  const auto count = static_cast<Eigen::Index>(load_case.coordinate_count());
  Eigen::VectorXd e = Eigen::VectorXd::Zero(count);
  PositionMap map;
  constexpr int steps = 20;  // of Gauss-Newton; one would do for affine load cases
  for (int k = 0; k < steps && count > 0; ++k) {
    load_case.position(macro, {e.data(), static_cast<std::size_t>(count)}, X, T, map);
    const Eigen::Matrix<double, 3, Eigen::Dynamic> J = map.J.middleCols(load_case.macro_count(), count);
    e += J.colPivHouseholderQr().solve(x - map.x);
  }
  load_case.position(macro, {e.data(), static_cast<std::size_t>(count)}, X, T, map);
  return (map.x - x).norm();
}

/// Isometries that a load case claims move all its states.
void transform(Trial& trial)
{
  const Object object = trial.make();
  const LoadCase& load_case = *object.load_case;
  const std::size_t count = load_case.macro_count();
  Values metric(count);
  load_case.metric(metric);
  const auto squared = [&metric](const Values& macro) {
    double sum = 0.0;
    for (std::size_t k = 0; k < macro.size(); ++k) sum += metric[k] * macro[k] * macro[k];
    return sum;
  };
  constexpr double exact = 1e-9;
  for (const Mat3& O : isometries(trial.random)) {
    const Values macro = draw_macro(load_case, trial.random, 0.3);
    Values moved(count), twice(count), doubled = macro;
    for (double& x : doubled) x *= 2.0;
    if (!load_case.transform(O, macro, moved)) continue;
    require(load_case.transform(O, doubled, twice), "it transforms some macroscopic states and not others");
    for (std::size_t k = 0; k < count; ++k)
      require(std::abs(twice[k] - 2.0 * moved[k]) <= load_rounding, "its transformation is not linear");
    require(std::abs(squared(moved) - squared(macro)) <= exact * (1.0 + squared(macro)),
            "an isometry changes the square of the metric's norm from {:.9g} to {:.9g}", squared(macro),
            squared(moved));
    const Values e = trial.random.values(static_cast<std::size_t>(load_case.coordinate_count()), 0.2);
    const Vec3 X = trial.random.vector(2.0), T = draw_translation(load_case, trial.random);
    PositionMap before;
    load_case.position(macro, e, X, T, before);
    const double off = distance_from(load_case, moved, O * X, O * T, O * before.x);
    require(off <= exact * (1.0 + before.x.norm()),
            "an isometry that it claims leaves an element {:.3g} from where it belongs", off);
    // Both images of an element have its coordinates.
    PositionMap itself;
    load_case.position(macro, e, X, Vec3::Zero(), itself);
    PositionMap image, base;
    const Values none(e.size(), 0.0);
    load_case.position(moved, none, O * X, O * T, image);
    load_case.position(moved, none, O * X, Vec3::Zero(), base);
    if (!load_case.periodic()) continue;
    const double slip = ((image.x - base.x) - O * (before.x - itself.x)).norm();
    require(slip <= exact * (1.0 + before.x.norm()),
            "an isometry that it claims moves a lattice translation {:.3g} away", slip);
  }
}

}  // namespace

void add_load_case_load_checks(std::vector<Check>& out)
{
  const auto add = [&](const char* name, const char* about, void (*function)(Trial&)) {
    out.push_back(of_trial(name, PluginKind::load_case, about, function));
  };
  add("load_case.load", "the load is dual to the value: t = d value/d macro, and the value is 0 at rest",
      load);
  add("load_case.admissible", "rest is admissible, not-a-number is not, and the set is convex", admissible);
  add("load_case.stretch_range", "lattice translations are lengthened by factors within stretch_range",
      stretch_range);
  add("load_case.boundedness", "boundedness depends on the direction of the load and the span of cycles only",
      boundedness);
  add("load_case.transform", "isometries that it claims turn its states as they turn the places of elements",
      transform);
}

}  // namespace hauberk::conformance
