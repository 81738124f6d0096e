#include "geometry/spine.hpp"

#include "geometry/core.hpp"
#include "geometry/facets.hpp"

#include <hauberk/solid.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>

namespace hauberk {
namespace {

/// Where the coordinate of cores begins for the order of joins: at an angle that designs have no reason for,
/// so that a small change of sizes does not reorder them.
constexpr double cut = 1.0372;
/// Polygons keep to their tubes: no farther from the core than this part of the smaller half-axis.
constexpr double within = 0.25;

double from_cut(double u)
{
  const double turned = std::fmod(u - cut, full_turn);
  return turned < 0.0 ? turned + full_turn : turned;
}

/// Whether core_at() knows a core.
bool has_core(const Body& b) { return !b.surface && (!b.solid || is_round(b)); }

Vec3 core_point(const Body& b, double u)
{
  const Angle angle(u);
  return b.center + b.axes * core_at(b, angle).x;
}

/// Corners from u to u + length along a core, both ends included. A chord over h radians is |x_uu| h^2/8 from
/// its arc at most.
std::vector<Vec3> arc(const Body& b, double u, double length)
{
  const double second = core_bounds(b).second;
  const double most = std::min(1.0, std::sqrt(8.0 * within * std::min(b.r0, b.r1) / second));
  const int count = std::max(1, static_cast<int>(std::ceil(length / most)));
  std::vector<Vec3> out;
  for (int k = 0; k <= count; ++k) out.push_back(core_point(b, u + length * k / count));
  return out;
}

/// A join of two primitives of an element, and the node that it is on each.
struct Edge {
  std::array<int, 2> body{};
  std::array<int, 2> place{};  ///< index among the joins of each body, in the order of their coordinates
  Join join;
};

std::vector<Edge> edges_of(std::span<const Body> bodies)
{
  std::vector<Edge> out;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      std::vector<Join> found = joins(bodies[a], bodies[b]);
      // Coordinates that are equal by symmetry differ by rounding, which must not decide the order.
      const auto key = [](const Join& j) {
        return std::pair(std::round(1e6 * from_cut(j.u)), std::round(1e6 * from_cut(j.v)));
      };
      std::sort(found.begin(), found.end(), [&](const Join& x, const Join& y) { return key(x) < key(y); });
      for (const Join& j : found) out.push_back({{static_cast<int>(a), static_cast<int>(b)}, {}, j});
    }
  }
  return out;
}

/// Builds the graph and closes its cycles.
class Builder {
 public:
  explicit Builder(std::span<const Body> bodies)
      : bodies_(bodies), edges_(edges_of(bodies)), arcs_(bodies.size())
  {
    for (std::size_t b = 0; b < bodies.size(); ++b) cut_core(static_cast<int>(b));
    for (const Edge& e : edges_) add_way(e);
  }

  Spine run()
  {
    grow_forest();
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (!in_forest_[e]) out_.loops.push_back(closed_by(e));
    for (std::size_t b = 0; b < bodies_.size(); ++b) add_own_loops(static_cast<int>(b));
    return std::move(out_);
  }

 private:
  const Body& body(int b) const { return bodies_[b]; }

  /// Pieces of a core from join to join; all of it where there is none.
  void cut_core(int b)
  {
    std::vector<std::pair<double, int*>> places;
    for (Edge& e : edges_) {
      for (const std::size_t side : {0U, 1U})
        if (e.body[side] == b) places.emplace_back(from_cut(side == 0 ? e.join.u : e.join.v), &e.place[side]);
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& x, const auto& y) { return x.first < y.first; });
    SpineLoop core;
    core.primitives = {b};
    const std::size_t count = std::max<std::size_t>(1, places.size());
    for (std::size_t k = 0; k < count; ++k) {
      const double from = places.empty() ? 0.0 : places[k].first;
      const double to = places.empty()  ? full_turn
                        : k + 1 < count ? places[k + 1].first
                                        : places[0].first + full_turn;
      if (!places.empty()) *places[k].second = static_cast<int>(k);
      arcs_[b].push_back(static_cast<int>(out_.pieces.size()));
      core.pieces.emplace_back(static_cast<int>(out_.pieces.size()), 1);
      out_.pieces.push_back(has_core(body(b)) ? arc(body(b), cut + from, to - from) : std::vector<Vec3>());
    }
    out_.cores.push_back(std::move(core));
  }

  /// From core to core through the point that both solids share: sections are convex.
  void add_way(const Edge& e)
  {
    ways_.push_back(static_cast<int>(out_.pieces.size()));
    out_.pieces.push_back(
        {core_point(body(e.body[0]), e.join.u), e.join.common, core_point(body(e.body[1]), e.join.v)});
  }

  /// Triangle meshes and solids that are no tubes have no core; what is linked with one is linked with its
  /// loops.
  void add_own_loops(int b)
  {
    const Body& own = body(b);
    if (own.surface && own.facets)
      for (const std::vector<Vec3>& corners : own.facets->loops()) add_loop(b, corners, 1.0);
    if (own.solid && !has_core(own))
      for (const std::vector<Vec3>& corners : own.solid->cores()) add_loop(b, corners, own.unit);
  }

  void add_loop(int b, const std::vector<Vec3>& corners, double unit)
  {
    out_.loops.push_back({{{static_cast<int>(out_.pieces.size()), 1}}, {b}});
    std::vector<Vec3>& piece = out_.pieces.emplace_back();
    for (const Vec3& x : corners) piece.emplace_back(body(b).center + body(b).axes * (x / unit));
    piece.push_back(piece.front());
  }

  /// By breadth, so that ways are short.
  void grow_forest()
  {
    const std::size_t n = bodies_.size();
    before_.assign(n, -1);
    depth_.assign(n, -1);
    in_forest_.assign(edges_.size(), false);
    for (std::size_t root = 0; root < n; ++root) {
      if (depth_[root] >= 0) continue;
      depth_[root] = 0;
      std::deque<int> queue{static_cast<int>(root)};
      while (!queue.empty()) {
        const int at = queue.front();
        queue.pop_front();
        for (std::size_t e = 0; e < edges_.size(); ++e) {
          const auto& [a, b] = edges_[e].body;
          if (a != at && b != at) continue;
          const std::size_t to = a == at ? b : a;
          if (depth_[to] >= 0) continue;
          depth_[to] = depth_[at] + 1;
          before_[to] = static_cast<int>(e);
          in_forest_[e] = true;
          queue.push_back(static_cast<int>(to));
        }
      }
    }
  }

  /// The edge, and the way back from its second primitive to its first through the forest.
  SpineLoop closed_by(std::size_t edge) const
  {
    // Edges up from either end until they meet.
    int a = edges_[edge].body[0], b = edges_[edge].body[1];
    std::vector<int> from_a, from_b;
    while (a != b) {
      int& deeper = depth_[a] >= depth_[b] ? a : b;
      const int up = before_[deeper];
      (&deeper == &a ? from_a : from_b).push_back(up);
      const auto& ends = edges_[up].body;
      deeper = ends[0] == deeper ? ends[1] : ends[0];
    }
    std::vector<int> way{static_cast<int>(edge)};
    way.insert(way.end(), from_b.begin(), from_b.end());
    way.insert(way.end(), from_a.rbegin(), from_a.rend());

    SpineLoop loop;
    int at = edges_[edge].body[0];
    for (std::size_t k = 0; k < way.size(); ++k) {
      const Edge& e = edges_[way[k]];
      const std::size_t leaves = e.body[0] == at ? 0 : 1, enters = 1 - leaves;
      loop.pieces.emplace_back(ways_[way[k]], leaves == 0 ? 1 : -1);
      at = e.body[enters];
      loop.primitives.push_back(at);
      const Edge& next = edges_[way[(k + 1) % way.size()]];
      const std::size_t side = next.body[0] == at ? 0 : 1;
      along(loop, at, e.place[enters], next.place[side]);
    }
    std::sort(loop.primitives.begin(), loop.primitives.end());
    loop.primitives.erase(std::unique(loop.primitives.begin(), loop.primitives.end()), loop.primitives.end());
    return loop;
  }

  /// Along a core from one join to another, never over its cut.
  void along(SpineLoop& loop, int b, int from, int to) const
  {
    const std::vector<int>& arcs = arcs_[b];
    for (int k = from; k < to; ++k) loop.pieces.emplace_back(arcs[k], 1);
    for (int k = from; k > to; --k) loop.pieces.emplace_back(arcs[k - 1], -1);
  }

  std::span<const Body> bodies_;
  std::vector<Edge> edges_;
  std::vector<std::vector<int>> arcs_;  ///< of every body: its pieces in order
  std::vector<int> ways_;               ///< of every edge: its piece
  std::vector<int> before_, depth_;     ///< of every body: the edge towards its root
  std::vector<bool> in_forest_;
  Spine out_;
};

/// Pieces seen in one view: corners, and the box around them.
struct Seen {
  std::vector<Vec3> corners;
  Eigen::AlignedBox2d box;
};

/// A view that has nothing to do with the directions of a model.
Mat3 view()
{
  static const Mat3 axes =
      Eigen::Quaterniond(0.4251, -0.2973, 0.7719, 0.3671).normalized().toRotationMatrix();
  return axes;
}

std::vector<Seen> seen(const Spine& s, const Pose& pose)
{
  const Mat3 turn = view() * pose.rotation;
  const Vec3 shift = view() * pose.position;
  std::vector<Seen> out(s.pieces.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].corners.reserve(s.pieces[k].size());
    for (const Vec3& x : s.pieces[k]) {
      out[k].corners.emplace_back(shift + turn * x);
      out[k].box.extend(out[k].corners.back().head<2>());
    }
  }
  return out;
}

/// Signed crossings of p over q and under it.
std::array<int, 2> crossings(const Seen& p, const Seen& q)
{
  std::array<int, 2> out{};
  if (!p.box.intersects(q.box)) return out;
  for (std::size_t i = 0; i + 1 < p.corners.size(); ++i) {
    const Vec3 &x = p.corners[i], dx = p.corners[i + 1] - x;
    for (std::size_t j = 0; j + 1 < q.corners.size(); ++j) {
      const Vec3 &y = q.corners[j], dy = q.corners[j + 1] - y, r = y - x;
      const double area = dx.x() * dy.y() - dx.y() * dy.x();
      const double s = r.x() * dy.y() - r.y() * dy.x(), t = r.x() * dx.y() - r.y() * dx.x();
      // 0 <= s/area < 1 and 0 <= t/area < 1.
      const double size = std::abs(area), sign = area > 0.0 ? 1.0 : -1.0;
      if (sign * s < 0.0 || sign * s >= size || sign * t < 0.0 || sign * t >= size) continue;
      const bool over = x.z() + s / area * dx.z() > y.z() + t / area * dy.z();
      out[over ? 0 : 1] += (area > 0.0) == over ? 1 : -1;
    }
  }
  return out;
}

std::vector<Vec3> polygon(const Spine& s, const SpineLoop& loop, const Pose& pose)
{
  std::vector<Vec3> out;
  for (const auto& [piece, sense] : loop.pieces) {
    std::vector<Vec3> corners = s.pieces[piece];
    if (sense < 0) std::reverse(corners.begin(), corners.end());
    for (std::size_t k = 0; k + 1 < corners.size(); ++k)
      out.emplace_back(pose.position + pose.rotation * corners[k]);
  }
  return out;
}

const SpineLoop& cycle(const Spine& s, std::size_t k)
{
  return k < s.cores.size() ? s.cores[k] : s.loops[k - s.cores.size()];
}

}  // namespace

Spine make_spine(std::span<const Body> bodies) { return Builder(bodies).run(); }

Eigen::MatrixXi linking_numbers(const Spine& a, const Pose& pose_a, const Spine& b, const Pose& pose_b)
{
  const std::vector<Seen> p = seen(a, pose_a), q = seen(b, pose_b);
  Eigen::MatrixXi over(p.size(), q.size()), under(p.size(), q.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) {
      const auto [above, below] = crossings(p[i], q[j]);
      over(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = above;
      under(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = below;
    }
  }
  const std::size_t rows = a.cores.size() + a.loops.size(), cols = b.cores.size() + b.loops.size();
  Eigen::MatrixXi out =
      Eigen::MatrixXi::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(cols));
  for (std::size_t k = 0; k < rows; ++k) {
    for (std::size_t l = 0; l < cols; ++l) {
      const SpineLoop &x = cycle(a, k), &y = cycle(b, l);
      if (x.primitives.size() == 1 && y.primitives.size() == 1) continue;
      int above = 0, below = 0;
      for (const auto& [i, si] : x.pieces) {
        for (const auto& [j, sj] : y.pieces) {
          above += si * sj * over(i, j);
          below += si * sj * under(i, j);
        }
      }
      // A corner that is seen on an edge is counted twice or not at all, over or under but not both.
      out(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) =
          above == below ? above : linking_of_polygons(polygon(a, x, pose_a), polygon(b, y, pose_b));
    }
  }
  return out;
}

/// The differences of two sides are a parallelogram, and what it covers of the sphere, seen from inside, is
/// its part of 4 pi times the linking number.
int linking_of_polygons(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 &p = a[i], &pn = a[(i + 1) % a.size()];
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec3 &q = b[j], &qn = b[(j + 1) % b.size()];
      sum += solid_angle(p - q, pn - q, pn - qn) + solid_angle(p - q, pn - qn, p - qn);
    }
  }
  return static_cast<int>(-std::lround(sum / (4.0 * std::numbers::pi)));
}

}  // namespace hauberk
