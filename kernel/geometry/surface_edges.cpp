#include "geometry/surface_edges.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace hauberk::detail {
namespace {

/// A triangle's way along an edge.
struct Side {
  int a, b;  ///< a < b
  int triangle;
  bool forward;  ///< from a to b
};

/// Disjoint sets of numbers.
class Sets {
 public:
  explicit Sets(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0); }

  int find(int k)
  {
    while (above(k) != k) {
      above(k) = above(above(k));
      k = above(k);
    }
    return k;
  }
  /// False if they were one already. The smaller number stands for both.
  bool join(int a, int b)
  {
    a = find(a);
    b = find(b);
    above(std::max(a, b)) = std::min(a, b);
    return a != b;
  }

 private:
  int& above(int k) { return above_[k]; }

  std::vector<int> above_;
};

/// Shortest paths along edges from one point of each part.
struct PathTree {
  std::vector<double> distance;
  std::vector<int> before;   ///< -1: where paths begin
  std::vector<int> by_edge;  ///< that leads there from `before`
};

PathTree shortest_paths(const std::vector<SurfaceEdge>& edges, const std::vector<Vec3>& points,
                        const std::vector<int>& starts)
{
  struct Way {
    int to, edge;
    double length;
  };
  std::vector<std::vector<Way>> ways(points.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::size_t a = edges[e].a, b = edges[e].b;
    const double length = (points[a] - points[b]).norm();
    ways[a].push_back({edges[e].b, static_cast<int>(e), length});
    ways[b].push_back({edges[e].a, static_cast<int>(e), length});
  }
  PathTree tree;
  tree.distance.assign(points.size(), std::numeric_limits<double>::infinity());
  tree.before.assign(points.size(), -1);
  tree.by_edge.assign(points.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const int start : starts) {
    tree.distance[start] = 0.0;
    open.emplace(0.0, start);
  }
  while (!open.empty()) {
    const auto [distance, point] = open.top();
    open.pop();
    if (distance > tree.distance[point]) continue;
    for (const Way& way : ways[point]) {
      const std::size_t to = way.to;
      if (distance + way.length >= tree.distance[to]) continue;
      tree.distance[to] = distance + way.length;
      tree.before[to] = point;
      tree.by_edge[to] = way.edge;
      open.emplace(tree.distance[to], way.to);
    }
  }
  return tree;
}

/// The loop of an edge and the paths from its ends to where they meet.
std::vector<int> loop_of(const SurfaceEdge& edge, const PathTree& tree)
{
  const auto path = [&tree](int point) {
    std::vector<int> out;
    for (; point >= 0; point = tree.before[point]) out.push_back(point);
    return out;
  };
  std::vector<int> from = path(edge.a), to = path(edge.b);
  // What both have in common goes there and back; its first point is a corner of the loop.
  while (from.size() > 1 && to.size() > 1 && from[from.size() - 2] == to[to.size() - 2]) {
    from.pop_back();
    to.pop_back();
  }
  from.pop_back();
  from.insert(from.end(), to.rbegin(), to.rend());
  return from;
}

}  // namespace

std::vector<SurfaceEdge> surface_edges(const std::vector<TriangleSurface::Triangle>& triangles,
                                       const std::vector<Vec3>& points)
{
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::pair(x.a, x.b) != std::pair(y.a, y.b) ? std::pair(x.a, x.b) < std::pair(y.a, y.b)
                                                      : x.triangle < y.triangle;
  });
  const auto place = [&points](const Side& s) {
    const Vec3& x = points[s.a];
    return fmt::format("the edge between points {} and {}, at ({:.6g}, {:.6g}, {:.6g}),", s.a + 1, s.b + 1,
                       x.x(), x.y(), x.z());
  };
  std::vector<SurfaceEdge> edges;
  edges.reserve(sides.size() / 2);
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k;
    while (end < sides.size() && sides[end].a == sides[k].a && sides[end].b == sides[k].b) ++end;
    if (end - k == 1) {
      throw InputError(
          fmt::format("the surface is open: {} belongs to triangle {} alone; close the holes of the mesh",
                      place(sides[k]), sides[k].triangle + 1));
    }
    if (end - k > 2) {
      throw InputError(
          fmt::format("{} belongs to {} triangles, {} and {} among them; a surface has two at each edge",
                      place(sides[k]), end - k, sides[k].triangle + 1, sides[k + 1].triangle + 1));
    }
    if (sides[k].forward == sides[k + 1].forward) {
      throw InputError(fmt::format(
          "triangles {} and {} run along {} in the same sense; make the mesh's normals consistent",
          sides[k].triangle + 1, sides[k + 1].triangle + 1, place(sides[k])));
    }
    const bool first = sides[k].forward;
    edges.push_back(
        {sides[k].a, sides[k].b, sides[first ? k : k + 1].triangle, sides[first ? k + 1 : k].triangle});
    k = end;
  }
  return edges;
}

std::vector<int> parts_of(const std::vector<SurfaceEdge>& edges, std::size_t triangle_count)
{
  Sets sets(triangle_count);
  for (const SurfaceEdge& e : edges) sets.join(e.forward, e.backward);
  std::vector<int> out(triangle_count, -1);
  int count = 0;
  for (std::size_t t = 0; t < triangle_count; ++t) {
    const int first = sets.find(static_cast<int>(t));
    out[t] = first == static_cast<int>(t) ? count++ : out[first];
  }
  return out;
}

std::vector<std::vector<int>> homology_loops(const std::vector<SurfaceEdge>& edges,
                                             const std::vector<Vec3>& points, std::size_t triangle_count,
                                             const std::vector<int>& part_points)
{
  const PathTree tree = shortest_paths(edges, points, part_points);
  struct Candidate {
    double length;
    int edge;
  };
  std::vector<Candidate> outside;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const std::size_t a = edges[k].a, b = edges[k].b;
    const int number = static_cast<int>(k);
    if (tree.by_edge[a] == number || tree.by_edge[b] == number) continue;
    outside.push_back({tree.distance[a] + tree.distance[b] + (points[a] - points[b]).norm(), number});
  }
  std::sort(outside.begin(), outside.end(), [](const Candidate& x, const Candidate& y) {
    return x.length != y.length ? x.length > y.length : x.edge < y.edge;
  });
  Sets across(triangle_count);
  std::vector<std::vector<int>> loops;
  for (const Candidate& c : outside) {
    const SurfaceEdge& e = edges[c.edge];
    if (!across.join(e.forward, e.backward)) loops.push_back(loop_of(e, tree));
  }
  return loops;
}

}  // namespace hauberk::detail
