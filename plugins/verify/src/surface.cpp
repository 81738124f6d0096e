#include "surface.hpp"

#include <cmath>
#include <numbers>

namespace hauberk::verification {
namespace {

/// Angle v in [0, pi/2] of the point (a cos v, b sin v) closest to (p, q), p, q >= 0.
///
/// h(v) = 1/2 d/dv |.|^2 = -a sin v (a cos v - p) + b cos v (b sin v - q) is <= 0 at 0, >= 0 at pi/2 and
/// changes sign once between. Newton, kept inside the shrinking bracket by bisection, down to the rounding of
/// v.
double closest_angle(double a, double b, double p, double q)
{
  constexpr double rounding = 4.5e-16;
  double low = 0.0, high = std::numbers::pi / 2.0;
  double v = std::atan2(a * q, b * p);
  if (!(v > low && v < high)) v = 0.5 * (low + high);
  for (int i = 0; i < 100; ++i) {
    const double c = std::cos(v), s = std::sin(v);
    const double h = -a * s * (a * c - p) + b * c * (b * s - q);
    const double slope = -a * c * (a * c - p) + a * a * s * s - b * s * (b * s - q) + b * b * c * c;
    if (std::abs(h) <= rounding * slope || high - low < rounding) return v;
    (h < 0.0 ? low : high) = v;
    v -= h / slope;
    if (!(v > low && v < high)) v = 0.5 * (low + high);
  }
  return v;
}

/// Bound of the length of the derivative of this order of a curve.
double sum_of_terms(const Primitive& torus, int order)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < torus.curve.size(); ++i)
    sum +=
        std::pow(static_cast<double>(i + 1), order) * (torus.curve[i][0].norm() + torus.curve[i][1].norm());
  return sum;
}

/// Tries points so close to each other that between two of them there is one lowest at most, as long as x is
/// not at a centre of curvature; then halves the bracket of the slope around each that is lower than its
/// neighbours.
double distance_from_curve(const Primitive& torus, const Vec3& x, Vec3* outward)
{
  const int count = 48 * static_cast<int>(torus.curve.size());
  const double width = 2.0 * std::numbers::pi / count;
  const auto at = [&](int i) { return (core_point(torus, i * width) - x).squaredNorm(); };
  const auto slope = [&](double u) { return (core_point(torus, u) - x).dot(core_tangent(torus, u)); };
  Vec3 nearest = core_point(torus, 0.0);
  double before = at(-1), now = at(0);
  for (int i = 0; i < count; ++i) {
    const double after = at(i + 1);
    if (now <= before && now <= after) {
      double low = (i - 1) * width, high = (i + 1) * width;
      for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (low + high);
        (slope(middle) < 0.0 ? low : high) = middle;
      }
      const Vec3 found = core_point(torus, 0.5 * (low + high));
      if ((found - x).squaredNorm() < (nearest - x).squaredNorm()) nearest = found;
    }
    before = now;
    now = after;
  }
  const double core = (x - nearest).norm();
  if (outward != nullptr) *outward = core > 0.0 ? Vec3((x - nearest) / core) : Vec3::UnitX();
  return core - torus.r0;
}

/// Bounds of the derivatives of a solid's probe over all of it.
ProbeBounds probe_bounds(const Primitive& torus)
{
  return torus.solid->probe_bounds(0.0, 0.0, std::numbers::pi, std::numbers::pi);
}

double distance_from_solid(const Primitive& torus, const Vec3& x, Vec3* outward)
{
  const SolidDistance found =
      torus.solid->distance(torus.place.rotation.transpose() * (x - torus.place.position));
  if (outward != nullptr) *outward = torus.place.rotation * found.normal;
  return found.distance;
}

}  // namespace

ProbeAngles probe_angles(double u, double v) { return {std::cos(u), std::sin(u), std::cos(v), std::sin(v)}; }

Place compose(const Place& a, const Place& b)
{
  return {a.position + a.rotation * b.position, a.rotation * b.rotation};
}

Primitive placed(const Primitive& torus, const Place& element)
{
  Primitive out = torus;
  out.place = compose(element, torus.place);
  return out;
}

double signed_distance(const Primitive& torus, const Vec3& x, Vec3* outward)
{
  if (torus.solid) return distance_from_solid(torus, x, outward);
  if (!torus.curve.empty()) return distance_from_curve(torus, x, outward);
  const Vec3 local = torus.place.rotation.transpose() * (x - torus.place.position);
  const double rho = std::hypot(local.x(), local.y());
  const double p = rho - torus.R, q = local.z(), a = torus.r0, b = torus.r1;
  double n_rho, n_z, distance;
  if (a == b && (p != 0.0 || q != 0.0)) {
    const double core = std::hypot(p, q);
    distance = core - a;
    n_rho = p / core;
    n_z = q / core;
  } else {
    const double v = closest_angle(a, b, std::abs(p), std::abs(q));
    const double c = std::cos(v), s = std::sin(v);
    const double inside = (p / a) * (p / a) + (q / b) * (q / b) < 1.0 ? -1.0 : 1.0;
    distance = inside * std::hypot(a * c - std::abs(p), b * s - std::abs(q));
    const double scale = std::hypot(c / a, s / b);
    n_rho = std::copysign(c / a / scale, p);
    n_z = std::copysign(s / b / scale, q);
  }
  if (outward) {
    // On the axis every direction is as good; the first axis is taken.
    const double ex = rho > 0.0 ? local.x() / rho : 1.0, ey = rho > 0.0 ? local.y() / rho : 0.0;
    *outward = torus.place.rotation * Vec3(n_rho * ex, n_rho * ey, n_z);
  }
  return distance;
}

bool is_tube(const Primitive& torus)
{
  return torus.solid ? torus.solid->probe_dimension() == 1 : torus.r0 == torus.r1;
}

Vec3 core_point(const Primitive& torus, double u)
{
  if (torus.solid)
    return torus.place.position + torus.place.rotation * torus.solid->probe(probe_angles(u, 0.0)).x;
  if (!torus.curve.empty()) {
    Vec3 local = Vec3::Zero();
    for (std::size_t i = 0; i < torus.curve.size(); ++i) {
      const double ku = static_cast<double>(i + 1) * u;
      local += std::cos(ku) * torus.curve[i][0] + std::sin(ku) * torus.curve[i][1];
    }
    return torus.place.position + torus.place.rotation * local;
  }
  return torus.place.position +
         torus.place.rotation * Vec3(torus.R * std::cos(u), torus.R * std::sin(u), 0.0);
}

Vec3 core_tangent(const Primitive& torus, double u)
{
  if (torus.solid) return torus.place.rotation * torus.solid->probe(probe_angles(u, 0.0)).u;
  Vec3 local(-torus.R * std::sin(u), torus.R * std::cos(u), 0.0);
  if (!torus.curve.empty()) local.setZero();
  for (std::size_t i = 0; i < torus.curve.size(); ++i) {
    const double k = static_cast<double>(i + 1);
    local += k * (std::cos(k * u) * torus.curve[i][1] - std::sin(k * u) * torus.curve[i][0]);
  }
  return torus.place.rotation * local;
}

double core_reach(const Primitive& torus) { return torus.curve.empty() ? torus.R : sum_of_terms(torus, 0); }

double reach(const Primitive& torus)
{
  if (torus.solid) return torus.solid->radius();
  return torus.surface ? torus.R * torus.surface->reach : core_reach(torus) + std::max(torus.r0, torus.r1);
}

double core_speed(const Primitive& torus)
{
  if (torus.solid) return probe_bounds(torus).u;
  return torus.curve.empty() ? torus.R : sum_of_terms(torus, 1);
}

double core_bend(const Primitive& torus)
{
  if (torus.solid) return probe_bounds(torus).uu;
  return torus.curve.empty() ? torus.R : sum_of_terms(torus, 2);
}

Vec3 surface_point(const Primitive& torus, double u, double v)
{
  if (torus.solid)
    return torus.place.position + torus.place.rotation * torus.solid->probe(probe_angles(u, v)).x;
  const double rho = torus.R + torus.r0 * std::cos(v);
  return torus.place.position +
         torus.place.rotation * Vec3(rho * std::cos(u), rho * std::sin(u), torus.r1 * std::sin(v));
}

std::array<Vec3, 2> surface_tangents(const Primitive& torus, double u, double v)
{
  if (torus.solid) {
    const ProbeDerivatives at = torus.solid->probe(probe_angles(u, v));
    return {torus.place.rotation * at.u, torus.place.rotation * at.v};
  }
  const double cu = std::cos(u), su = std::sin(u), cv = std::cos(v), sv = std::sin(v);
  const double rho = torus.R + torus.r0 * cv;
  return {torus.place.rotation * Vec3(-rho * su, rho * cu, 0.0),
          torus.place.rotation * Vec3(-torus.r0 * sv * cu, -torus.r0 * sv * su, torus.r1 * cv)};
}

}  // namespace hauberk::verification
