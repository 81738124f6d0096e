#include "in_plane_periodic.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Sine of the angle below which two directions count as parallel: rounding of rotated lattice vectors and of
/// angles in degrees stays far below it.
constexpr double parallel_sine = 1e-9;

/// In-plane length, scaled by L, below which the translation of a cycle is zero up to rounding: others are
/// lattice vectors, not shorter than an element.
constexpr double zero_translation = 1e-9;

enum { exx, eyy, exy };  // order of the macroscopic unknowns

}  // namespace

InPlanePeriodic::InPlanePeriodic(StrainMeasure measure, OutOfPlane out_of_plane)
    : macros_{{"exx", 0}, {"eyy", 0}, {"exy", 0}}, measure_(measure), out_of_plane_(out_of_plane)
{
}

int InPlanePeriodic::do_coordinate_count() const
{
  return out_of_plane_.free || out_of_plane_.half_height > 0.0 ? 3 : 2;
}

void InPlanePeriodic::do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X,
                                  const Vec3& T, PositionMap& out) const
{
  const Vec3 rest = X + T;
  out.x = rest;
  out.x.x() += macro[exx] * rest.x() + macro[exy] * rest.y() + e[0];
  out.x.y() += macro[exy] * rest.x() + macro[eyy] * rest.y() + e[1];
  out.J(0, exx) = rest.x();
  out.J(1, eyy) = rest.y();
  out.J(0, exy) = rest.y();
  out.J(1, exy) = rest.x();
  out.J(0, 3) = 1.0;
  out.J(1, 4) = 1.0;
  if (e.size() == 3) {
    out.x.z() += e[2];
    out.J(2, 5) = 1.0;
  }
}

bool InPlanePeriodic::do_admissible(std::span<const double> macro) const
{
  // F is positive definite; false for not-a-number.
  const double a = 1.0 + macro[exx];
  const double b = 1.0 + macro[eyy];
  return a > 0.0 && b > 0.0 && a * b - macro[exy] * macro[exy] > 0.0;
}

std::pair<double, double> InPlanePeriodic::do_stretch_range(std::span<const double> macro) const
{
  // F is symmetric, so its eigenvalues are its singular values. The smaller one is det/larger, which keeps
  // its digits where mean - radius cancels.
  const double a = 1.0 + macro[exx];
  const double b = 1.0 + macro[eyy];
  const double larger = 0.5 * (a + b) + std::hypot(0.5 * (a - b), macro[exy]);
  return {(a * b - macro[exy] * macro[exy]) / larger, larger};
}

void InPlanePeriodic::do_load(double theta, std::span<double> t) const
{
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  if (measure_ == StrainMeasure::tensor) {
    t[exx] = c * c;
    t[eyy] = s * s;
    t[exy] = 2.0 * c * s;
    return;
  }
  const double dd = c * c * c * c + s * s * s * s + c * c * s * s;
  t[exx] = c * c / dd;
  t[eyy] = s * s / dd;
  t[exy] = c * s / dd;
}

double InPlanePeriodic::do_value(double theta, std::span<const double> macro) const
{
  double t[3];
  do_load(theta, t);
  return t[exx] * macro[exx] + t[eyy] * macro[eyy] + t[exy] * macro[exy];
}

std::string InPlanePeriodic::do_measure() const
{
  return measure_ == StrainMeasure::tensor ? "tensor" : "paper";
}

std::vector<std::pair<std::string, double>> InPlanePeriodic::do_companions(
    double theta, std::span<const double> macro) const
{
  // |F n| - 1 = (|F n|^2 - 1)/(|F n| + 1) with |F n|^2 - 1 = 2 n . m + m . m, m = eps n: no cancellation.
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const double mx = macro[exx] * c + macro[exy] * s;
  const double my = macro[exy] * c + macro[eyy] * s;
  const double length = std::hypot(c + mx, s + my);
  return {{"line_stretch", (2.0 * (c * mx + s * my) + mx * mx + my * my) / (length + 1.0)}};
}

void InPlanePeriodic::do_metric(std::span<double> m) const
{
  m[exx] = m[eyy] = 1.0;
  m[exy] = 2.0;  // the Frobenius norm counts the shear twice
}

std::vector<LinearInequality> InPlanePeriodic::do_inequalities(std::span<const Vec3> X) const
{
  std::vector<LinearInequality> walls;
  const int n = static_cast<int>(X.size());
  // A single element is its own mean, so it never meets a wall.
  if (out_of_plane_.free || out_of_plane_.half_height <= 0.0 || n < 2) return walls;
  for (int i = 0; i < n; ++i) {
    for (const double side : {1.0, -1.0}) {  // h - (u_i - mean) >= 0 above, h + (u_i - mean) >= 0 below
      LinearInequality wall;
      wall.name = side > 0.0 ? "upper" : "lower";
      wall.offset = out_of_plane_.half_height;
      // The element the wall belongs to comes first.
      wall.terms.push_back({i, 2, -side * (n - 1) / n});
      for (int k = 0; k < n; ++k) {
        if (k != i) wall.terms.push_back({k, 2, side / n});
      }
      walls.push_back(std::move(wall));
    }
  }
  return walls;
}

double InPlanePeriodic::transverse_rate(double theta, double x, double y) const
{
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  if (measure_ == StrainMeasure::tensor) return (c * x + s * y) * (c * x + s * y);
  const double dd = c * c * c * c + s * s * s * s + c * c * s * s;
  return (c * c * x * x + s * s * y * y + c * s * x * y) / dd;
}

Boundedness InPlanePeriodic::do_boundedness(double theta, Sense sense, std::span<const Vec3> cycles) const
{
  // The argument stands in the README. In short: link cycles bound F T for their translations T. If those
  // span the plane, F is bounded. Otherwise the strain along one direction a is free to grow: across the
  // cycles, or anywhere when there are none. The value grows with it at a rate r >= 0. Stretch is unbounded
  // where r > 0. Compression cannot use that direction where r > 0; where r = 0 the sheet can turn what is to
  // be compressed aside while it spreads, so the value tends to its infimum without reaching it.
  double longest = zero_translation;
  double tx = 0.0;
  double ty = 0.0;
  for (const Vec3& T : cycles) {
    const double length = std::hypot(T.x(), T.y());
    if (length > longest) {
      longest = length;
      tx = T.x() / length;
      ty = T.y() / length;
    }
  }
  if (longest > zero_translation) {
    const bool spans = std::any_of(cycles.begin(), cycles.end(), [&](const Vec3& T) {
      const double length = std::hypot(T.x(), T.y());
      return length > zero_translation && std::abs(tx * T.y() - ty * T.x()) > parallel_sine * length;
    });
    if (spans) return Boundedness::attained;
  } else {
    if (sense == Sense::positive) return Boundedness::unbounded;
    tx = std::cos(theta);
    ty = std::sin(theta);
  }
  const bool grows = transverse_rate(theta, -ty, tx) > parallel_sine * parallel_sine;
  if (sense == Sense::positive) return grows ? Boundedness::unbounded : Boundedness::attained;
  return grows ? Boundedness::attained : Boundedness::not_attained;
}

}  // namespace hauberk
