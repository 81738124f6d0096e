#include "paraboloid_bending.hpp"

#include "common/sheet.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

enum { A, B, C };     // order of the macroscopic unknowns
enum { ux = 3, uy };  // columns of an element's coordinates

/// Largest curvature of the paraboloid: at the apex, |eigenvalue| of [[2 A, C], [C, 2 B]]. Anywhere else the
/// surface curves less, since its slope divides the same second derivatives by more.
double largest_curvature(std::span<const double> macro)
{
  const double mean = macro[A] + macro[B];
  return std::abs(mean) + std::hypot(macro[A] - macro[B], macro[C]);
}

/// Length of the curve on the paraboloid above the straight line from (x, y) to (x + dx, y + dy): of a
/// parabola of slope b at the start and b + 2 a at the end over a length d, in units of d.
double length_along(std::span<const double> macro, double x, double y, double dx, double dy)
{
  const double d = std::hypot(dx, dy);
  if (!(d > 0.0)) return 0.0;
  const double a = (macro[A] * dx * dx + macro[B] * dy * dy + macro[C] * dx * dy) / d;
  const double b = (2.0 * macro[A] * x * dx + 2.0 * macro[B] * y * dy + macro[C] * (x * dy + y * dx)) / d;
  constexpr double straight = 1e-4;  // where slopes change by less, their mean is exact to nine digits
  if (std::abs(a) < straight) return d * std::hypot(1.0, b + a);
  const auto primitive = [](double slope) {
    return 0.5 * (slope * std::hypot(1.0, slope) + std::asinh(slope));
  };
  return d * (primitive(b + 2.0 * a) - primitive(b)) / (2.0 * a);
}

}  // namespace

ParaboloidBending::ParaboloidBending(Hold hold) : hold_(hold), macros_{{"A", -1}, {"B", -1}, {"C", -1}} {}

void ParaboloidBending::do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X,
                                    const Vec3& T, PositionMap& out) const
{
  const double x = X.x() + T.x() + (hold_.places ? 0.0 : e[0]);
  const double y = X.y() + T.y() + (hold_.places ? 0.0 : e[1]);
  out.x = Vec3(x, y, X.z() + T.z() + macro[A] * x * x + macro[B] * y * y + macro[C] * x * y);
  out.J(2, A) = x * x;
  out.J(2, B) = y * y;
  out.J(2, C) = x * y;
  if (hold_.places) return;
  out.J(0, ux) = 1.0;
  out.J(1, uy) = 1.0;
  out.J(2, ux) = 2.0 * macro[A] * x + macro[C] * y;
  out.J(2, uy) = 2.0 * macro[B] * y + macro[C] * x;

  out.curved = true;
  for (auto& component : out.H) {
    for (auto& row : component) row.fill(0.0);
  }
  auto& H = out.H[2];
  const auto set = [&H](std::size_t i, std::size_t j, double value) { H[i][j] = H[j][i] = value; };
  set(A, ux, 2.0 * x);
  set(B, uy, 2.0 * y);
  set(C, ux, y);
  set(C, uy, x);
  set(ux, ux, 2.0 * macro[A]);
  set(uy, uy, 2.0 * macro[B]);
  set(ux, uy, macro[C]);
}

double ParaboloidBending::do_acceleration_bound(std::span<const double> macro, std::span<const double> dmacro,
                                                std::span<const double> e, std::span<const double> de,
                                                const Vec3& X, const Vec3& T) const
{
  if (hold_.places) return 0.0;  // z is linear in (A, B, C)
  // z is cubic in s, so z'' is linear: its size is largest at one of the ends. With q the quadratic form,
  // z'' = 4 q_dmacro(x + s dx, dx) + 2 q_(macro + s dmacro)(dx, dx).
  const auto form = [](double a, double b, double c, double x1, double y1, double x2, double y2) {
    return a * x1 * x2 + b * y1 * y2 + 0.5 * c * (x1 * y2 + y1 * x2);
  };
  double largest = 0.0;
  for (const double s : {0.0, 1.0}) {
    const double x = X.x() + T.x() + e[0] + s * de[0];
    const double y = X.y() + T.y() + e[1] + s * de[1];
    const double second = 4.0 * form(dmacro[A], dmacro[B], dmacro[C], x, y, de[0], de[1]) +
                          2.0 * form(macro[A] + s * dmacro[A], macro[B] + s * dmacro[B],
                                     macro[C] + s * dmacro[C], de[0], de[1], de[0], de[1]);
    largest = std::max(largest, std::abs(second));
  }
  return largest;
}

bool ParaboloidBending::do_admissible(std::span<const double> macro) const
{
  return std::isfinite(macro[A]) && std::isfinite(macro[B]) && std::isfinite(macro[C]);
}

std::pair<double, double> ParaboloidBending::do_stretch_range(std::span<const double> macro) const
{
  // Nothing repeats. A radius of curvature far below an element's says that nothing holds the patch.
  return {1.0, 1.0 + std::abs(macro[A]) + std::abs(macro[B]) + std::abs(macro[C])};
}

void ParaboloidBending::do_load(double theta, std::span<double> t) const
{
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  t[A] = 2.0 * c * c;
  t[B] = 2.0 * s * s;
  t[C] = 2.0 * c * s;
}

double ParaboloidBending::do_value(double theta, std::span<const double> macro) const
{
  double t[3];
  do_load(theta, t);
  return t[A] * macro[A] + t[B] * macro[B] + t[C] * macro[C];
}

void ParaboloidBending::do_metric(std::span<double> m) const
{
  // The squared Frobenius norm of [[A, C/2], [C/2, B]].
  m[A] = m[B] = 1.0;
  m[C] = 0.5;
}

bool ParaboloidBending::do_transform(const Mat3& O, std::span<const double> macro,
                                     std::span<double> out) const
{
  if (!keeps_plane(O)) return false;
  // z = x . K x with K = [[A, C/2], [C/2, B]]. Moved by O, z' = O_zz z at x' = O x: K' = O_zz O K O^T, so
  // that what is turned upside down bends down for up. The mean of x' is zero with that of x, and the turn
  // about z changes its sign at most.
  Eigen::Matrix2d K;
  K << macro[A], 0.5 * macro[C], 0.5 * macro[C], macro[B];
  const Eigen::Matrix2d O2 = O.topLeftCorner<2, 2>();
  const Eigen::Matrix2d turned = (O(2, 2) > 0.0 ? 1.0 : -1.0) * O2 * K * O2.transpose();
  out[A] = turned(0, 0);
  out[B] = turned(1, 1);
  out[C] = turned(0, 1) + turned(1, 0);
  return true;
}

std::vector<LinearEquality> ParaboloidBending::do_equalities(std::span<const Vec3> X) const
{
  if (hold_.places) return {};
  LinearEquality mean_x{"mean x", {}};
  LinearEquality mean_y{"mean y", {}};
  LinearEquality turn{"turn about z", {}};
  for (int i = 0; i < static_cast<int>(X.size()); ++i) {
    const Vec3& rest = X[i];
    mean_x.terms.push_back({i, 0, 1.0});
    mean_y.terms.push_back({i, 1, 1.0});
    turn.terms.push_back({i, 0, -rest.y()});
    turn.terms.push_back({i, 1, rest.x()});
  }
  return {mean_x, mean_y, turn};
}

Boundedness ParaboloidBending::do_boundedness(std::span<const double> /*load*/,
                                              std::span<const Vec3> /*cycles*/) const
{
  return Boundedness::attained;
}

std::vector<std::string> ParaboloidBending::do_hold() const
{
  std::vector<std::string> names;
  if (hold_.places) names.emplace_back("places");
  if (hold_.twist) names.emplace_back("twist");
  if (hold_.transverse) names.emplace_back("transverse");
  return names;
}

std::vector<MacroCondition> ParaboloidBending::do_conditions(double theta) const
{
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  std::vector<MacroCondition> out;
  if (hold_.twist) out.push_back({"twist", {-2.0 * c * s, 2.0 * c * s, c * c - s * s}});
  if (hold_.transverse) out.push_back({"transverse", {2.0 * s * s, 2.0 * c * c, -2.0 * c * s}});
  return out;
}

std::string ParaboloidBending::do_not_a_sheet(const SheetState& state) const
{
  if (std::string why =
          bent_too_tightly(state, largest_curvature(state.macro), "at the apex the radius of curvature is");
      !why.empty())
    return why;
  const auto own = static_cast<std::size_t>(do_coordinate_count());
  const auto place = [&](std::size_t i, std::size_t axis) {
    return state.X[i][axis] + (axis < own ? state.e[i * own + axis] : 0.0);
  };
  return parted(state, "surface", [&](std::size_t i, std::size_t j, const Vec3&) {
    const double x = place(i, 0), y = place(i, 1);
    return length_along(state.macro, x, y, place(j, 0) - x, place(j, 1) - y);
  });
}

bool ParaboloidBending::do_contains(const LoadCase& other) const
{
  // Elements at their places keep the mean of the patch, and it has no turn.
  const auto* o = dynamic_cast<const ParaboloidBending*>(&other);
  return o != nullptr && (o->hold_.places || !hold_.places) && (o->hold_.twist || !hold_.twist) &&
         (o->hold_.transverse || !hold_.transverse);
}

}  // namespace hauberk
