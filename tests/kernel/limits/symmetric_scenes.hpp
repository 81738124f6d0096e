#pragma once
/// Scenes whose symmetries are known by hand.

#include "scenes.hpp"

namespace hauberk::test {

/// The m x n supercell; elements as `repeat` orders them.
SceneSpec repeated(const SceneSpec& cell, int m, int n);

/// Elements of three orthogonal rings at the corners and, turned by 45 degrees, at the edges of a square
/// lattice (share/weaves/fourfold.json), R 5, r 0.815.
SceneSpec fourfold();

/// Six elements of three rings each that a design made, with tubes up to five times as tall as wide
/// (tests/experiments/scenes/tall_tubes.json).
SceneSpec tall_tubes();

/// Flat rings on a square or triangular lattice, neighbours joined by upright ones (share/weaves), R 4.9, r
/// 0.7.
SceneSpec japanese(bool triangular);

/// Seven threefold elements: one at the apex and six around it.
SceneSpec threefold_patch();

/// Three orthogonal rings on a cubic lattice, no neighbours linked.
SceneSpec cubic();

/// Trefoil knots, threefold about z and turned upside down by half a turn about y, on a triangular lattice
/// that has y among its shortest vectors.
SceneSpec trefoils();

/// Tetrahedra of struts on the sites of diamond, corner in corner
/// (share/experiments/diamond_tetrahedra.json).
SceneSpec diamond();

/// Truncated tetrahedra of struts on a cubic lattice, edge over edge.
SceneSpec truncated_tetrahedra();

/// Octahedra of struts on the sites of rock salt, turned about (1, 1, 1) one way and the other
/// (octahedra_solid.json).
SceneSpec octahedra_solid();

}  // namespace hauberk::test
