#pragma once
/// The boundary of what a fabric can reach, as a surface over directions of the macroscopic unknowns.

#include "limits/limit_result.hpp"

#include <hauberk/load_case.hpp>

#include <array>
#include <optional>
#include <vector>

namespace hauberk {

/// An even sampling of all directions of three unknowns, with the triangles between them.
struct DirectionSphere {
  std::vector<Direction> directions;  ///< unit vectors of the load case's metric
  std::vector<Triangle> triangles;    ///< of indices into `directions`, counter-clockwise seen from outside
};

/// Finest sphere: 10 242 directions.
inline constexpr int most_parts = 32;

/// The vertices of an icosahedron whose edges are divided into `parts` parts, moved onto the unit sphere of
/// the metric: 10 parts^2 + 2 directions, 20 parts^2 triangles. With weights m_k the components are
/// x_k/sqrt(m_k) for |x| = 1, so the sphere is round whatever the frame. The icosahedron's axes of order two
/// are the axes of the unknowns; for even `parts` these are among the directions, both ways.
///
/// Throws InputError unless 1 <= parts <= most_parts and the load case has three unknowns of the value's
/// unit. Deterministic; thread safe.
DirectionSphere direction_sphere(int parts, const LoadCase& load);

/// The surface of limits along components, in file units: `triangles` of indices into `limits`, and where a
/// limit falls short of the state of another one by more than `margin`. The largest value along d over all
/// that can be reached is a support function, so <d_i, macro_j> <= value_i for the furthest states; a limit
/// for which this fails is not the furthest one, and the state that shows it is named. Null when no limit is
/// along components. Thread safe.
std::optional<BoundarySurface> boundary_surface(const std::vector<LimitResult>& limits,
                                                const std::vector<Triangle>& triangles, const LoadCase& load,
                                                double margin);

}  // namespace hauberk
