#include <hauberk/geometry/facets.hpp>

#include "box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace hauberk {
namespace {

constexpr double pi = std::numbers::pi;

/// Gives every point and edge to the first triangle that has it.
void give_features(std::vector<Facets::Triangle>& triangles, std::vector<std::array<int, 2>>& edges,
                   std::size_t point_count)
{
  std::vector<bool> owned(point_count, false);
  std::map<std::array<int, 2>, int> numbers;
  for (Facets::Triangle& t : triangles) {
    t.own_points.fill(-1);
    t.own_edges.fill(-1);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto point = static_cast<std::size_t>(t.points[k]);
      if (!owned[point]) t.own_points[k] = t.points[k];
      owned[point] = true;
      const int a = t.points[k], b = t.points[(k + 1) % 3];
      const auto [at, added] =
          numbers.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(edges.size()));
      if (!added) continue;
      t.own_edges[k] = at->second;
      edges.push_back({a, b});
    }
  }
}

}  // namespace

Facets::Facets(double R, double r0, double r1, int n)
{
  const auto size = static_cast<std::size_t>(n);
  points_.reserve(size * size);
  by_size_.reserve(size * size);
  for (int i = 0; i < n; ++i) {
    const double u = 2.0 * pi * (i + 0.5) / n, cu = std::cos(u), su = std::sin(u);
    for (int j = 0; j < n; ++j) {
      const double v = pi + 2.0 * pi * (j + 0.5) / n, cv = std::cos(v), sv = std::sin(v);
      Mat3 by;
      by << cu, cv * cu, 0.0, su, cv * su, 0.0, 0.0, 0.0, sv;
      points_.emplace_back(by * Vec3(R, r0, r1));
      by_size_.push_back(by);
    }
  }
  triangles_.reserve(2 * size * size);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int i1 = (i + 1) % n, j1 = (j + 1) % n;
      const int a = i * n + j, b = i1 * n + j, c = i1 * n + j1, d = i * n + j1;
      triangles_.push_back({{a, b, c}, {}, {}});
      triangles_.push_back({{a, c, d}, {}, {}});
    }
  }
  edges_.reserve(3 * size * size);
  give_features(triangles_, edges_, points_.size());
  double sum = 0.0;
  for (const auto& [a, b] : edges_)
    sum += (points_[static_cast<std::size_t>(a)] - points_[static_cast<std::size_t>(b)]).norm();
  mean_edge_ = sum / static_cast<double>(edges_.size());

  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  for (const Triangle& t : triangles_) {
    Vec3 low = points_[static_cast<std::size_t>(t.points[0])], high = low;
    for (const int k : t.points) {
      low = low.cwiseMin(points_[static_cast<std::size_t>(k)]);
      high = high.cwiseMax(points_[static_cast<std::size_t>(k)]);
    }
    boxes.push_back({0.5 * (low + high), 0.5 * (high - low)});
  }
  tree_ = std::make_unique<const Tree>(boxes);
}

Facets::~Facets() = default;

namespace {

/// Corners of a triangle of P, in F's frame.
std::array<Vec3, 3> corners_in(const PairFrame& frame, const Mat3& axes, const Facets& facets,
                               const Facets::Triangle& t)
{
  std::array<Vec3, 3> out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = frame.a + axes * facets.points()[static_cast<std::size_t>(t.points[k])];
  return out;
}

std::array<Vec3, 3> corners_of(const Facets& facets, const Facets::Triangle& t)
{
  std::array<Vec3, 3> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = facets.points()[static_cast<std::size_t>(t.points[k])];
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
  visit_near(frame.P->facets->tree(), frame.F->facets->tree(), axes_of(frame), frame.a, range, visit);
}

}  // namespace

void near_features(const PairFrame& frame, double range, const FeatureVisitor& visit)
{
  const Facets &P = *frame.P->facets, &F = *frame.F->facets;
  const Mat3 axes = axes_of(frame);
  near_triangles(frame, range, [&](int tp, int tf) {
    const Facets::Triangle& p = P.triangles()[static_cast<std::size_t>(tp)];
    const Facets::Triangle& f = F.triangles()[static_cast<std::size_t>(tf)];
    const std::array<Vec3, 3> cp = corners_in(frame, axes, P, p), cf = corners_of(F, f);
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

namespace {

/// True if the segment from a to b meets the triangle.
bool segment_meets(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t)
{
  const Vec3 along = b - a, e1 = t[1] - t[0], e2 = t[2] - t[0];
  const Vec3 q = along.cross(e2);
  const double det = e1.dot(q);
  if (det == 0.0) return false;
  const Vec3 s = a - t[0];
  const double u = s.dot(q) / det;
  const Vec3 r = s.cross(e1);
  const double v = along.dot(r) / det, w = e2.dot(r) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && w >= 0.0 && w <= 1.0;
}

}  // namespace

bool facets_intersect(const PairFrame& frame)
{
  const Facets &P = *frame.P->facets, &F = *frame.F->facets;
  const Mat3 axes = axes_of(frame);
  bool found = false;
  near_triangles(frame, 0.0, [&](int tp, int tf) {
    if (found) return;
    const auto cp = corners_in(frame, axes, P, P.triangles()[static_cast<std::size_t>(tp)]);
    const auto cf = corners_of(F, F.triangles()[static_cast<std::size_t>(tf)]);
    for (std::size_t k = 0; k < 3 && !found; ++k)
      found = segment_meets(cp[k], cp[(k + 1) % 3], cf) || segment_meets(cf[k], cf[(k + 1) % 3], cp);
  });
  return found;
}

}  // namespace hauberk
