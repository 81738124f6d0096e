#include "geometry/facets.hpp"

#include "geometry/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk {
namespace {

/// Corners of a triangle of P, in F's frame.
std::array<Vec3, 3> corners_in(const PairFrame& frame, const Mat3& axes, const Facets& facets,
                               const Facets::Triangle& t)
{
  std::array<Vec3, 3> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = frame.a + axes * facets.points()[t.points[k]];
  return out;
}

Mat3 axes_of(const PairFrame& frame)
{
  Mat3 axes;
  axes << frame.e1, frame.e2, frame.e3;
  return axes;
}

/// Pairs of triangles whose boxes are within `range`: visit(P's triangle, F's triangle).
template <class Visit>
void near_triangles(const PairFrame& frame, double range, const Visit& visit)
{
  visit_near(frame.P->facets->tree(), frame.F_facets->tree(), axes_of(frame), frame.a, range, visit);
}

}  // namespace

void near_features(const PairFrame& frame, double range, const FeatureVisitor& visit)
{
  const Facets &P = *frame.P->facets, &F = *frame.F_facets;
  const Mat3 axes = axes_of(frame);
  near_triangles(frame, range, [&](int tp, int tf) {
    const Facets::Triangle& p = P.triangles()[tp];
    const Facets::Triangle& f = F.triangles()[tf];
    const std::array<Vec3, 3> cp = corners_in(frame, axes, P, p), cf = F.corners(f);
    for (std::size_t k = 0; k < 3; ++k) {
      if (p.own_points[k] >= 0) visit({{p.own_points[k]}, f.points, 1, 3}, {cp[k]}, cf);
      if (f.own_points[k] >= 0) visit({p.points, {f.own_points[k]}, 3, 1}, cp, {cf[k]});
      if (p.own_edges[k] < 0) continue;
      const std::size_t k1 = (k + 1) % 3;
      for (std::size_t l = 0; l < 3; ++l) {
        const std::size_t l1 = (l + 1) % 3;
        if (f.own_edges[l] < 0) continue;
        visit({{p.points[k], p.points[k1]}, {f.points[l], f.points[l1]}, 2, 2}, {cp[k], cp[k1]},
              {cf[l], cf[l1]});
      }
    }
  });
}

bool segment_meets(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle)
{
  // Heights over the triangle's plane, times twice its area.
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double ha = normal.dot(a - triangle[0]), hb = normal.dot(b - triangle[0]);
  const double size = a.norm() + b.norm() + triangle[0].norm();
  constexpr double roundings = 16.0 * std::numeric_limits<double>::epsilon();
  if (std::max(std::abs(ha), std::abs(hb)) <= roundings * size * normal.norm()) return false;
  if ((ha > 0.0 && hb > 0.0) || (ha < 0.0 && hb < 0.0)) return false;
  const Vec3 x = a + ha / (ha - hb) * (b - a);
  for (std::size_t k = 0; k < 3; ++k) {
    if (normal.dot((triangle[(k + 1) % 3] - triangle[k]).cross(x - triangle[k])) < 0.0) return false;
  }
  return true;
}

bool facets_intersect(const PairFrame& frame)
{
  const Facets &P = *frame.P->facets, &F = *frame.F_facets;
  const Mat3 axes = axes_of(frame);
  bool found = false;
  near_triangles(frame, 0.0, [&](int tp, int tf) {
    if (found) return;
    const auto cp = corners_in(frame, axes, P, P.triangles()[tp]);
    const auto cf = F.corners(F.triangles()[tf]);
    for (std::size_t k = 0; k < 3 && !found; ++k)
      found = segment_meets(cp[k], cp[(k + 1) % 3], cf) || segment_meets(cf[k], cf[(k + 1) % 3], cp);
  });
  return found;
}

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

namespace {

/// True if x, in the mesh's frame, is inside of it: its parts, seen from there, cover the sphere.
bool encloses(const Facets& mesh, const Vec3& x)
{
  double angle = 0.0;
  for (const Facets::Triangle& t : mesh.triangles()) {
    const std::array<Vec3, 3> c = mesh.corners(t);
    angle += solid_angle(c[0] - x, c[1] - x, c[2] - x);
  }
  return std::abs(angle) > 2.0 * std::numbers::pi;
}

}  // namespace

bool encloses(const Facets& mesh, const std::vector<Vec3>& polygon)
{
  if (!encloses(mesh, polygon.front())) return false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const auto meets = [&](const Facets::Triangle& t) { return segment_meets(a, b, mesh.corners(t)); };
    if (std::any_of(mesh.triangles().begin(), mesh.triangles().end(), meets)) return false;
  }
  return true;
}

bool facets_inside(const PairFrame& frame)
{
  const Facets &P = *frame.P->facets, &F = *frame.F_facets;
  const Mat3 axes = axes_of(frame);
  const auto point_of = [](const Facets& mesh, int k) { return mesh.points()[k]; };
  return std::any_of(P.parts().begin(), P.parts().end(),
                     [&](int k) { return encloses(F, frame.a + axes * point_of(P, k)); }) ||
         std::any_of(F.parts().begin(), F.parts().end(),
                     [&](int k) { return encloses(P, axes.transpose() * (point_of(F, k) - frame.a)); });
}

}  // namespace hauberk
