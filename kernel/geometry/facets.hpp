#pragma once
/// Closed triangle meshes of bodies, and the nearest points of their points, edges and triangles.

#include "geometry/pair_frame.hpp"

#include <functional>
#include <memory>

namespace hauberk {

class ClosedCurve;
class Solid;
class TriangleSurface;

/// Closed triangle mesh in the frame of its body, scaled lengths, with a tree of boxes around its triangles:
/// of a torus' surface, of that of a tube around a curve, of a solid's, or of a surface of triangles as it
/// is. Immutable: thread safe.
///
/// Points of a torus lie on the surface at u = 2 pi (i + 1/2)/n, v = pi + 2 pi (j + 1/2)/n: facets, not
/// points or edges, lie on the inner equator and where the body's axes cross the tube. With points there two
/// linked perpendicular rings would nest in each other, and the mesh would be exact by luck.
///
/// Points of a tube around a curve are x(u) + r (cos v a + sin v b), u and v as above, in sections across the
/// tangent t. a is turned from section to section with t and no further (s to t turns a by -(s + t) t.a/(1 +
/// s.t)); the angle phi by which it misses itself after all n is taken back evenly, i phi/n in section i. It
/// begins as what of x is across t, b = a x t: a circle has the mesh of the torus that it is.
class Facets {
 public:
  /// n x n quadrilaterals of the surface of a body of this size, each as two triangles; n >= 3.
  Facets(double R, double r0, double r1, int n);
  /// The same of a tube of radius r around a curve. Throws InputError where the curve turns back between
  /// two sections.
  Facets(const ClosedCurve& curve, double r, int n);
  /// R times a surface.
  Facets(const TriangleSurface& surface, double R);
  /// Of a solid in lengths of its own, `unit` of which are one of the mesh's: points of its chart at u as
  /// above. If all points at v = 0 are one and all at v = pi, these are poles, where triangles meet, and rows
  /// of points lie 2 pi/n apart between them (n even); else v as above. Throws InputError where the chart has
  /// poles elsewhere or the solid makes none of other sizes, which sensitivities of points in the sizes need.
  Facets(const Solid& solid, double unit, int n);
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
  std::array<Vec3, 3> corners(const Triangle& triangle) const
  {
    const auto& [a, b, c] = triangle.points;
    return {points_[a], points_[b], points_[c]};
  }
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }
  /// d point / d (R, r0, r1), columns, at fixed chart coordinates; of a surface (point/R, 0, 0), of a tube
  /// around a curve (0, d point/dr, 0), of a solid 0.
  const Mat3& size_derivative(int point) const { return by_size_[point]; }
  /// Adds n . d point / d(harmonics of a tube's curve, or sizes of a solid) to `out`, which is made long
  /// enough; other meshes have none and leave it as it is. Scaled lengths in harmonics, those of a solid in
  /// its sizes.
  void add_own_sizes(int point, const Vec3& n, std::vector<double>& out) const;
  double mean_edge() const { return mean_edge_; }
  /// Closed polygons on the mesh or inside of it: what a closed curve outside of the mesh is linked with, it
  /// is linked with one of them. Of a torus one, around its tube's middle.
  const std::vector<std::vector<Vec3>>& loops() const { return loops_; }
  /// A point of each connected part.
  const std::vector<int>& parts() const { return parts_; }

  class Tree;
  const Tree& tree() const { return *tree_; }

 private:
  /// d (x, a, b) / d(harmonics of the curve), columns, of a section.
  struct Section {
    Eigen::Matrix3Xd x, a, b;
  };

  /// Triangles of n x n quadrilaterals, closed both ways.
  void add_quadrilaterals(int n);
  /// Triangles of n columns of `rows` points between two poles, which are the last two points.
  void add_rows(int n, int rows);
  /// Edges, and what follows from them, of points and triangles.
  void complete();

  std::vector<Vec3> points_;
  std::vector<Mat3> by_size_;
  std::vector<Section> sections_;  ///< of a tube around a curve; point k belongs to section k / sections
  std::vector<Eigen::Matrix3Xd> by_own_;  ///< of a solid: d point / d(its sizes), per point
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<std::vector<Vec3>> loops_;
  std::vector<int> parts_;
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

/// True if the segment from a to b meets the triangle; false where it lies in the triangle's plane
/// up to rounding.
bool segment_meets(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle);

/// True if a part of one of two meshes that do not intersect is inside of the other.
bool facets_inside(const PairFrame& frame);

/// True if a closed polygon in the mesh's frame is inside of the mesh.
bool encloses(const Facets& mesh, const std::vector<Vec3>& polygon);

/// Solid angle of a triangle seen from the origin, with sign (van Oosterom and Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace hauberk
