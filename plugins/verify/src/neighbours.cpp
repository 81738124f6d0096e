#include "neighbours.hpp"

#include "separation.hpp"
#include "surface.hpp"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk::verification {
namespace {

/// Images of a second element that may be near a first one: with d = x_first - x_second and columns of A the
/// deformed cell vectors, |A i - d| <= reach needs i within |row of A^-1| reach of A^-1 d. Least and largest,
/// as numbers, since they may be beyond integers.
std::array<Vec3, 2> images_within(const Mat3& inverse, const Vec3& d, double reach, int vectors)
{
  const Vec3 centre = inverse * d;
  std::array<Vec3, 2> out{Vec3::Zero(), Vec3::Zero()};
  for (int r = 0; r < vectors; ++r) {
    const double radius = inverse.row(r).norm() * reach;
    out[0][r] = std::floor(centre[r] - radius);
    out[1][r] = std::ceil(centre[r] + radius);
  }
  return out;
}

/// The deformed cell vectors; where there are fewer than three, the others' images are 0.
Mat3 cell_matrix(const Scene& scene, const Mat3& F)
{
  Mat3 A = Mat3::Identity();
  for (std::size_t k = 0; k < scene.cell.size(); ++k) A.col(k) = F * scene.cell[k];
  return A;
}

}  // namespace

Vec3 translation(const Scene& scene, const Mat3& F, const Image& image)
{
  if (scene.cell.empty()) return Vec3::Zero();
  Vec3 T = Vec3::Zero();
  for (std::size_t k = 0; k < scene.cell.size(); ++k) T += image[k] * scene.cell[k];
  return F * T;
}

std::string shown(const Image& image)
{
  return image[2] == 0 ? fmt::format("({}, {})", image[0], image[1])
                       : fmt::format("({}, {}, {})", image[0], image[1], image[2]);
}

double images_near(const Scene& scene, const std::vector<Place>& places, const Mat3& F, double margin)
{
  if (scene.cell.empty()) return 0.0;
  const Mat3 inverse = cell_matrix(scene, F).inverse();
  double count = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t l = k; l < places.size(); ++l) {
      const auto [low, high] = images_within(inverse, places[k].position - places[l].position,
                                             scene.elements[k].reach + scene.elements[l].reach + margin,
                                             static_cast<int>(scene.cell.size()));
      count += (high - low + Vec3::Ones()).prod();
      const bool beyond_integers = low.minCoeff() < -1e9 || high.maxCoeff() > 1e9;
      if (beyond_integers) return std::numeric_limits<double>::infinity();
    }
  }
  return count;
}

std::vector<Neighbour> neighbours(const Scene& scene, const std::vector<Place>& places, const Mat3& F,
                                  double margin)
{
  std::vector<Neighbour> out;
  if (scene.cell.empty()) {
    for (std::size_t k = 0; k < places.size(); ++k)
      for (std::size_t l = k + 1; l < places.size(); ++l)
        if ((places[k].position - places[l].position).norm() <=
            scene.elements[k].reach + scene.elements[l].reach + margin)
          out.push_back({static_cast<int>(k), static_cast<int>(l), {}});
    return out;
  }
  if (!(images_near(scene, places, F, margin) <= most_images(places.size())))
    throw Malformed(
        fmt::format("more than {:g} images of elements may be near each other", most_images(places.size())));
  const Mat3 A = cell_matrix(scene, F), inverse = A.inverse();
  const int vectors = static_cast<int>(scene.cell.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t l = k; l < places.size(); ++l) {
      const Vec3 d = places[k].position - places[l].position;
      const double reach = scene.elements[k].reach + scene.elements[l].reach + margin;
      const auto [low, high] = images_within(inverse, d, reach, vectors);
      for (double x = low[0]; x <= high[0]; ++x) {
        for (double y = low[1]; y <= high[1]; ++y) {
          for (double z = low[2]; z <= high[2]; ++z) {
            const Image image{static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
            // An element and its own image are the same pair as with the opposite image.
            if (k == l && image <= Image{}) continue;
            if ((A * Vec3(x, y, z) - d).norm() <= reach)
              out.push_back({static_cast<int>(k), static_cast<int>(l), image});
          }
        }
      }
    }
  }
  return out;
}

std::optional<Closest> closest_pair(const Scene& scene, const std::vector<Place>& places, const Mat3& F,
                                    double margin, double width)
{
  struct Candidate {
    Closest closest;  ///< distance is a lower bound
    Primitive first, second;
  };
  std::vector<Candidate> candidates;
  for (const Neighbour& pair : neighbours(scene, places, F, margin)) {
    const std::size_t k = pair.first, l = pair.second;
    Place image = places[l];
    image.position += translation(scene, F, pair.image);
    const auto &first = scene.elements[k].tori, &second = scene.elements[l].tori;
    for (std::size_t p = 0; p < first.size(); ++p)
      for (std::size_t q = 0; q < second.size(); ++q) {
        Candidate c{{0.0, 0.0, pair, static_cast<int>(p), static_cast<int>(q)},
                    placed(first[p], places[k]),
                    placed(second[q], image)};
        c.closest.distance = separation_bound(c.first, c.second);
        candidates.push_back(std::move(c));
      }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.closest.distance < b.closest.distance; });
  std::optional<Closest> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    if (best && c.closest.distance > best->distance) break;  // bounds only grow from here
    const double enough = best ? best->distance : std::numeric_limits<double>::infinity();
    const Enclosure found = enclosed_separation(c.first, c.second, width, enough);
    least = std::min(least, found.least);
    if (best && best->distance <= found.found) continue;
    best = c.closest;
    best->distance = found.found;
  }
  if (best) best->least = std::min(least, best->distance);
  return best;
}

}  // namespace hauberk::verification
