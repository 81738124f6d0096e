#include "torus.hpp"

#include <cmath>
#include <vector>

namespace hauberk::brute {
namespace {

using std::numbers::pi;

struct PlaneFoot {
  double x, y;
};

/// Closest point of the ellipse (a, b) to (X, Y) with X, Y >= 0.
PlaneFoot ellipse_foot(double a, double b, double X, double Y)
{
  const double aa = a * a, bb = b * b;
  const auto residual = [&](double t) {
    const double p = a * X / (t + aa), q = b * Y / (t + bb);
    return p * p + q * q - 1.0;
  };
  // Left end: one of the two terms alone equals one there, so the residual is not negative.
  double t = std::max(a * X - aa, b * Y - bb);
  const double floor = -std::min(aa, bb);
  if (t <= floor) {
    // On a symmetry axis inside, beyond the evolute's cusp: the foot leaves the axis.
    if (a > b) {
      const double c = aa * X / (aa - bb);
      return {c, b * std::sqrt(std::max(0.0, 1.0 - c * c / aa))};
    }
    const double c = bb * Y / (bb - aa);
    return {a * std::sqrt(std::max(0.0, 1.0 - c * c / bb)), c};
  }
  for (int k = 0; k < 100; ++k) {
    const double p = a * X / (t + aa), q = b * Y / (t + bb);
    const double slope = -2.0 * (p * p / (t + aa) + q * q / (t + bb));
    const double next = t - residual(t) / slope;
    if (!(next > t)) break;  // monotone from the left until rounding
    t = next;
  }
  return {aa * X / (t + aa), bb * Y / (t + bb)};
}

double gauss_sum(const Torus& a, const Torus& b, int n)
{
  std::vector<Vec3> p, dp, q, dq;
  const auto fill = [n](const Torus& t, std::vector<Vec3>& x, std::vector<Vec3>& dx) {
    for (int k = 0; k < n; ++k) {
      const double u = 2.0 * pi * k / n;
      x.push_back(t.core(u));
      dx.emplace_back(t.R * (-std::sin(u) * t.axes.col(0) + std::cos(u) * t.axes.col(1)));
    }
  };
  fill(a, p, dp);
  fill(b, q, dq);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3 r = p[i] - q[j];
      const double d = r.squaredNorm();
      sum += r.dot(dp[i].cross(dq[j])) / (d * std::sqrt(d));
    }
  }
  const double h = 2.0 * pi / n;
  return sum * h * h / (4.0 * pi);
}

}  // namespace

Vec3 Torus::surface(double u, double v) const
{
  const double w = R + r0 * std::cos(v);
  return center + axes * Vec3(w * std::cos(u), w * std::sin(u), r1 * std::sin(v));
}

Vec3 Torus::core(double u) const { return center + axes * Vec3(R * std::cos(u), R * std::sin(u), 0.0); }

Foot foot(const Torus& torus, const Vec3& x)
{
  const Vec3 y = torus.axes.transpose() * (x - torus.center);
  const double rho = std::hypot(y.x(), y.y());
  const double cu = rho > 0.0 ? y.x() / rho : 1.0, su = rho > 0.0 ? y.y() / rho : 0.0;
  const double X = rho - torus.R, Z = y.z();
  double nx, nz, distance;
  if (torus.round()) {
    const double d = std::hypot(X, Z);
    nx = d > 0.0 ? X / d : 1.0;
    nz = d > 0.0 ? Z / d : 0.0;
    distance = d - torus.r0;
  } else {
    const PlaneFoot f = ellipse_foot(torus.r0, torus.r1, std::abs(X), std::abs(Z));
    const double gx = f.x / (torus.r0 * torus.r0), gz = f.y / (torus.r1 * torus.r1);
    const double g = std::hypot(gx, gz);
    distance = ((std::abs(X) - f.x) * gx + (std::abs(Z) - f.y) * gz) / g;
    nx = std::copysign(gx / g, X);
    nz = std::copysign(gz / g, Z);
  }
  Foot out;
  out.distance = distance;
  out.normal = torus.axes * Vec3(nx * cu, nx * su, nz);
  out.point = x - distance * out.normal;
  return out;
}

Body kernel_body(const Torus& torus)
{
  Primitive p;
  p.size = {torus.R, torus.r0, torus.r1};
  p.kind = torus.round() ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
  return make_body(p, 0, 0, 1.0);
}

Pose kernel_pose(const Torus& torus) { return {torus.center, torus.axes}; }

Torus from_kernel(const Body& body, const Pose& pose)
{
  return {pose.position + pose.rotation * body.center, pose.rotation * body.axes, body.R, body.r0, body.r1};
}

int gauss_linking(const Torus& a, const Torus& b)
{
  if ((a.center - b.center).norm() >= a.R + b.R) return 0;
  double last = gauss_sum(a, b, 64);
  for (int n = 128; n <= 4096; n *= 2) {
    const double value = gauss_sum(a, b, n);
    const double nearest = std::round(value);
    if (nearest == std::round(last) && std::abs(value - nearest) < 0.1) return static_cast<int>(nearest);
    last = value;
  }
  return static_cast<int>(std::round(last));
}

}  // namespace hauberk::brute
