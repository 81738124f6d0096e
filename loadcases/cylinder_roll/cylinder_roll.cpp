#include "cylinder_roll.hpp"

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

constexpr int kxx = 0, kyy = 1, kxy = 2, unknowns = 3;

Eigen::Matrix2d tensor(std::span<const double> macro)
{
  Eigen::Matrix2d K;
  K << macro[kxx], macro[kxy], macro[kxy], macro[kyy];
  return K;
}

/// Where a polynomial of second order in n unknowns has the monomial of two of them.
template <int n>
constexpr std::array<std::array<std::size_t, n>, n> pairs_of = [] {
  std::array<std::array<std::size_t, n>, n> places{};
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) places[a][b] = kit::Monomials<n, 2>::place(a, b);
  return places;
}();

/// The position as a polynomial of second order in the unknowns and those of (y, z) that are free.
template <bool slides, bool lifts>
void place(std::span<const double> macro, const Vec3& at, PositionMap& out)
{
  constexpr int n = unknowns + (slides ? 2 : 0) + (lifts ? 1 : 0);
  using J = kit::Jet<double, n, 2>;
  J y1(at.x()), y2(at.y()), z(at.z());
  if constexpr (slides) y1 = J::variable(at.x(), unknowns), y2 = J::variable(at.y(), unknowns + 1);
  if constexpr (lifts) z = J::variable(at.z(), n - 1);
  const J xx = J::variable(macro[kxx], kxx), yy = J::variable(macro[kyy], kyy),
          xy = J::variable(macro[kxy], kxy);
  const J k1 = xx * y1 + xy * y2, k2 = xy * y1 + yy * y2;
  const J p = k1 * y1 + k2 * y2, q = square(k1) + square(k2);
  const Stumpff stumpff(q.value());
  const auto c = [&](int j) { return J::compose(q, stumpff.taylor(j)); };
  const J back = c(3) * p + c(1) * z;
  const std::array<J, 3> x{y1 - back * k1, y2 - back * k2, c(2) * p + c(0) * z};
  out.curved = true;
  for (int i = 0; i < 3; ++i) {
    out.x[i] = x[i].value();
    for (int a = 0; a < n; ++a) {
      out.J(i, a) = x[i].slope(a);
      for (int b = 0; b < n; ++b) out.H[i][a][b] = x[i].c[pairs_of<n>[a][b]] * (a == b ? 2.0 : 1.0);
    }
  }
}

/// The curvature that is largest in size, and its direction.
struct Principal {
  double curvature;
  Eigen::Vector2d direction;
};
Principal principal(const Eigen::Matrix2d& K)
{
  const double mean = 0.5 * K.trace(), half = 0.5 * (K(0, 0) - K(1, 1));
  const double angle = 0.5 * (std::atan2(K(0, 1), half) + (mean < 0.0 ? std::numbers::pi : 0.0));
  return {std::abs(mean) + std::hypot(half, K(0, 1)), {std::cos(angle), std::sin(angle)}};
}

}  // namespace

CylinderRoll::CylinderRoll(Hold hold, bool lifts)
    : hold_(hold), lifts_(lifts), macros_{{"kxx", -1}, {"kyy", -1}, {"kxy", -1}}
{
}

Vec3 CylinderRoll::on_sheet(std::span<const double> e, const Vec3& X) const
{
  Vec3 at = X;
  if (!hold_.places) at.head<2>() += Eigen::Vector2d(e[0], e[1]);
  if (lifts_) at.z() += e[lift()];
  return at;
}

void CylinderRoll::do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X,
                               const Vec3& T, PositionMap& out) const
{
  const Vec3 at = on_sheet(e, X + T);
  if (!hold_.places)
    lifts_ ? place<true, true>(macro, at, out) : place<true, false>(macro, at, out);
  else
    lifts_ ? place<false, true>(macro, at, out) : place<false, false>(macro, at, out);
}

double CylinderRoll::do_acceleration_bound(std::span<const double> macro, std::span<const double> dmacro,
                                           std::span<const double> e, std::span<const double> de,
                                           const Vec3& X, const Vec3& T) const
{
  // Of a skew matrix W(s) the derivatives of exp W are at most |W'| and |W'|^2 + |W''| in norm (Duhamel), so
  // that those of its integral V = int exp(s W) ds are at most |W'|/2 and |W'|^2/3 + |W''|/2. Here |W| is |k|
  // with k = K y quadratic in s, so k' is linear and largest at an end; |y| and |z| are, too. And y'' = z'' =
  // 0 in x = V y + z exp(W) e_z.
  const Vec3 at = on_sheet(e, X + T), rate = on_sheet(de, Vec3::Zero());
  const Eigen::Vector2d y = at.head<2>(), dy = rate.head<2>();
  const Eigen::Matrix2d K = tensor(macro), dK = tensor(dmacro);
  const Eigen::Vector2d begin = dK * y + K * dy, second = 2.0 * (dK * dy);
  const double turn = std::max(begin.norm(), (begin + second).norm()), bend = second.norm();
  const double far = std::max(y.norm(), (y + dy).norm());
  const double high = std::max(std::abs(at.z()), std::abs(at.z() + rate.z()));
  return far * (turn * turn / 3.0 + 0.5 * bend) + turn * dy.norm() + high * (turn * turn + bend) +
         2.0 * turn * std::abs(rate.z());
}

void CylinderRoll::do_load(double theta, std::span<double> t) const
{
  const double c = std::cos(theta), s = std::sin(theta);
  t[kxx] = c * c;
  t[kyy] = s * s;
  t[kxy] = 2.0 * c * s;
}

void CylinderRoll::do_metric(std::span<double> m) const
{
  m[kxx] = m[kyy] = 1.0;  // the squared Frobenius norm of K
  m[kxy] = 2.0;
}

bool CylinderRoll::do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const
{
  if (!keeps_plane(O)) return false;
  // K' = O_zz O K O^T takes k to O_zz O k and p to O_zz p at O y: x' = O x. What is turned over bends down
  // for up. The conditions on elements are moments of what O takes to moments of the same order.
  const Eigen::Matrix2d O2 = O.topLeftCorner<2, 2>();
  const Eigen::Matrix2d K = (O(2, 2) > 0.0 ? 1.0 : -1.0) * O2 * tensor(macro) * O2.transpose();
  out[kxx] = K(0, 0);
  out[kyy] = K(1, 1);
  out[kxy] = K(0, 1);
  return true;
}

std::vector<LinearEquality> CylinderRoll::do_equalities(std::span<const Vec3> X) const
{
  std::vector<LinearEquality> out;
  Conditions conditions(X, out);
  using Vec2 = Eigen::Vector2d;
  using Vec1 = Eigen::Matrix<double, 1, 1>;
  if (!hold_.places) {
    conditions.add<2>("mean x", 0, [](const Vec3&) { return Vec2(1.0, 0.0); });
    conditions.add<2>("mean y", 0, [](const Vec3&) { return Vec2(0.0, 1.0); });
    conditions.add<2>("turn about z", 0, [](const Vec3& x) { return Vec2(-x.y(), x.x()); });
  }
  if (!lifts_) return out;
  // Heights that are a quadratic polynomial in place are another curvature, another tilt or another height
  // of the same patch: without them K is what fits the patch best (least squares, at rest's places).
  conditions.add<1>("mean height", lift(), [](const Vec3&) { return Vec1(1.0); });
  conditions.add<1>("tilt along x", lift(), [](const Vec3& x) { return Vec1(x.x()); });
  conditions.add<1>("tilt along y", lift(), [](const Vec3& x) { return Vec1(x.y()); });
  conditions.add<1>("bend xx", lift(), [](const Vec3& x) { return Vec1(x.x() * x.x()); });
  conditions.add<1>("bend yy", lift(), [](const Vec3& x) { return Vec1(x.y() * x.y()); });
  conditions.add<1>("bend xy", lift(), [](const Vec3& x) { return Vec1(x.x() * x.y()); });
  return out;
}

std::vector<std::string> CylinderRoll::do_hold() const
{
  std::vector<std::string> names;
  if (hold_.places) names.emplace_back("places");
  if (hold_.twist) names.emplace_back("twist");
  if (hold_.transverse) names.emplace_back("transverse");
  return names;
}

std::vector<MacroCondition> CylinderRoll::do_conditions(double theta) const
{
  const double c = std::cos(theta), s = std::sin(theta);
  std::vector<MacroCondition> out;
  if (hold_.twist) out.push_back({"twist", {-c * s, c * s, c * c - s * s}});
  if (hold_.transverse) out.push_back({"transverse", {s * s, c * c, -2.0 * c * s}});
  return out;
}

std::vector<StricterLoadCase> CylinderRoll::do_stricter() const
{
  std::vector<StricterLoadCase> out;
  if (lifts_) out.push_back({"z fixed", std::make_unique<CylinderRoll>(hold_, false)});
  for (const auto& [name, part] : {std::pair{"places held", &Hold::places},
                                   {"twist held", &Hold::twist},
                                   {"transverse curvature held", &Hold::transverse}}) {
    if (hold_.*part) continue;
    Hold more = hold_;
    more.*part = true;
    out.push_back({name, std::make_unique<CylinderRoll>(more, lifts_)});
  }
  return out;
}

bool CylinderRoll::do_contains(const LoadCase& other) const
{
  const auto* o = dynamic_cast<const CylinderRoll*>(&other);
  return o != nullptr && (lifts_ || !o->lifts_) && (o->hold_.places || !hold_.places) &&
         (o->hold_.twist || !hold_.twist) && (o->hold_.transverse || !hold_.transverse);
}

std::string CylinderRoll::do_not_a_sheet(const SheetState& state) const
{
  const Principal most = principal(tensor(state.macro));
  if (std::string why = bent_too_tightly(state, most.curvature, "the radius of the roll is"); !why.empty())
    return why;
  const auto own = static_cast<std::size_t>(do_coordinate_count());
  const auto at = [&](std::size_t i) -> Eigen::Vector2d {
    return on_sheet(state.e.subspan(i * own, own), state.X[i]).head<2>();
  };
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < state.X.size(); ++i) {
    const double along = most.direction.dot(at(i));
    low = std::min(low, along);
    high = std::max(high, along);
  }
  if (std::string why = rolled_too_often(most.curvature, high - low, "the patch"); !why.empty()) return why;
  return parted(state, "sheet",
                [&](std::size_t i, std::size_t j, const Vec3&) { return (at(j) - at(i)).norm(); });
}

}  // namespace hauberk
