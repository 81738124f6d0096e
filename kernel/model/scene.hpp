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

/// Lengths (L) and rotations that differ by less are equal: rounding of what files and `repeat` compute.
inline constexpr double rounding_of_scenes = 1e-11;

/// Cells that SceneSpec::repeat counts.
int cell_count(const std::array<int, 3>& repeat);

/// Indices along the lattice vectors of cell number `cell` of `repeat`.
std::array<int, 3> cell_at(int cell, const std::array<int, 3>& repeat);

/// Whether every element that is a copy has its original's parameters. Those of a design may differ.
bool copies_of_one_size(const SceneSpec& spec);

/// Whether all cells of `repeat` are one: elements of the same types and parameters, and each one lattice
/// translation from its place in the first. `length` is L, file units.
bool cells_alike(const SceneSpec& spec, double length);

/// Median ring radius R over all primitives of the scene, file units.
double characteristic_length(const SceneSpec& spec);

/// Smallest half-axis r0, r1 of a tube over all primitives of the scene, file units; infinite without any.
double thinnest_tube(const SceneSpec& spec);

}  // namespace hauberk
