#pragma once
/// The scene: elements, placements, the cell; built once from plain specifications, then immutable.

#include "geometry/pose.hpp"

#include <hauberk/shape.hpp>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace hauberk {

/// One entry of `elements`: a shape with default parameters.
struct ElementType {
  std::string name;
  std::shared_ptr<const Shape> shape;
};

/// A placed element, after `repeat` or `patch` has been expanded. Lengths in file units.
struct PlacedElement {
  int type = 0;
  std::vector<double> parameters;  ///< of its shape, in the shape's order
  Pose rest;
  int copy_of = -1;  ///< the element that `repeat` made a translated copy of; -1: none
};

/// Everything that says what is simulated. Lengths in file units.
struct SceneSpec {
  std::vector<ElementType> types;
  std::vector<PlacedElement> elements;
  std::vector<Vec3> lattice;  ///< two or three vectors of the supercell when periodic, else empty
  /// How many copies of the cell as written the lattice vectors span: element k is
  /// ((l n + j) m + i) |place| + index in place.
  std::array<int, 3> repeat{1, 1, 1};
  /// Contact of meshes: every primitive is replaced by facets x facets quadrilaterals; 0: surfaces as they
  /// are.
  int facets = 0;
  double length = 0.0;      ///< characteristic length L; 0: median ring radius of the elements
  std::string length_unit;  ///< of the file, for messages; may be empty
};

/// Median ring radius R over all primitives of the scene, file units.
double characteristic_length(const SceneSpec& spec);

/// Smallest half-axis r0, r1 of a tube over all primitives of the scene, file units; infinite without any.
double thinnest_tube(const SceneSpec& spec);

}  // namespace hauberk
