#include "design/body_between.hpp"

#include "geometry/closed_curve.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>
#include <hauberk/triangle_surface.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

std::shared_ptr<const ClosedCurve> mixed(const ClosedCurve& a, const ClosedCurve& b, double t)
{
  if (a.size() != b.size())
    throw PluginError("shape: the number of harmonics of a curve depends on the parameters");
  std::vector<Harmonic> harmonics = a.harmonics();
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    harmonics[k].c += t * (b.harmonics()[k].c - harmonics[k].c);
    harmonics[k].s += t * (b.harmonics()[k].s - harmonics[k].s);
  }
  return std::make_shared<const ClosedCurve>(std::move(harmonics), 1.0);
}

/// Bound of the distance between points of two curves at the same coordinate.
double farthest_apart(const ClosedCurve& a, const ClosedCurve& b)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    sum +=
        (a.harmonics()[k].c - b.harmonics()[k].c).norm() + (a.harmonics()[k].s - b.harmonics()[k].s).norm();
  return sum;
}

/// The solid at sizes between those of a and b; null where there is none.
std::shared_ptr<const Solid> mixed(const Solid& a, const Solid& b, double t)
{
  std::vector<double> sizes = a.sizes();
  for (std::size_t k = 0; k < sizes.size(); ++k) sizes[k] = std::lerp(sizes[k], b.sizes()[k], t);
  return a.with_sizes(sizes);
}

/// How a body turns about its centre between a and b: at the place t by exp(t psi), the shorter way.
Vec3 turn_between(const Body& a, const Body& b)
{
  return a.axes == b.axes ? Vec3(Vec3::Zero()) : rotation_log(b.axes * a.axes.transpose());
}

/// Bound of how fast surface points of `body_between` move in the frame of the body, per unit of t.
double size_speed(const Body& a, const Body& b)
{
  if (a.solid && b.solid) return same_solid(a, b) ? 0.0 : a.solid->speed(b.solid->sizes()) / a.unit;
  const double core = a.surface && b.surface
                          ? std::abs(a.R - b.R) * std::max(a.surface->bound(), b.surface->bound())
                      : a.curve && b.curve ? farthest_apart(*a.curve, *b.curve)
                                           : std::abs(a.R - b.R);
  return core + std::max(std::abs(a.r0 - b.r0), std::abs(a.r1 - b.r1));
}

}  // namespace

Body body_between(const Body& a, const Body& b, double t)
{
  Body q = a;
  const auto mix = [t](double x, double y) { return (1.0 - t) * x + t * y; };
  q.R = mix(a.R, b.R);
  q.r0 = mix(a.r0, b.r0);
  q.r1 = mix(a.r1, b.r1);
  q.center = (1.0 - t) * a.center + t * b.center;
  if (const Vec3 psi = turn_between(a, b); psi != Vec3::Zero()) q.axes = rotation_exp(t * psi) * a.axes;
  q.bound = std::max(a.bound, b.bound);
  q.reach = std::max(a.reach, b.reach);
  if (!b.is_circle_tube()) q.kind = b.kind;
  if (a.curve && b.curve) set_core(q, mixed(*a.curve, *b.curve, t), q.r0);
  if (a.solid && b.solid && !same_solid(a, b)) q.solid = mixed(*a.solid, *b.solid, t);
  return q;
}

double shape_speed(const Body& a, const Body& b)
{
  const double sizes = size_speed(a, b);
  const double place = sizes + (a.center - b.center).norm();
  const double turn = turn_between(a, b).norm();
  return turn == 0.0 ? place : place + turn * 0.5 * (a.bound + b.bound + sizes);
}

}  // namespace hauberk
