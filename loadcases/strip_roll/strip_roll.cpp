#include "strip_roll.hpp"

#include "common/conditions.hpp"
#include "common/sheet.hpp"
#include "common/stumpff.hpp"

#include <hauberk/kit/jet.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk {
namespace {

constexpr int exx = 0, curvature = 1, unknowns = 2;

/// The position as a polynomial of second order in the unknowns and those of (u_x, s, z) that are free. `at`
/// is (u_x, s, z), `x` the place along the axis at rest.
template <bool slides, bool lifts>
void place(std::span<const double> macro, double x, const Vec3& at, PositionMap& out)
{
  constexpr int n = unknowns + (slides ? 2 : 0) + (lifts ? 1 : 0);
  using J = kit::Jet<double, n, 2>;
  J along(at.x()), s(at.y()), z(at.z());
  if constexpr (slides) along = J::variable(at.x(), unknowns), s = J::variable(at.y(), unknowns + 1);
  if constexpr (lifts) z = J::variable(at.z(), n - 1);
  const J strain = J::variable(macro[exx], exx), k = J::variable(macro[curvature], curvature);
  const J angle = k * s, q = square(angle);
  const Stumpff stumpff(q.value());
  const auto c = [&](int j) { return J::compose(q, stumpff.taylor(j)); };
  const std::array<J, 3> position{(J(1.0) + strain) * J(x) + along, (s - angle * z) * c(1),
                                  angle * s * c(2) + z * c(0)};
  out.curved = true;
  using M = kit::Monomials<n, 2>;
  for (int i = 0; i < 3; ++i) {
    out.x[i] = position[i].value();
    for (int a = 0; a < n; ++a) {
      out.J(i, a) = position[i].slope(a);
      for (int b = 0; b < n; ++b) out.H[i][a][b] = position[i].c[M::place(a, b)] * (a == b ? 2.0 : 1.0);
    }
  }
}

}  // namespace

StripRoll::StripRoll(bool places, bool lifts) : places_(places), lifts_(lifts), macros_{{"exx", 0}, {"k", -1}}
{
}

Vec3 StripRoll::on_sheet(std::span<const double> e, const Vec3& X) const
{
  Vec3 at(0.0, X.y(), X.z());
  if (!places_) at.head<2>() += Eigen::Vector2d(e[0], e[1]);
  if (lifts_) at.z() += e[lift()];
  return at;
}

void StripRoll::do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X,
                            const Vec3& T, PositionMap& out) const
{
  const Vec3 at = on_sheet(e, X);
  const double x = X.x() + T.x();
  if (!places_)
    lifts_ ? place<true, true>(macro, x, at, out) : place<true, false>(macro, x, at, out);
  else
    lifts_ ? place<false, true>(macro, x, at, out) : place<false, false>(macro, x, at, out);
}

double StripRoll::do_acceleration_bound(std::span<const double> macro, std::span<const double> dmacro,
                                        std::span<const double> e, std::span<const double> de, const Vec3& X,
                                        const Vec3& /*T*/) const
{
  // Around the axis (y, h) is the integral of s (cos(t k s), sin(t k s)) over t in [0, 1], and z times the
  // normal. With the angle a = k s, quadratic on the path, a' is largest at an end and a'' constant; second
  // derivatives of the mean of unit vectors are at most a'^2/3 + |a''|/2, those of the normal a'^2 + |a''|.
  // Along the axis the position is linear.
  const Vec3 at = on_sheet(e, X), rate = on_sheet(de, Vec3::Zero());
  const double k = macro[curvature], dk = dmacro[curvature];
  const double begin = dk * at.y() + k * rate.y(), second = 2.0 * dk * rate.y();
  const double turn = std::max(std::abs(begin), std::abs(begin + second)), bend = std::abs(second);
  const double far = std::max(std::abs(at.y()), std::abs(at.y() + rate.y()));
  const double high = std::max(std::abs(at.z()), std::abs(at.z() + rate.z()));
  return far * (turn * turn / 3.0 + 0.5 * bend) + turn * std::abs(rate.y()) + high * (turn * turn + bend) +
         2.0 * turn * std::abs(rate.z());
}

void StripRoll::do_load(double theta, std::span<double> t) const
{
  const double s = std::sin(theta);
  t[exx] = 0.0;
  t[curvature] = s * s;
}

void StripRoll::do_metric(std::span<double> m) const { m[exx] = m[curvature] = 1.0; }

bool StripRoll::do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const
{
  // What keeps the axis, the way around it and the normal, each up to its sense. What is turned over bends
  // down for up.
  const bool keeps = O.cwiseAbs().isApprox(Mat3::Identity(), 1e-9);
  if (!keeps) return false;
  out[exx] = macro[exx];
  out[curvature] = (O(2, 2) > 0.0 ? 1.0 : -1.0) * macro[curvature];
  return true;
}

std::vector<LinearEquality> StripRoll::do_equalities(std::span<const Vec3> X) const
{
  std::vector<LinearEquality> out;
  Conditions conditions(X, out);
  using Vec1 = Eigen::Matrix<double, 1, 1>;
  if (!places_) {
    conditions.add<1>("mean along the axis", 0, [](const Vec3&) { return Vec1(1.0); });
    conditions.add<1>("mean around the axis", 1, [](const Vec3&) { return Vec1(1.0); });
  }
  if (!lifts_) return out;
  // Heights that are a quadratic polynomial in the place around the axis are another curvature, another turn
  // about the axis or another height of the same strip.
  conditions.add<1>("mean height", lift(), [](const Vec3&) { return Vec1(1.0); });
  conditions.add<1>("tilt", lift(), [](const Vec3& x) { return Vec1(x.y()); });
  conditions.add<1>("bend", lift(), [](const Vec3& x) { return Vec1(x.y() * x.y()); });
  return out;
}

std::vector<std::string> StripRoll::do_hold() const
{
  return places_ ? std::vector<std::string>{"places"} : std::vector<std::string>{};
}

std::vector<StricterLoadCase> StripRoll::do_stricter() const
{
  std::vector<StricterLoadCase> out;
  if (lifts_) out.push_back({"z fixed", std::make_unique<StripRoll>(places_, false)});
  if (!places_) out.push_back({"places held", std::make_unique<StripRoll>(true, lifts_)});
  return out;
}

bool StripRoll::do_contains(const LoadCase& other) const
{
  const auto* o = dynamic_cast<const StripRoll*>(&other);
  return o != nullptr && (lifts_ || !o->lifts_) && (o->places_ || !places_);
}

std::string StripRoll::do_not_a_sheet(const SheetState& state) const
{
  const double k = std::abs(state.macro[curvature]);
  if (std::string why = bent_too_tightly(state, k, "the radius of the roll is"); !why.empty()) return why;
  const auto own = static_cast<std::size_t>(do_coordinate_count());
  const double stretch = 1.0 + state.macro[exx];
  const auto at = [&](std::size_t i, const Vec3& T) -> Eigen::Vector2d {
    const Vec3 there = on_sheet(state.e.subspan(i * own, own), state.X[i]);
    return {stretch * (state.X[i].x() + T.x()) + there.x(), there.y()};
  };
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < state.X.size(); ++i) {
    const double around = at(i, Vec3::Zero()).y();
    low = std::min(low, around);
    high = std::max(high, around);
  }
  if (std::string why = rolled_too_often(k, high - low, "the strip"); !why.empty()) return why;
  return parted(state, "sheet", [&](std::size_t i, std::size_t j, const Vec3& T) {
    return (at(j, T) - at(i, Vec3::Zero())).norm();
  });
}

}  // namespace hauberk
