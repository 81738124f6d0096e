#pragma once
/// Spines: the graph of an element's cores, and the loops that several of its primitives form together.

#include "geometry/body.hpp"

#include <span>
#include <utility>
#include <vector>

namespace hauberk {

/// A place where the solids of two primitives of one element overlap: sections at u of the first's core and v
/// of the second's, and a point of both solids.
struct Join {
  double u = 0.0, v = 0.0;
  Vec3 common = Vec3::Zero();  ///< element frame
};

/// One join for every connected part that the solids of A and B, of one element, have in common; surfaces
/// that touch count. Some parts may have more than one. Triangle meshes have no joins.
///
/// A tube is the union of balls along its core, so the overlap of two tubes has as many parts as the set of
/// (u, v) where balls meet, |a(u) - b(v)| <= r_a + r_b. Where a cross-section is an ellipse, the points of
/// one solid in the other are counted. Parts are told apart on a grid; the depth of each is found by descent.
/// Thread safe.
std::vector<Join> joins(const Body& A, const Body& B);

/// A closed chain: pieces with the sense in which they are gone through.
struct SpineLoop {
  std::vector<std::pair<int, int>> pieces;  ///< index of the piece, +1 or -1
  std::vector<int> primitives;              ///< whose cores it follows, ascending
};

/// Cores of an element's primitives, cut at joins, and the straight ways between them: a graph of polygons
/// that lies inside of the element. `cores` and `loops` together generate its cycles: what a union of tubes
/// can be linked by (Mayer-Vietoris: every part of an overlap beyond those of a spanning tree closes a loop).
struct Spine {
  std::vector<std::vector<Vec3>> pieces;  ///< corners, element frame
  std::vector<SpineLoop> cores;           ///< one for each primitive
  /// Those that several primitives form together; and of what has no core the loops of its own: of triangle
  /// meshes those of their facets, of solids that are no tubes the polygons that they give.
  std::vector<SpineLoop> loops;
};

/// Spine of the bodies of one element. Thread safe.
Spine make_spine(std::span<const Body> bodies);

/// Linking numbers of the cycles (cores, then loops) of two spines whose elements do not overlap; rows are
/// those of the first. Where both are of one primitive they are left 0: `linking_number` knows them. Signed
/// crossings in one view, counted over and under, which must agree; where they do not, Gauss's integral.
/// Thread safe.
Eigen::MatrixXi linking_numbers(const Spine& a, const Pose& pose_a, const Spine& b, const Pose& pose_b);

/// Gauss's integral over two closed polygons that do not meet, an integer.
int linking_of_polygons(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

}  // namespace hauberk
