#include "geometry/box_tree.hpp"
#include "geometry/surface_edges.hpp"

#include <hauberk/error.hpp>
#include <hauberk/triangle_surface.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

using Triangle = TriangleSurface::Triangle;
using Corners = std::array<Vec3, 3>;

/// Of lengths over the mean distance: triangles lower than this have no area,
constexpr double lowest_triangle = 1e-9;
/// and those nearer to each other than this meet.
constexpr double meeting = 1e-12;
/// Larger coordinates overflow in products of three, smaller ones underflow.
constexpr double largest_coordinate = 1e75;
constexpr double smallest_size = 1e-75;

std::string text_of(const Vec3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()); }

void check_indices(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, std::size_t limit)
{
  if (triangles.size() < 4)
    throw InputError(
        fmt::format("found {} triangles; a closed surface has at least 4: is the mesh empty, or cut short?",
                    triangles.size()));
  if (triangles.size() > limit) {
    throw InputError(
        fmt::format("found {} triangles, more than {}; make the mesh coarser", triangles.size(), limit));
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int k : triangles[t]) {
      if (k >= 0 && static_cast<std::size_t>(k) < points.size()) continue;
      throw InputError(
          fmt::format("triangle {} has point {}, and there are points 1 to {}", t + 1, k + 1, points.size()));
    }
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].cwiseAbs().maxCoeff() <= largest_coordinate && points[k].allFinite()) continue;
    throw InputError(fmt::format("point {} is at {}, which is not finite, or beyond all lengths", k + 1,
                                 text_of(points[k])));
  }
}

/// Leaves out points that no triangle has.
void drop_unused(std::vector<Vec3>& points, std::vector<Triangle>& triangles)
{
  std::vector<int> number(points.size(), -1);
  for (const Triangle& t : triangles) {
    for (const int k : t) number[k] = 0;
  }
  int used = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (number[k] < 0) continue;
    points[used] = points[k];
    number[k] = used++;
  }
  points.resize(used);
  for (Triangle& t : triangles) {
    for (int& k : t) k = number[k];
  }
}

Corners corners_of(const std::vector<Vec3>& points, const Triangle& t)
{
  return {points[t[0]], points[t[1]], points[t[2]]};
}

void check_areas(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, double unit)
{
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners c = corners_of(points, triangles[t]);
    const double longest = std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
    const double twice_area = (c[1] - c[0]).cross(c[2] - c[0]).norm();
    // Negated so that not-a-number has none.
    if (twice_area >= lowest_triangle * longest && longest > 0.0) continue;
    throw InputError(fmt::format(
        "triangle {}, of points {}, {} and {} at {}, has no area; merge points that coincide and remove it",
        t + 1, triangles[t][0] + 1, triangles[t][1] + 1, triangles[t][2] + 1, text_of(unit * c[0])));
  }
}

/// Every point's triangles, going from one to the next across edges, must come around to the first.
void check_fans(const std::vector<detail::SurfaceEdge>& edges, const std::vector<Vec3>& points,
                const std::vector<Triangle>& triangles, double unit)
{
  // Of the triangle that runs from a to b, the one beyond the edge comes next around a.
  const auto corner = [&triangles](int triangle, int point) {
    const Triangle& t = triangles[triangle];
    return 3 * static_cast<std::size_t>(triangle) + (t[0] == point ? 0U : t[1] == point ? 1U : 2U);
  };
  std::vector<int> next(3 * triangles.size(), -1);
  for (const detail::SurfaceEdge& e : edges) {
    next[corner(e.forward, e.a)] = e.backward;
    next[corner(e.backward, e.b)] = e.forward;
  }
  std::vector<int> count(points.size(), 0), first(points.size(), -1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int k : triangles[t]) {
      ++count[k];
      first[k] = static_cast<int>(t);
    }
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    int around = 0;
    int t = first[k];
    do {
      ++around;
      t = next[corner(t, static_cast<int>(k))];
    } while (t != first[k] && around <= count[k]);
    if (around == count[k]) continue;
    throw InputError(fmt::format(
        "the surface touches itself at point {}, at {}; give each of its parts a point of its own "
        "there, and a distance",
        k + 1, text_of(unit * points[k])));
  }
}

/// Six times the volume of each part.
std::vector<double> volumes(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                            const std::vector<int>& part)
{
  std::vector<double> six;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::size_t k = part[t];
    if (k >= six.size()) six.resize(k + 1, 0.0);
    const Corners c = corners_of(points, triangles[t]);
    six[k] += c[0].dot(c[1].cross(c[2]));
  }
  return six;
}

/// Whether two triangles of one surface meet elsewhere than in what they share.
class Meeting {
 public:
  Meeting(const std::vector<Vec3>& points, const Triangle& a, const Triangle& b)
      : a_(a), b_(b), ca_(corners_of(points, a)), cb_(corners_of(points, b))
  {
  }

  bool found() const
  {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!has(b_, a_[k]) && near({{a_[k]}, b_, 1, 3}, {ca_[k]}, cb_)) return true;
      if (!has(a_, b_[k]) && near({a_, {b_[k]}, 3, 1}, ca_, {cb_[k]})) return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t k1 = (k + 1) % 3;
      const bool apart = !has(b_, a_[k]) && !has(b_, a_[k1]);
      if (apart && segment_meets(ca_[k], ca_[k1], cb_)) return true;
      if (!has(a_, b_[k]) && !has(a_, b_[k1]) && segment_meets(cb_[k], cb_[k1], ca_)) return true;
      for (std::size_t l = 0; l < 3; ++l) {
        const std::size_t l1 = (l + 1) % 3;
        const bool shared = a_[k] == b_[l] || a_[k] == b_[l1] || a_[k1] == b_[l] || a_[k1] == b_[l1];
        if (!shared && near({{a_[k], a_[k1]}, {b_[l], b_[l1]}, 2, 2}, {ca_[k], ca_[k1]}, {cb_[l], cb_[l1]}))
          return true;
      }
    }
    return same();
  }

 private:
  static bool has(const Triangle& t, int point) { return t[0] == point || t[1] == point || t[2] == point; }
  bool same() const { return has(b_, a_[0]) && has(b_, a_[1]) && has(b_, a_[2]); }
  static bool near(const FeaturePair& pair, const Corners& a, const Corners& b)
  {
    return nearest_features(pair, a, b).distance <= meeting;
  }

  const Triangle &a_, &b_;
  Corners ca_, cb_;
};

void check_meetings(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, double unit)
{
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& t : triangles) boxes.push_back(box_around(corners_of(points, t)));
  const Facets::Tree tree(boxes);
  std::array<int, 2> met{-1, -1};
  visit_near(tree, tree, Mat3::Identity(), Vec3::Zero(), meeting, [&](int i, int j) {
    if (i >= j || (met[0] >= 0 && std::array{i, j} > met)) return;
    const auto &a = triangles[i], &b = triangles[j];
    if (Meeting(points, a, b).found()) met = {i, j};
  });
  if (met[0] < 0) return;
  const Vec3& x = points[triangles[met[0]][0]];
  throw InputError(
      fmt::format("the surface meets itself: triangles {} and {}, at {}; mend the mesh, or make "
                  "elements of its parts",
                  met[0] + 1, met[1] + 1, text_of(unit * x)));
}

}  // namespace

TriangleSurface::TriangleSurface(std::vector<Vec3> points, std::vector<Triangle> triangles, std::size_t limit)
    : points_(std::move(points)), triangles_(std::move(triangles))
{
  check_indices(points_, triangles_, limit);
  drop_unused(points_, triangles_);
  for (const Vec3& x : points_) mean_distance_ += x.norm() / static_cast<double>(points_.size());
  if (!(mean_distance_ > smallest_size))
    throw InputError("all points of the mesh are at one place; is it empty?");
  const std::vector<detail::SurfaceEdge> edges = detail::surface_edges(triangles_, points_);
  for (Vec3& x : points_) {
    x /= mean_distance_;
    bound_ = std::max(bound_, x.norm());
  }
  check_areas(points_, triangles_, mean_distance_);
  check_fans(edges, points_, triangles_, mean_distance_);
  check_meetings(points_, triangles_, mean_distance_);

  const std::vector<int> part = detail::parts_of(edges, triangles_.size());
  const std::vector<double> six = volumes(points_, triangles_, part);
  double volume = 0.0, area = 0.0;
  for (const double v : six) volume += std::abs(v) / 6.0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const std::size_t k = part[t];
    const Corners c = corners_of(points_, triangles_[t]);
    area += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    if (k == parts_.size()) parts_.push_back(triangles_[t][0]);
    if (six[k] < 0.0) std::swap(triangles_[t][1], triangles_[t][2]);
  }
  thickness_ = 2.0 * volume / area;
  loops_ = detail::homology_loops(edges, points_, triangles_.size(), parts_);
  if (loops_.size() > 2 * most_handles) {
    throw InputError(fmt::format(
        "the surface has {} handles, more than {}: links of so many would take too long to find; split it",
        loops_.size() / 2, most_handles));
  }
}

}  // namespace hauberk
