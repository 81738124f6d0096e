#include "geometry/separation.hpp"

#include "geometry/core.hpp"
#include "geometry/facets.hpp"
#include "geometry/panel_field.hpp"
#include "geometry/spine.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace hauberk {
namespace {

constexpr double smallest_panel = 1e-10;  ///< radians; below it rounding of the angle dominates
/// Surfaces that conform all around at a gap near rounding take so many; what is left then stays as coarse as
/// it is.
constexpr int most_evaluations = 2000000;
using std::numbers::pi;
/// Gaps below this part of the lengths they are the difference of are none: rounding decides their sign.
constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();

/// Branch and bound over the panels of one frame.
template <int dim>
class PanelSearch {
 public:
  PanelSearch(const PairFrame& frame, double clearance, double enough, double tightness)
      : probe_(frame),
        shift_(probe_.offset + clearance),
        touching_(gap_rounding(frame)),
        enough_(enough),
        tightness_(tightness)
  {
    found_.lower = found_.upper = std::numeric_limits<double>::infinity();
  }

  Separation run()
  {
    const FirstPanels<dim> first(probe_);
    for (int k = first.rows(); k-- > 0;) {
      std::array<PanelField, most_together> row = first.row(k);
      fill_fields(*probe_.f.F, row);
      for (std::size_t j = row.size(); j-- > 0;)
        if (!visit(row[j])) return found_;
    }
    // Near contact the bounds are as sharp as rounding lets them be.
    if (found_.lower > 0.0) found_.lower = std::max(0.0, found_.lower - touching_);
    return found_;
  }

 private:
  double needed() const { return std::min(enough_, tightness_ * found_.upper); }

  /// False where the search is over: the bodies touch.
  bool visit(PanelField& p)
  {
    // What is taken off for rounding in the end is asked for, too.
    const double least = needed() + touching_;
    const PanelBound b = bound_of(probe_, p, least + shift_);
    ++found_.evaluations;
    found_.upper = std::min(found_.upper, b.value - shift_);
    if (found_.upper <= touching_) {
      found_.lower = std::min(found_.upper, 0.0);
      return false;
    }
    const double lower = b.bound - shift_;
    if (lower >= needed() || p.s.hu < smallest_panel || found_.evaluations >= most_evaluations) {
      found_.lower = std::min(found_.lower, lower);
      return true;
    }
    if (leaves_a_rest(probe_, p)) found_.lower = std::min(found_.lower, least);
    std::array<PanelField, 2> half = split(probe_, p);
    return visit(half[0]) && visit(half[1]);
  }

  Probe<dim> probe_;
  double shift_, touching_, enough_, tightness_;
  Separation found_;
};

template <int dim>
Separation bound_over_panels(const PairFrame& frame, double clearance, double enough, double tightness)
{
  return PanelSearch<dim>(frame, clearance, enough, tightness).run();
}

/// Corners of a polygon that is nowhere farther than `near` from the core of a body, world frame.
std::vector<Vec3> core_polygon(const Body& body, const Pose& pose, double near)
{
  // A chord over h radians of a curve is |x_uu| h^2/8 from it at most.
  const double second = core_bounds(body).second;
  const int count = std::max(6, static_cast<int>(std::ceil(2.0 * pi / std::sqrt(8.0 * near / second))));
  const Frame frame = world_frame(body, pose);
  std::vector<Vec3> corners;
  corners.reserve(count);
  for (int i = 0; i < count; ++i) {
    const Angle u(2.0 * pi * i / count);
    corners.emplace_back(frame.center + frame.axes * core_at(body, u).x);
  }
  return corners;
}

/// Cores closer than this part of their sizes are counted as if they were not: tubes are thicker.
constexpr double closest_cores = 2e-5;

/// That of two polygons to which the cores may be pulled without crossing each other, as both together go
/// less far than the cores are apart.
int linking_of_curves(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b)
{
  const double cores = separation(A, pose_a, B, pose_b, -(A.r0 + std::min(B.r0, B.r1)), A.bound).lower;
  const double near = 0.4 * std::max(cores, closest_cores * (A.bound + B.bound));
  return linking_of_polygons(core_polygon(A, pose_a, near), core_polygon(B, pose_b, near));
}

/// A loop of a mesh in the world, and a ball that holds it.
struct PlacedLoop {
  std::vector<Vec3> corners;
  Vec3 center = Vec3::Zero();
  double radius = 0.0;
};

std::vector<PlacedLoop> placed_loops(const Body& body, const Pose& pose)
{
  const Frame frame = world_frame(body, pose);
  std::vector<PlacedLoop> out;
  out.reserve(body.facets->loops().size());
  for (const std::vector<Vec3>& loop : body.facets->loops()) {
    PlacedLoop& placed = out.emplace_back();
    placed.corners.reserve(loop.size());
    for (const Vec3& x : loop) {
      placed.corners.emplace_back(frame.center + frame.axes * x);
      placed.center += placed.corners.back() / static_cast<double>(loop.size());
    }
    for (const Vec3& x : placed.corners) placed.radius = std::max(placed.radius, (x - placed.center).norm());
  }
  return out;
}

/// Greatest common divisor of the linking numbers of all loops of one with all of the other. Loops generate
/// what there is to be linked, so other generators give the same.
int linking_of_meshes(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b)
{
  const std::vector<PlacedLoop> a = placed_loops(A, pose_a), b = placed_loops(B, pose_b);
  int divisor = 0;
  for (const PlacedLoop& p : a) {
    for (const PlacedLoop& q : b) {
      if ((p.center - q.center).norm() >= p.radius + q.radius) continue;
      divisor = std::gcd(divisor, linking_of_polygons(p.corners, q.corners));
      if (divisor == 1) return divisor;
    }
  }
  return divisor;
}

/// Closed polygons inside of a body that is no mesh: what a closed curve outside of it is linked with, it is
/// linked with one of them.
std::vector<std::vector<Vec3>> core_polygons(const Body& body, const Pose& pose)
{
  constexpr double within = 0.4;  // of the thickness
  if (!body.solid || is_round(body)) return {core_polygon(body, pose, within * std::min(body.r0, body.r1))};
  const Frame frame = world_frame(body, pose);
  std::vector<std::vector<Vec3>> out = body.solid->cores();
  for (std::vector<Vec3>& core : out)
    for (Vec3& x : core) x = frame.center + frame.axes * (x / body.unit);
  return out;
}

/// As linking_of_meshes().
int linking_of_cores(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b)
{
  if (ball_gap(A, pose_a, B, pose_b, 0.0) > 0.0) return 0;
  const auto a = core_polygons(A, pose_a), b = core_polygons(B, pose_b);
  int divisor = 0;
  for (const std::vector<Vec3>& p : a)
    for (const std::vector<Vec3>& q : b) divisor = std::gcd(divisor, linking_of_polygons(p, q));
  return divisor;
}

}  // namespace

double gap_rounding(const PairFrame& frame)
{
  return rounding * (frame.a.norm() + frame.P->bound + frame.F->bound);
}

double ball_gap(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b, double clearance)
{
  const Vec3 ca = pose_a.position + pose_a.rotation * A.center;
  const Vec3 cb = pose_b.position + pose_b.rotation * B.center;
  // Where they touch at the closest points of the surfaces they leave nothing for rounding.
  const double size = pose_a.position.norm() + A.center.norm() + A.bound + pose_b.position.norm() +
                      B.center.norm() + B.bound + clearance;
  return (ca - cb).norm() - A.bound - B.bound - clearance - rounding * size;
}

Separation separation(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b, double clearance,
                      double enough, double tightness)
{
  if (A.surface || B.surface)
    throw InputError(
        "distances of surfaces are not known of triangle meshes: set solver.contact to \"mesh\"");
  // Balls first: most pairs end here.
  const double coarse = ball_gap(A, pose_a, B, pose_b, clearance);
  if (coarse >= enough) return {coarse, std::numeric_limits<double>::infinity(), 0};

  const bool swapped = second_probes(A, B);
  const Body &P = swapped ? B : A, &F = swapped ? A : B;
  const Pose &pose_p = swapped ? pose_b : pose_a, &pose_f = swapped ? pose_a : pose_b;
  const PairFrame frame(P, pose_p, F, pose_f);
  if (probe_dimension(frame) == 1) return bound_over_panels<1>(frame, clearance, enough, tightness);
  if (frame.difference == nullptr) {
    // A core that is probed knows the inside of its own tube; a surface does not. Where all of F is inside of
    // P, so is any point of it.
    const double inside = field_at(P, Probe<2>(PairFrame(F, pose_f, P, pose_p)).at(0.0, 0.0).p).m.phi;
    if (inside < 0.0) return {inside - clearance, inside - clearance, 1};
  }
  return bound_over_panels<2>(frame, clearance, enough, tightness);
}

int linking_number(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b)
{
  if (A.surface || B.surface) {
    if (!A.facets || !B.facets)
      throw InputError("links of triangle meshes are those of facets: set solver.contact to \"mesh\"");
    return linking_of_meshes(A, pose_a, B, pose_b);
  }
  if (A.solid || B.solid) return linking_of_cores(A, pose_a, B, pose_b);
  if (A.curve || B.curve) return linking_of_curves(A, pose_a, B, pose_b);
  // In B's frame the disc is z = 0, rho < R_B. The core of A is a + R (cos u e1 + sin u e2), so
  // z(u) = a_z + R h cos(u - u0) with h = hypot(e1_z, e2_z).
  const PairFrame f(A, pose_a, B, pose_b);
  const double h = std::hypot(f.e1.z(), f.e2.z());
  if (h * A.R <= std::abs(f.a.z())) return 0;
  const double u0 = std::atan2(f.e2.z(), f.e1.z());
  const double w = std::acos(-f.a.z() / (A.R * h));
  int crossings = 0;
  for (const int sign : {-1, 1}) {
    const double u = u0 + sign * w;
    const Vec3 p = f.a + A.R * (std::cos(u) * f.e1 + std::sin(u) * f.e2);
    // dz/du = -R h sin(u - u0): upwards at u0 - w, downwards at u0 + w.
    if (std::hypot(p.x(), p.y()) < B.R) crossings -= sign;
  }
  return crossings;
}

}  // namespace hauberk
