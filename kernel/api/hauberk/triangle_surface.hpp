#pragma once
/// Closed surfaces of triangles: what triangle meshes are made of. Plugins may make them.

#include <hauberk/linalg.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace hauberk {

/// Closed oriented surface of flat triangles around a solid, which may have handles and several parts.
///
/// Points are scaled so that their mean distance from the origin is 1. Triangles turn counterclockwise seen
/// from outside; parts that were given inside out are turned, each on its own (so a cavity counts as a part
/// of its own: nothing in it can be reached). Immutable: thread safe.
class TriangleSurface {
 public:
  using Triangle = std::array<int, 3>;

  /// More would take too long, of triangles and of handles.
  static constexpr std::size_t most_triangles = 100000;
  static constexpr std::size_t most_handles = 32;

  /// Points in any unit, and triangles of their indices from 0, at most `limit`. Points that no triangle has
  /// are left out.
  ///
  /// Throws InputError, which counts points and triangles from 1, unless points are finite, there are 4 to
  /// `limit` triangles, none of them without area, every edge belongs to two triangles that run
  /// along it in opposite senses, triangles around a point are one fan, no two triangles meet but in what
  /// they share, and there are at most `most_handles` handles.
  TriangleSurface(std::vector<Vec3> points, std::vector<Triangle> triangles,
                  std::size_t limit = most_triangles);

  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Mean distance of the points from the origin as they were given: times the points, it gives them back.
  double mean_distance() const { return mean_distance_; }
  /// Largest distance of a point from the origin.
  double bound() const { return bound_; }
  /// Twice the volume over the area: of a long tube its radius.
  double thickness() const { return thickness_; }
  /// Closed loops of edges, as the points that they go through, that generate the first homology of the
  /// surface: twice as many as it has handles. They are short, and none goes through a point twice.
  const std::vector<std::vector<int>>& loops() const { return loops_; }
  /// A point of each connected part.
  const std::vector<int>& parts() const { return parts_; }

 private:
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  double mean_distance_ = 0.0, bound_ = 0.0, thickness_ = 0.0;
  std::vector<std::vector<int>> loops_;
  std::vector<int> parts_;
};

}  // namespace hauberk
