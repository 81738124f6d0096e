#include "touching.hpp"

#include "surface.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::verification {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

Touching flipped(const Touching& t) { return {t.distance, -t.normal, t.on_b, t.on_a}; }

/// Angles of that one of many points of a solid's surface which is nearest to x.
Eigen::Vector2d sampled_angles(const Primitive& solid, const Vec3& x)
{
  constexpr int count = 96;
  Eigen::Vector2d nearest = Eigen::Vector2d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const Eigen::Vector2d at = full_turn / count * Eigen::Vector2d(i, j);
      const double away = (surface_point(solid, at[0], at[1]) - x).norm();
      if (away >= least) continue;
      least = away;
      nearest = at;
    }
  return nearest;
}

/// Angles of the surface point nearest to x; v is exact for circular sections and close enough to start from
/// else.
Eigen::Vector2d angles(const Primitive& torus, const Vec3& x)
{
  if (torus.solid) return sampled_angles(torus, x);
  const Vec3 local = torus.place.rotation.transpose() * (x - torus.place.position);
  const double p = std::hypot(local.x(), local.y()) - torus.R;
  return {std::atan2(local.y(), local.x()), std::atan2(local.z() * torus.r0, p * torus.r1)};
}

/// Coordinate of the point of a tube's core that is nearest to x, close enough to start from.
double core_angle(const Primitive& tube, const Vec3& x)
{
  if (!tube.solid && tube.curve.empty()) return angles(tube, x)[0];
  const int count = tube.solid ? 96 : 48 * static_cast<int>(tube.curve.size());
  int nearest = 0;
  for (int i = 1; i < count; ++i) {
    const auto distance = [&](int k) { return (core_point(tube, k * full_turn / count) - x).norm(); };
    if (distance(i) < distance(nearest)) nearest = i;
  }
  return nearest * full_turn / count;
}

/// Distance of b to the core of a tube at u, and its derivative.
struct OnCore {
  double value, slope;
  Vec3 outward;
};

OnCore on_core(const Primitive& tube, const Primitive& b, double u)
{
  OnCore out{};
  out.value = signed_distance(b, core_point(tube, u), &out.outward);
  out.slope = out.outward.dot(core_tangent(tube, u));
  return out;
}

/// Walks downhill until the slope changes sign, then halves the bracket: nothing is assumed about curvature.
Touching descend_tube(const Primitive& tube, const Primitive& b, double u)
{
  constexpr double first_step = 1e-4, growth = 1.6;
  double step = on_core(tube, b, u).slope > 0.0 ? -first_step : first_step;
  double low = u, high = u + step;
  while (on_core(tube, b, high).slope * step < 0.0 && std::abs(high - u) < full_turn) {
    low = high;
    step *= growth;
    high += step;
  }
  for (int k = 0; k < 60 && std::abs(high - low) > 1e-15; ++k) {
    const double middle = 0.5 * (low + high);
    (on_core(tube, b, middle).slope * step < 0.0 ? low : high) = middle;
  }
  const OnCore end = on_core(tube, b, 0.5 * (low + high));
  const Vec3 core = core_point(tube, 0.5 * (low + high));
  return {end.value - tube.r0, -end.outward, core - tube.r0 * end.outward, core - end.value * end.outward};
}

/// Derivatives of the distance of b to the surface of a by a's angles.
Eigen::Vector2d slope_on_surface(const Primitive& a, const Primitive& b, const Eigen::Vector2d& at)
{
  Vec3 outward;
  signed_distance(b, surface_point(a, at[0], at[1]), &outward);
  const auto [along_u, along_v] = surface_tangents(a, at[0], at[1]);
  return {outward.dot(along_u), outward.dot(along_v)};
}

/// Newton's method with differences of the slope, made positive definite, and halved steps.
Touching descend_surface(const Primitive& a, const Primitive& b, Eigen::Vector2d at)
{
  constexpr double h = 1e-6;
  const auto value = [&](const Eigen::Vector2d& x) {
    return signed_distance(b, surface_point(a, x[0], x[1]));
  };
  double now = value(at);
  for (int k = 0; k < 60; ++k) {
    const Eigen::Vector2d slope = slope_on_surface(a, b, at);
    Eigen::Matrix2d curvature;
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector2d e = h * Eigen::Vector2d::Unit(j);
      curvature.col(j) = (slope_on_surface(a, b, at + e) - slope_on_surface(a, b, at - e)) / (2.0 * h);
    }
    curvature = 0.5 * (curvature + curvature.transpose()).eval();
    const double mean = 0.5 * curvature.trace();
    const double lowest = mean - std::hypot(0.5 * (curvature(0, 0) - curvature(1, 1)), curvature(0, 1));
    const double least = 1e-6 * (std::abs(mean) + a.r0);
    if (lowest < least) curvature += (least - lowest) * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d step = -curvature.inverse() * slope;
    double length = 1.0;
    while (length > 1e-10 && value(at + length * step) > now) length *= 0.5;
    if (length <= 1e-10) break;
    at += length * step;
    now = value(at);
    if (length * step.norm() < 1e-14) break;
  }
  Vec3 outward;
  const Vec3 point = surface_point(a, at[0], at[1]);
  const double distance = signed_distance(b, point, &outward);
  return {distance, -outward, point, point - distance * outward};
}

}  // namespace

Touching touching_near(const Primitive& a, const Primitive& b, const Vec3& near)
{
  if (is_tube(a)) return descend_tube(a, b, core_angle(a, near));
  if (is_tube(b)) return flipped(descend_tube(b, a, core_angle(b, near)));
  return descend_surface(a, b, angles(a, near));
}

std::vector<Touching> touchings(const Primitive& a, const Primitive& b, double range)
{
  if ((a.place.position - b.place.position).norm() - reach(a) - reach(b) > range) return {};
  if (!is_tube(a) && is_tube(b)) {
    std::vector<Touching> out = touchings(b, a, range);
    for (Touching& t : out) t = flipped(t);
    return out;
  }
  const bool tube = is_tube(a);
  const int around = std::max(96, 48 * static_cast<int>(a.curve.size()));
  constexpr int across = 24;
  const int nv = tube ? 1 : across;
  const auto u = [around](int i) { return i * full_turn / around; };
  const auto v = [](int j) { return j * full_turn / across; };
  std::vector<double> f(static_cast<std::size_t>(around * nv));
  const auto at = [&](int i, int j) -> double& {
    const int k = (i + around) % around * nv + (j + nv) % nv;
    return f[k];
  };
  // A minimum between samples is lower than they are by at most half a cell.
  const double cell = 0.5 * (core_speed(a) + a.r0) * full_turn / around;
  for (int i = 0; i < around; ++i) {
    const bool cored = tube || !a.solid;
    const double core = cored ? signed_distance(b, core_point(a, u(i))) : 0.0;
    // No point of a section is farther from its core than this, and the distance changes by no more.
    const bool far = cored && core - std::max(a.r0, a.r1) > range + cell;
    for (int j = 0; j < nv; ++j) {
      if (tube || far)
        at(i, j) = tube ? core - a.r0 : std::numeric_limits<double>::infinity();
      else
        at(i, j) = signed_distance(b, surface_point(a, u(i), v(j)));
    }
  }
  std::vector<Touching> out;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < nv; ++j) {
      if (at(i, j) > range + cell) continue;
      bool lowest = true;
      for (int di = -1; di <= 1; ++di)
        for (int dj = tube ? 0 : -1; dj <= (tube ? 0 : 1); ++dj)
          lowest = lowest && at(i, j) <= at(i + di, j + dj);
      if (!lowest) continue;
      const Touching t = tube ? descend_tube(a, b, u(i)) : descend_surface(a, b, {u(i), v(j)});
      if (t.distance < range) out.push_back(t);
    }
  return out;
}

}  // namespace hauberk::verification
