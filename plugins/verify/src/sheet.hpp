#pragma once
/// Whether a bent patch still is a sheet on the scale of its elements.
#include "links.hpp"

#include <string>
#include <vector>

namespace hauberk::verification {

/// Bounds of paraboloid_bending and cylinder_roll: the README of the first says why these.
constexpr double most_curvature = 2.0;  ///< largest curvature times the largest radius of an element
constexpr double most_apart = 3.0;      ///< of linked elements along the surface, over their distance at rest
constexpr double most_turns = 1.0;      ///< of a patch around its roll

/// How near a bent state comes to being no sheet.
struct Sheet {
  double curvature = 0.0;  ///< largest curvature times the largest radius of an element
  /// Largest distance of linked elements along the surface, straight in plan, over the larger of their
  /// distance at rest and their mean radius.
  double apart = 0.0;
  /// How often the patch or strip goes around, along the direction in which it is curved most; 0 on a
  /// paraboloid.
  double turns = 0.0;
  bool holds() const { return curvature < most_curvature && apart < most_apart && turns < most_turns; }
  std::string text() const;
};

/// Of a patch on a paraboloid or a roll, or of a strip; `linked`: pairs of elements, the second in an image.
Sheet sheet_of(const Scene& scene, const Macro& macro, const std::vector<Place>& places,
               const std::vector<Link>& linked);

}  // namespace hauberk::verification
