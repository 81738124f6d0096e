#include "strut_frame.hpp"

#include <cmath>
#include <limits>

namespace hauberk {
namespace {

/// Nodes that are as near to each other as any two are joined, scaled to edges of length 1.
Graph joined_nearest(std::vector<Vec3> nodes)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = i + 1; j < nodes.size(); ++j)
      shortest = std::min(shortest, (nodes[i] - nodes[j]).norm());
  Graph out;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = i + 1; j < nodes.size(); ++j)
      if ((nodes[i] - nodes[j]).norm() < shortest * (1.0 + 1e-9))
        out.struts.push_back({static_cast<int>(i), static_cast<int>(j)});
  for (Vec3& x : nodes) x /= shortest;
  out.nodes = std::move(nodes);
  return out;
}

Graph square() { return joined_nearest({{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}); }

/// Two opposite edges lie along x (above) and along y (below).
Graph tetrahedron()
{
  const double h = std::sqrt(0.5);
  return joined_nearest({{1, 0, h}, {-1, 0, h}, {0, 1, -h}, {0, -1, -h}});
}

Graph cube()
{
  std::vector<Vec3> nodes;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) nodes.emplace_back(x, y, z);
  return joined_nearest(std::move(nodes));
}

Graph octahedron()
{
  return joined_nearest({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
}

/// The corners of a tetrahedron in the corners of a cube, cut off at a third of each edge.
Graph truncated_tetrahedron()
{
  std::vector<Vec3> nodes;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) {
        if (x * y * z < 0.0) continue;
        nodes.emplace_back(3.0 * x, y, z);
        nodes.emplace_back(x, 3.0 * y, z);
        nodes.emplace_back(x, y, 3.0 * z);
      }
  return joined_nearest(std::move(nodes));
}

Graph cuboctahedron()
{
  std::vector<Vec3> nodes;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      nodes.emplace_back(a, b, 0.0);
      nodes.emplace_back(a, 0.0, b);
      nodes.emplace_back(0.0, a, b);
    }
  return joined_nearest(std::move(nodes));
}

constexpr std::array list = {
    Polyhedron{"square", "4 struts in the plane z = 0, edges along x and y", square},
    Polyhedron{"tetrahedron", "6 struts, the upper edge along x, the lower one along y", tetrahedron},
    Polyhedron{"cube", "12 struts along x, y and z", cube},
    Polyhedron{"octahedron", "12 struts, corners on the axes", octahedron},
    Polyhedron{"truncated_tetrahedron", "18 struts, four hexagons and four triangles", truncated_tetrahedron},
    Polyhedron{"cuboctahedron", "24 struts, eight triangles and six squares", cuboctahedron},
};

}  // namespace

std::span<const Polyhedron> polyhedra() { return list; }

}  // namespace hauberk
