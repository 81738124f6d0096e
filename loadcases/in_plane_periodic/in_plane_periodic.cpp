#include "in_plane_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

/// Sine of the angle below which two directions count as parallel: rounding of rotated lattice vectors and of
/// angles in degrees stays far below it.
constexpr double parallel_sine = 1e-9;

/// In-plane length, scaled by L, below which the translation of a cycle is zero up to rounding: others are
/// lattice vectors, not shorter than an element.
constexpr double zero_translation = 1e-9;

/// Eigenvalue, relative to the other one, that is zero up to rounding: that of a load along one line.
constexpr double zero_eigenvalue = 1e-14;

enum { exx, eyy, exy };  // order of the macroscopic unknowns

/// Eigenvalues and eigenvectors of the symmetric matrix [[xx, xy], [xy, yy]]. Forms are sums over them, so
/// that a load along a line keeps all digits of the small rate nearly across that line.
struct Spectrum {
  double larger = 0.0, smaller = 0.0;
  double vx = 1.0, vy = 0.0;  ///< of the larger one; (-vy, vx) of the smaller

  Spectrum(double xx, double yy, double xy)
  {
    const double mean = 0.5 * (xx + yy);
    const double radius = std::hypot(0.5 * (xx - yy), xy);
    const double angle = 0.5 * std::atan2(xy, 0.5 * (xx - yy));
    larger = mean + radius;
    smaller = mean - radius;
    if (std::abs(larger) < zero_eigenvalue * std::abs(smaller)) larger = 0.0;
    if (std::abs(smaller) < zero_eigenvalue * std::abs(larger)) smaller = 0.0;
    vx = std::cos(angle);
    vy = std::sin(angle);
  }

  /// (ax, ay) . M (bx, by)
  double form(double ax, double ay, double bx, double by) const
  {
    return larger * (vx * ax + vy * ay) * (vx * bx + vy * by) +
           smaller * (vx * ay - vy * ax) * (vx * by - vy * bx);
  }
};

}  // namespace

InPlanePeriodic::InPlanePeriodic(StrainMeasure measure, OutOfPlane out_of_plane, Hold hold)
    : macros_{{"exx", 0}, {"eyy", 0}, {"exy", 0}}, measure_(measure), out_of_plane_(out_of_plane), hold_(hold)
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
  switch (measure_) {
    case StrainMeasure::tensor:
      t[exx] = c * c;
      t[eyy] = s * s;
      t[exy] = 2.0 * c * s;
      return;
    case StrainMeasure::equation_12:
      const double dd = c * c * c * c + s * s * s * s + c * c * s * s;
      t[exx] = c * c / dd;
      t[eyy] = s * s / dd;
      t[exy] = c * s / dd;
      return;
  }
}

double InPlanePeriodic::do_value(double theta, std::span<const double> macro) const
{
  double t[3]{};
  do_load(theta, t);
  return t[exx] * macro[exx] + t[eyy] * macro[eyy] + t[exy] * macro[exy];
}

std::string InPlanePeriodic::do_measure() const { return name_of(measure_); }

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

bool InPlanePeriodic::do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const
{
  if (!keeps_plane(O)) return false;
  // F' = O F O^T.
  Eigen::Matrix2d eps;
  eps << macro[exx], macro[exy], macro[exy], macro[eyy];
  const Eigen::Matrix2d O2 = O.topLeftCorner<2, 2>();
  const Eigen::Matrix2d turned = O2 * eps * O2.transpose();
  out[exx] = turned(0, 0);
  out[eyy] = turned(1, 1);
  out[exy] = 0.5 * (turned(0, 1) + turned(1, 0));
  return true;
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

Boundedness InPlanePeriodic::do_boundedness(std::span<const double> load, std::span<const Vec3> cycles) const
{
  // The load is the symmetric matrix M with load . macro = M : (F - I). The proof stands in the README,
  // "Which limits exist"; in short:
  //
  // Links bound F T for the translations T of their cycles, and packing bounds det F from below. If cycles
  // span the plane, admissible F are a compact set. If all are parallel to the unit vector t, with a across
  // it, only F : a a^T can grow for ever, at the rate M_aa: M_aa > 0 makes the load unbounded, M_aa < 0 makes
  // such states bad ones, so that the best is among a compact set. M_aa = 0 leaves M_tt p + 2 M_ta q, with F
  // t = (p, q), |F t| <= l and p > 0: chains turn while rows spread. The largest value is where F t is
  // parallel to (M_tt, 2 M_ta), which p > 0 allows where M_tt > 0; otherwise 2 |M_ta| l is approached as p
  // tends to 0. If there are no cycles, nothing holds any strain: the load is unbounded if M has a positive
  // eigenvalue, attained if M is negative definite, and approaches 0 at det F bounded below if it is
  // singular.
  const double scale = std::hypot(load[exx], load[eyy], load[exy]);
  const Spectrum M(load[exx] / scale, load[eyy] / scale, 0.5 * load[exy] / scale);
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
  if (longest <= zero_translation) {
    if (M.larger > 0.0) return Boundedness::unbounded;
    return M.larger < 0.0 ? Boundedness::attained : Boundedness::not_attained;
  }
  const bool spans = std::any_of(cycles.begin(), cycles.end(), [&](const Vec3& T) {
    const double length = std::hypot(T.x(), T.y());
    return length > zero_translation && std::abs(tx * T.y() - ty * T.x()) > parallel_sine * length;
  });
  if (spans) return Boundedness::attained;

  const double along = M.form(tx, ty, tx, ty);
  const double mixed = M.form(tx, ty, -ty, tx);
  const double across = M.form(-ty, tx, -ty, tx);
  // What a turn of the chains by the angle that counts as none changes the rate across by.
  const double none =
      2.0 * std::abs(mixed) * parallel_sine + std::abs(along - across) * parallel_sine * parallel_sine;
  if (across > none) return Boundedness::unbounded;
  if (across < -none) return Boundedness::attained;
  return along > parallel_sine ? Boundedness::attained : Boundedness::not_attained;
}

std::vector<std::string> InPlanePeriodic::do_hold() const
{
  std::vector<std::string> names;
  if (hold_.shear) names.emplace_back("shear");
  if (hold_.lateral) names.emplace_back("lateral");
  return names;
}

std::vector<MacroCondition> InPlanePeriodic::do_conditions(double theta) const
{
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  std::vector<MacroCondition> out;
  if (hold_.shear) out.push_back({"shear", {-c * s, c * s, c * c - s * s}});
  if (hold_.lateral) out.push_back({"lateral", {s * s, c * c, -2.0 * c * s}});
  return out;
}

Boundedness InPlanePeriodic::do_held_boundedness(double theta, std::span<const double> load,
                                                 std::span<const Vec3> cycles) const
{
  // With eps = a n n^T + b m m^T + g (n m^T + m n^T) a link cycle of the translation t, p = n . t and
  // q = m . t, bounds |F t|, and packing bounds det F from below. The load is ta a + tb b + tg g.
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const double scale = std::hypot(load[exx], load[eyy], load[exy]);
  const double ta = (c * c * load[exx] + s * s * load[eyy] + c * s * load[exy]) / scale;
  const double tb = (s * s * load[exx] + c * c * load[eyy] - c * s * load[exy]) / scale;
  bool along = false;   // some p is not zero
  bool across = false;  // some q is not zero
  for (const Vec3& T : cycles) {
    const double length = std::hypot(T.x(), T.y());
    if (length <= zero_translation) continue;
    along = along || std::abs(c * T.x() + s * T.y()) > parallel_sine * length;
    across = across || std::abs(c * T.y() - s * T.x()) > parallel_sine * length;
  }
  const auto sign = [](double t) { return std::abs(t) <= parallel_sine ? 0 : t > 0.0 ? 1 : -1; };
  const int on_a = sign(ta);
  const int on_b = hold_.lateral ? -1 : sign(tb);
  // b = 0. Where nothing bounds a, a load that pulls a has no end; one that pushes it ends, since det F does
  // not exceed 1 + a. With g free its share of the load is of lower order: g^2 < 1 + a.
  if (hold_.lateral) return on_a > 0 && !along ? Boundedness::unbounded : Boundedness::attained;
  // |F t|^2 = (1 + a)^2 p^2 + (1 + b)^2 q^2 and det F = (1 + a)(1 + b): each strain is bounded from above by
  // its own cycles, and from below while the other one is bounded.
  if ((on_a > 0 && !along) || (on_b > 0 && !across)) return Boundedness::unbounded;
  const bool thins_a = on_a < 0 && !across && on_b == 0;  // a falls for ever, as b grows at no price
  const bool thins_b = on_b < 0 && !along && on_a == 0;
  return thins_a || thins_b ? Boundedness::not_attained : Boundedness::attained;
}

std::vector<StricterLoadCase> InPlanePeriodic::do_stricter() const
{
  std::vector<StricterLoadCase> out;
  if (do_coordinate_count() == 3)
    out.push_back({"z fixed", std::make_unique<InPlanePeriodic>(measure_, OutOfPlane{}, hold_)});
  // One strain more; which one makes no difference to what both together hold.
  for (const auto& [name, more] : {std::pair{"shear held", Hold{true, hold_.lateral}},
                                   std::pair{"lateral strain held", Hold{hold_.shear, true}}}) {
    if (more.shear != hold_.shear || more.lateral != hold_.lateral)
      out.push_back({name, std::make_unique<InPlanePeriodic>(measure_, out_of_plane_, more)});
  }
  return out;
}

bool InPlanePeriodic::do_contains(const LoadCase& other) const
{
  const auto* o = dynamic_cast<const InPlanePeriodic*>(&other);
  if (o == nullptr || o->measure_ != measure_) return false;
  const bool layer = out_of_plane_.free ||
                     (!o->out_of_plane_.free && o->out_of_plane_.half_height <= out_of_plane_.half_height);
  return layer && (o->hold_.shear || !hold_.shear) && (o->hold_.lateral || !hold_.lateral);
}

}  // namespace hauberk
