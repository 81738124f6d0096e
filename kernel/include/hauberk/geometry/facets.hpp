#pragma once
/// Closed triangle meshes of bodies, and the nearest points of their points, edges and triangles.

#include <hauberk/geometry/pair_frame.hpp>

#include <functional>
#include <memory>

namespace hauberk {

/// Closed triangle mesh of a torus' surface in the frame of its body, scaled lengths, with a tree of boxes
/// around its triangles. Immutable: thread safe.
///
/// Points lie on the surface at u = 2 pi (i + 1/2)/n, v = pi + 2 pi (j + 1/2)/n: facets, not points or edges,
/// lie on the inner equator and where the body's axes cross the tube. With points there two linked
/// perpendicular rings would nest in each other, and the mesh would be exact by luck.
class Facets {
 public:
  /// n x n quadrilaterals of the surface of a body of this size, each as two triangles; n >= 3.
  Facets(double R, double r0, double r1, int n);
  ~Facets();
  Facets(const Facets&) = delete;
  Facets& operator=(const Facets&) = delete;

  struct Triangle {
    std::array<int, 3> points;
    /// Points and edges that this triangle stands for: each is owned by exactly one triangle; -1: none.
    std::array<int, 3> own_points, own_edges;
  };
  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }
  /// d point / d (R, r0, r1), columns, at fixed chart coordinates.
  const Mat3& size_derivative(int point) const { return by_size_[static_cast<std::size_t>(point)]; }
  double mean_edge() const { return mean_edge_; }

  class Tree;
  const Tree& tree() const { return *tree_; }

 private:
  std::vector<Vec3> points_;
  std::vector<Mat3> by_size_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 2>> edges_;
  double mean_edge_ = 0.0;
  std::unique_ptr<const Tree> tree_;
};

/// A point of a mesh as a weighted mean of up to three of its points.
struct FacetPoint {
  std::array<int, 3> points{};
  std::array<double, 3> weights{};
  int count = 0;
};

/// Two features (point and triangle, or two edges): numbers of points of P and of F. In F's frame.
struct FeaturePair {
  std::array<int, 3> p{}, f{};
  int p_count = 0, f_count = 0;  ///< 1 and 3, 3 and 1, or 2 and 2

  bool edges() const { return p_count == 2; }
};

/// Nearest points of two features. `free` coordinates move them along the features, by the tangents
/// on_p' = tangent_p, on_f' = tangent_f; those at a bound are none.
struct NearestFeatures {
  double distance = 0.0;
  Vec3 on_p, on_f, normal;  ///< normal: unit, from F to P
  FacetPoint p, f;
  int free = 0;
  std::array<Vec3, 2> tangent_p, tangent_f;
};

/// Nearest points of two features given by their corners. At most two coordinates are free; where two
/// edges are parallel up to rounding, one.
NearestFeatures nearest_features(const FeaturePair& pair, const std::array<Vec3, 3>& p,
                                 const std::array<Vec3, 3>& f);

/// Calls `visit` for every pair of features whose triangles' boxes are within `range`, each pair once, in a
/// fixed order. Corners are in F's frame. Both bodies of the frame must have facets.
using FeatureVisitor =
    std::function<void(const FeaturePair&, const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& f)>;
void near_features(const PairFrame& frame, double range, const FeatureVisitor& visit);

/// True if an edge of one mesh meets a triangle of the other.
bool facets_intersect(const PairFrame& frame);

}  // namespace hauberk
