#include "loops.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace hauberk::verification {
namespace {

/// The triangle on either side of every edge (a, b), a < b: the one that runs from a to b first.
using Sides = std::map<std::pair<int, int>, std::array<int, 2>>;

Sides sides_of(const Surface& surface, const std::string& where)
{
  Sides out;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = surface.triangles[t][k], b = surface.triangles[t][(k + 1) % 3];
      const auto at = out.try_emplace({std::min(a, b), std::max(a, b)}, std::array{-1, -1}).first;
      int& side = at->second[a < b ? 0 : 1];
      if (side >= 0 || a == b)
        throw Malformed(where + "/triangles/" + std::to_string(t) +
                        ": an edge runs as another triangle's does");
      side = static_cast<int>(t);
    }
  }
  for (const auto& [edge, side] : out)
    if (side[0] < 0 || side[1] < 0) throw Malformed(where + "/triangles: not closed");
  return out;
}

/// A forest over `count` nodes by breadth: edges that it takes are marked, and the node before each is told.
struct Forest {
  std::vector<int> before, depth;
  std::vector<bool> taken;  ///< of the edges
};

Forest forest(std::size_t count, const std::vector<std::array<int, 2>>& edges,
              const std::vector<bool>& usable)
{
  std::vector<std::vector<std::pair<int, std::size_t>>> ways(count);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!usable[e]) continue;
    ways[edges[e][0]].emplace_back(edges[e][1], e);
    ways[edges[e][1]].emplace_back(edges[e][0], e);
  }
  Forest out{std::vector<int>(count, -1), std::vector<int>(count, -1),
             std::vector<bool>(edges.size(), false)};
  for (std::size_t root = 0; root < count; ++root) {
    if (out.depth[root] >= 0) continue;
    out.depth[root] = 0;
    std::deque<std::size_t> open{root};
    while (!open.empty()) {
      const std::size_t at = open.front();
      open.pop_front();
      for (const auto& [to, edge] : ways[at]) {
        const std::size_t next = to;
        if (out.depth[next] >= 0) continue;
        out.depth[next] = out.depth[at] + 1;
        out.before[next] = static_cast<int>(at);
        out.taken[edge] = true;
        open.push_back(next);
      }
    }
  }
  return out;
}

/// From a to b along the forest.
std::vector<int> path(const Forest& tree, int a, int b)
{
  const auto depth = [&tree](int k) { return tree.depth[k]; };
  std::vector<int> from{a}, to{b};
  while (from.back() != to.back()) {
    std::vector<int>& deeper = depth(from.back()) >= depth(to.back()) ? from : to;
    deeper.push_back(tree.before[deeper.back()]);
  }
  from.insert(from.end(), to.rbegin() + 1, to.rend());
  return from;
}

/// Signed crossings of p over q and under it, seen along the third of `axes`.
std::array<int, 2> crossings(const std::vector<Vec3>& p, const std::vector<Vec3>& q, const Mat3& axes)
{
  std::array<int, 2> out{};
  const auto seen = [&axes](const std::vector<Vec3>& polygon) {
    std::vector<Vec3> turned;
    turned.reserve(polygon.size());
    for (const Vec3& x : polygon) turned.emplace_back(axes.transpose() * x);
    return turned;
  };
  const std::vector<Vec3> a = seen(p), b = seen(q);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 &x = a[i], dx = a[(i + 1) % a.size()] - x;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec3 &y = b[j], dy = b[(j + 1) % b.size()] - y, r = y - x;
      const double area = dx.x() * dy.y() - dx.y() * dy.x();
      if (area == 0.0) continue;
      const double s = (r.x() * dy.y() - r.y() * dy.x()) / area;
      const double t = (r.x() * dx.y() - r.y() * dx.x()) / area;
      if (s < 0.0 || s >= 1.0 || t < 0.0 || t >= 1.0) continue;
      const bool over = x.z() + s * dx.z() > y.z() + t * dy.z();
      // From what is over to what is under.
      out[over ? 0 : 1] += (area > 0.0) == over ? 1 : -1;
    }
  }
  return out;
}

}  // namespace

std::vector<std::vector<int>> homology_loops(const Surface& surface, const std::string& where)
{
  const Sides sides = sides_of(surface, where);
  std::vector<std::array<int, 2>> edges, across;
  for (const auto& [edge, side] : sides) {
    edges.push_back({edge.first, edge.second});
    across.push_back(side);
  }
  const Forest triangles = forest(surface.triangles.size(), across, std::vector<bool>(edges.size(), true));
  std::vector<bool> uncrossed = triangles.taken;
  uncrossed.flip();
  const Forest tree = forest(surface.points.size(), edges, uncrossed);
  std::vector<std::vector<int>> out;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (uncrossed[e] && !tree.taken[e]) out.push_back(path(tree, edges[e][0], edges[e][1]));
  return out;
}

std::optional<int> crossing_number(const std::vector<Vec3>& p, const std::vector<Vec3>& q)
{
  constexpr int most_views = 12;
  std::optional<int> before;
  for (int k = 1; k <= most_views; ++k) {
    // Directions that have nothing to do with those of a model.
    const Mat3 axes =
        Eigen::Quaterniond(std::cos(1.7 * k), std::sin(2.3 * k), std::cos(0.9 * k), std::sin(3.1 * k))
            .normalized()
            .toRotationMatrix();
    const auto [over, under] = crossings(p, q, axes);
    if (over != under) continue;  // a corner was seen on an edge
    if (before == over) return over;
    before = over;
  }
  return std::nullopt;
}

}  // namespace hauberk::verification
