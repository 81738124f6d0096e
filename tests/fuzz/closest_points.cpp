/// Closest points of two tori, however degenerate: bounds that hold, minima that are ones, steps that collide
/// with nothing, in bounded work. What is compared with is sampled by code of the tests' own
/// (accuracy/torus.hpp).

#include <scenes.hpp>
#include "contact/formulation.hpp"
#include "contact/published.hpp"
#include "geometry/separation.hpp"
#include "harness.hpp"
#include "motion/advancement.hpp"
#include "pair_input.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace hauberk::fuzz {
namespace {

using std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();
/// Closest-point evaluations that one question may cost: about a second.
constexpr long most_evaluations = 2100000;
/// Families of equally near points, of coaxial flat tubes for instance, are searched point by point.
constexpr int most_in_families = 21000000;
/// Part of the gap that a step must leave, as the solver asks for.
constexpr double keep = 0.1;

void require(bool holds, const PairInput& input, const std::string& what)
{
  if (holds) return;
  std::fprintf(stderr, "closest_points: %s\n%s\n", what.c_str(), describe(input).c_str());
  std::abort();
}

/// A pair as the kernel has it: lengths scaled by L.
struct Bodies {
  Body a, b;
  Pose pa, pb;
  /// Size of the numbers that are subtracted: rounding is a few 1e-16 of it.
  double size() const { return (pa.position - pb.position).norm() + a.bound + b.bound; }
};

/// Rounding of a distance. The kernel promises 1e-15 L; positions carry more where they are large.
double rounding(const Bodies& p) { return 1e-14 * (p.size() + p.pa.position.norm() + p.pb.position.norm()); }

Bodies swapped(const Bodies& p) { return {p.b, p.a, p.pb, p.pa}; }

Bodies moved(const Bodies& p, const Pose& by)
{
  const auto move = [&by](const Pose& q) {
    return Pose{by.position + by.rotation * q.position, by.rotation * q.rotation};
  };
  return {p.a, p.b, move(p.pa), move(p.pb)};
}

Separation checked_separation(const PairInput& input, const Bodies& p, double clearance, double enough,
                              double tightness)
{
  const Separation s = separation(p.a, p.pa, p.b, p.pb, clearance, enough, tightness);
  require(!std::isnan(s.lower) && !std::isnan(s.upper), input, "separation is no number");
  require(s.lower <= s.upper, input, fmt::format("separation {:g} .. {:g}", s.lower, s.upper));
  require(s.evaluations <= most_evaluations, input,
          fmt::format("separation took {} evaluations", s.evaluations));
  // Panels end at 1e-10 radians, and at a number of evaluations.
  const double resolved = 1e-10 * p.size(), promised = std::min(enough, tightness * s.upper);
  require(
      s.upper <= resolved || s.evaluations >= 2000000 || s.lower >= promised - rounding(p), input,
      fmt::format("separation {:g} .. {:g}, but at least {:g} was asked for", s.lower, s.upper, promised));
  return s;
}

/// Smallest distance between samples of one torus and the other's surface; negative where they overlap.
double sampled_distance(const brute::Torus& a, const brute::Torus& b)
{
  constexpr int around = 32, across = 8;
  double least = infinite;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * pi * i / around, v = 2.0 * pi * j / across;
      least = std::min(
          {least, brute::foot(b, a.surface(u, v)).distance, brute::foot(a, b.surface(u, v)).distance});
    }
  }
  return least;
}

template <int dim>
std::vector<Minimum> checked_minima(const PairInput& input, const Bodies& p, double threshold, double lower)
{
  const PairFrame frame(p.a, p.pa, p.b, p.pb);
  int evaluations = 0;
  std::vector<Minimum> minima = local_minima<dim>(frame, threshold, evaluations);
  require(evaluations <= most_in_families, input,
          fmt::format("local minima took {} evaluations", evaluations));
  const brute::Torus P = brute::from_kernel(p.a, p.pa), F = brute::from_kernel(p.b, p.pb);
  double last = -infinite;
  for (const Minimum& m : minima) {
    require(std::isfinite(m.u) && std::isfinite(m.v) && std::isfinite(m.distance), input,
            "minimum is no number");
    require(m.distance >= last, input, "minima are not sorted");
    last = m.distance;
    require(m.distance >= lower - rounding(p), input,
            fmt::format("minimum {:g} below the certified bound {:g}", m.distance, lower));
    require(m.distance <= threshold + rounding(p), input,
            fmt::format("minimum {:g} above the threshold {:g}", m.distance, threshold));
    if (m.distance <= 0.0) continue;
    const double there =
        dim == 1 ? brute::foot(F, P.core(m.u)).distance - P.r0 : brute::foot(F, P.surface(m.u, m.v)).distance;
    require(std::abs(there - m.distance) <= 100.0 * rounding(p), input,
            fmt::format("minimum at u {:.17g}, v {:.17g}: {:.17g}, there it is {:.17g}", m.u, m.v, m.distance,
                        there));
  }
  return minima;
}

/// Minima that take seconds to list: of pairs that are nearly of one axis, because all around they are nearly
/// equally far, and of two surfaces of which one is bent sharply.
bool is_dear(const Bodies& p)
{
  constexpr double nearly = 1e-3, sharp = 0.03;
  const Vec3 axis = p.pa.rotation.col(2), across = p.pb.position - p.pa.position;
  if (axis.cross(p.pb.rotation.col(2)).norm() < nearly && axis.cross(across).norm() < nearly) return true;
  if (p.a.is_circle_tube() || p.b.is_circle_tube()) return false;
  double radius = infinite;
  for (const Body* b : {&p.a, &p.b})
    radius = std::min({radius, b->r0 * b->r0 / b->r1, b->r1 * b->r1 / b->r0});
  return radius < sharp * std::max(p.a.bound, p.b.bound);
}

/// As the solver does: a tube is the one that is probed. None where the kernel gives up.
std::vector<Minimum> checked_minima(const PairInput& input, const Bodies& p, double threshold, double lower)
try {
  if (p.a.is_circle_tube()) return checked_minima<1>(input, p, threshold, lower);
  if (p.b.is_circle_tube()) return checked_minima<1>(input, swapped(p), threshold, lower);
  return checked_minima<2>(input, p, threshold, lower);
} catch (const ComputationError&) {
  require(is_dear(p), input, "the minima of an ordinary pair are too many");
  return {};
}

void check_sampled_minima(const PairInput& input, const Bodies& p, double lower)
{
  const PairFrame frame(p.a, p.pa, p.b, p.pb);
  int evaluations = 0;
  const auto minima = published::sampled_minima(frame, evaluations);
  require(!minima.empty(), input, "no sampled minimum");
  require(evaluations <= most_evaluations, input,
          fmt::format("sampled minima took {} evaluations", evaluations));
  for (const published::PublishedMinimum& m : minima) {
    require(std::isfinite(m.d) && m.d >= 0.0 && std::isfinite(m.c[0] + m.c[1] + m.c[2] + m.c[3]), input,
            "sampled minimum is no number");
    require(std::sqrt(m.d) >= lower - rounding(p), input,
            fmt::format("sampled minimum {:g} below the certified bound {:g}", std::sqrt(m.d), lower));
  }
}

/// Where the nearest minimum is listed both times it is the same; families of equally near points may be
/// listed or not.
void check_turned_minima(const PairInput& input, const Bodies& p, const std::vector<Minimum>& minima,
                         double threshold, const Separation& s)
{
  const Bodies moved_pair = moved(p, input.frame);
  const double r = rounding(p) + rounding(moved_pair);
  const std::vector<Minimum> turned = checked_minima(input, moved_pair, threshold, s.lower);
  if (minima.empty() || turned.empty()) return;
  const double one = minima.front().distance, other = turned.front().distance;
  if (one > s.upper + r || other > s.upper + r) return;
  require(std::abs(one - other) <= 100.0 * r, input,
          fmt::format("nearest minimum {:.17g}, moved {:.17g}", one, other));
}

void check_distances(const PairInput& input, const Bodies& p)
{
  const double r = rounding(p);
  const Separation s = checked_separation(input, p, 0.0, infinite, 0.5);
  const double sampled = sampled_distance(brute::from_kernel(p.a, p.pa), brute::from_kernel(p.b, p.pb));
  require(s.lower <= std::max(sampled, 0.0) + r, input,
          fmt::format("certified distance {:.17g}, sampled {:.17g}", s.lower, sampled));
  require(sampled > -r || s.lower <= 0.0, input,
          fmt::format("certified distance {:.17g}, but samples overlap by {:.17g}", s.lower, -sampled));
  // Either of the two, anywhere: the same distance.
  for (const Bodies& same : {swapped(p), moved(p, input.frame)}) {
    const double far = r + rounding(same);
    const Separation t = checked_separation(input, same, 0.0, infinite, 0.5);
    require(t.lower <= std::max(s.upper, 0.0) + far && s.lower <= std::max(t.upper, 0.0) + far, input,
            fmt::format("distance {:.17g} .. {:.17g}, exchanged or moved {:.17g} .. {:.17g}", s.lower,
                        s.upper, t.lower, t.upper));
  }
  const double clearance = input.clearance;
  const Separation clear = checked_separation(input, p, clearance, 0.1, 0.9);
  require(clear.lower <= std::max(s.upper - clearance, 0.0) + r, input, "clearance is not subtracted");

  if (s.lower > 0.0) {
    if (input.dear || !is_dear(p)) {
      const double threshold = 1.5 * s.upper + clearance;
      const std::vector<Minimum> minima = checked_minima(input, p, threshold, s.lower);
      if (input.turned) check_turned_minima(input, p, minima, threshold, s);
    }
    check_sampled_minima(input, input.published ? swapped(p) : p, s.lower);
    const int number = linking_number(p.a, p.pa, p.b, p.pb), back = linking_number(p.b, p.pb, p.a, p.pa);
    require(std::abs(number) <= 1 && std::abs(number) == std::abs(back), input,
            fmt::format("linked {} times, seen from the other {} times", number, back));
  }
}

SceneSpec scene_of(const PairInput& input)
{
  SceneSpec scene;
  scene.types.push_back({"ring", std::make_shared<test::Rings>()});
  for (const brute::Torus* t : {&input.a, &input.b}) {
    PlacedElement e;
    e.parameters = {t->R, t->r0, t->r1};
    e.rest = {t->center, t->axes};
    scene.elements.push_back(std::move(e));
  }
  return scene;
}

/// Nothing may be hit on the way that is certified, nor come nearer than promised at its end.
void check_step(const PairInput& input, const Model& m, const Bodies& p)
{
  constexpr int looks = 12;
  const State from = rest_state(m);
  Vector dy = Vector::Zero(m.dofs());
  for (int k = 0; k < m.dofs(); ++k) dy[k] = input.step[k];
  const SafeStep safe = largest_safe_step(m, from, dy, keep);
  require(safe.alpha >= 0.0 && safe.alpha <= 1.0, input, fmt::format("step {:g}", safe.alpha));
  require(safe.evaluations <= 2 * most_evaluations, input,
          fmt::format("certified step took {} evaluations", safe.evaluations));
  const double lower = separation(p.a, p.pa, p.b, p.pb, m.clearance, 1.0).lower;
  const double target = std::max(0.0, 0.5 * keep * lower) + m.clearance;
  for (int k = 0; safe.alpha > 0.0 && k <= looks; ++k) {
    const State at = advanced(m, from, dy, safe.alpha * k / looks);
    const Bodies there{p.a, p.b, image_pose(m, at, 0, {0, 0}), image_pose(m, at, 1, {0, 0})};
    const double sampled =
        sampled_distance(brute::from_kernel(there.a, there.pa), brute::from_kernel(there.b, there.pb));
    require(sampled >= target - rounding(there), input,
            fmt::format("step {:g} is certified, but at {:g} of it samples are {:g} apart, promised {:g}",
                        safe.alpha, static_cast<double>(k) / looks, sampled, target));
  }
  if (!input.published) return;
  const SafeStep published = sampled_safe_step(m, from, dy, 1e-8);
  require(published.alpha >= 0.0 && published.alpha <= 1.0, input,
          fmt::format("sampled step {:g}", published.alpha));
}

}  // namespace
}  // namespace hauberk::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace hauberk;
  using namespace hauberk::fuzz;
  const PairInput input = decode(data, size);
  for (const brute::Torus* t : {&input.a, &input.b}) {
    if (std::min(t->r0, t->r1) < 1e-9 || std::max(t->R, t->r1) > 1e9) return 0;  // no shape admits that
  }
  const test::Sheet sheet(3);
  const Model m = make_model(scene_of(input), sheet, input.clearance * input.a.R);
  const State rest = rest_state(m);
  const Bodies p{m.bodies[0], m.bodies[1], image_pose(m, rest, 0, {0, 0}), image_pose(m, rest, 1, {0, 0})};
  check_distances(input, p);
  check_step(input, m, p);
  return 0;
}
