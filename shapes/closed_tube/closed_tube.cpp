#include "closed_tube.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace hauberk {
namespace {

/// As many as the kernel takes, so that it refuses no bend that is accepted here.
constexpr std::size_t samples_per_harmonic = 256;
/// Of these, those that are compared with each other.
constexpr std::size_t stride = 4;
/// Of the mean radius: what the kernel takes.
constexpr double thinnest = 1e-4;

/// Smallest radius of curvature of a curve, and where it comes back to itself.
struct Thickest {
  double bend;
  /// Largest radius at which points further along the curve than half a turn of it leave room for the tube:
  /// a curve that nowhere bends more tightly than r keeps points that are at most pi r apart along it at
  /// least as far apart in space as the chord of that half turn.
  double pass;
};

Thickest thickest_tube(const std::vector<Harmonic>& curve, double r)
{
  const std::size_t count = samples_per_harmonic * curve.size();
  std::vector<Vec3> x(count, Vec3::Zero());
  std::vector<double> along(count + 1, 0.0);
  Thickest out{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const double du = 2.0 * std::numbers::pi / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double u = du * static_cast<double>(i);
    Vec3 first = Vec3::Zero(), second = Vec3::Zero();
    double k = 0.0;
    for (const Harmonic& h : curve) {
      k += 1.0;
      const double c = std::cos(k * u), s = std::sin(k * u);
      x[i] += c * h.c + s * h.s;
      first += k * (c * h.s - s * h.c);
      second -= k * k * (c * h.c + s * h.s);
    }
    const double speed = first.norm();
    along[i + 1] = along[i] + speed * du;
    out.bend = std::min(out.bend, speed > 0.0 ? speed * speed * speed / first.cross(second).norm() : 0.0);
  }
  const double length = along[count];
  for (std::size_t i = 0; i < count; i += stride) {
    for (std::size_t j = i + stride; j < count; j += stride) {
      const double apart = along[j] - along[i];
      if (std::min(apart, length - apart) > std::numbers::pi * r)
        out.pass = std::min(out.pass, 0.5 * (x[i] - x[j]).norm());
    }
  }
  return out;
}

}  // namespace

ClosedTube::ClosedTube(std::vector<ParameterInfo> parameters, std::vector<CurveTerm> terms)
    : parameters_(std::move(parameters)), terms_(std::move(terms))
{
  for (const CurveTerm& term : terms_) harmonics_ = std::max(harmonics_, static_cast<std::size_t>(term.k));
}

void ClosedTube::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  Primitive tube;
  tube.name = "tube";
  tube.kind = PrimitiveKind::curve_tube;
  tube.curve.resize(harmonics_);
  for (const CurveTerm& term : terms_) {
    Harmonic& h = tube.curve[term.k - 1];
    (term.sine ? h.s : h.c)[term.axis] += term.weight * p[term.parameter];
  }
  const double r = p.back();
  tube.size = {1.0, r, r};
  double squares = 0.0;
  for (const Harmonic& h : tube.curve) squares += h.c.squaredNorm() + h.s.squaredNorm();
  if (const double least = thinnest * std::sqrt(0.5 * squares); r < least) {
    throw InputError(fmt::format("parameter '{}' = {:g} is too thin for its curve: at least {:g} is needed",
                                 parameters_.back().name, r, least));
  }
  const Thickest most = thickest_tube(tube.curve, r);
  if (!(r < most.bend) || !(r < most.pass)) {
    throw InputError(fmt::format("parameter '{}' = {:g} is too thick: the curve {} {:g}",
                                 parameters_.back().name, r,
                                 r < most.bend ? "comes back to itself at twice" : "bends with a radius of",
                                 r < most.bend ? most.pass : most.bend));
  }
  out.assign(1, std::move(tube));
}

void ClosedTube::do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const
{
  const std::size_t n = p.size();
  PrimitiveJacobian jacobian((primitive_dofs + harmonic_dofs * harmonics_) * n, 0.0);
  jacobian[4 * n + n - 1] = jacobian[5 * n + n - 1] = 1.0;
  for (const CurveTerm& term : terms_) {
    const std::size_t row = primitive_dofs + harmonic_dofs * static_cast<std::size_t>(term.k - 1) +
                            (term.sine ? 3 : 0) + static_cast<std::size_t>(term.axis);
    jacobian[row * n + term.parameter] += term.weight;
  }
  out.assign(1, std::move(jacobian));
}

}  // namespace hauberk
