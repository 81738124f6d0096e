#pragma once
#include "model.hpp"

#include <optional>

namespace hauberk::verification {

/// An element of the cell and an image of an element. Each unordered pair occurs once.
struct Neighbour {
  int first = 0, second = 0;
  std::array<int, 2> image{};
};

/// The cell's translation for image (i, j) under the deformation F.
Vec3 translation(const Scene& scene, const Mat3& F, const std::array<int, 2>& image);

/// All pairs whose bounding spheres are no farther apart than `margin`, in a fixed order.
std::vector<Neighbour> neighbours(const Scene& scene, const std::vector<Place>& places, const Mat3& F,
                                  double margin);

/// Smallest separation of surfaces over all pairs, and whose it is.
struct Closest {
  double distance = 0.0;
  Neighbour pair;
  int first_torus = 0, second_torus = 0;
};
/// Nothing when all bounding spheres are farther apart than `margin`.
std::optional<Closest> closest_pair(const Scene& scene, const std::vector<Place>& places, const Mat3& F,
                                    double margin);

}  // namespace hauberk::verification
