#pragma once
/// Which elements can meet.

#include "model.hpp"

#include <optional>
#include <string>

namespace hauberk::verification {

/// An element of the cell and an image of an element. Each unordered pair occurs once.
struct Neighbour {
  int first = 0, second = 0;
  Image image{};
};

/// The cell's translation for an image under the deformation F.
Vec3 translation(const Scene& scene, const Mat3& F, const Image& image);

/// "(0, 1)", of solids "(0, 1, -1)"; the third number is left out where it is 0.
std::string shown(const Image& image);

/// How many images `neighbours` would look at: of a cell that is small beside its elements millions.
double images_near(const Scene& scene, const std::vector<Place>& places, const Mat3& F, double margin);

/// No fabric has as many: a hundred for each pair of its elements, and some million for small cells.
inline double most_images(std::size_t elements)
{
  const auto n = static_cast<double>(elements);
  return 5e6 + 50.0 * n * n;
}

/// All pairs whose bounding spheres are no farther apart than `margin`, in a fixed order. Throws Malformed
/// where these would be more than most_images().
std::vector<Neighbour> neighbours(const Scene& scene, const std::vector<Place>& places, const Mat3& F,
                                  double margin);

/// Smallest separation of surfaces over all pairs, and whose it is.
struct Closest {
  double distance = 0.0;
  double least = 0.0;  ///< no two surfaces are nearer; `distance` where no solids are
  Neighbour pair;
  int first_torus = 0, second_torus = 0;
};
/// Nothing when all bounding spheres are farther apart than `margin`. Pairs with a solid are enclosed within
/// `width`, as far as the search comes.
std::optional<Closest> closest_pair(const Scene& scene, const std::vector<Place>& places, const Mat3& F,
                                    double margin, double width);

}  // namespace hauberk::verification
