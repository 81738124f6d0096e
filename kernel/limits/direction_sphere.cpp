#include "limits/boundary.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace hauberk {
namespace {

/// A point of a subdivided face as whole multiples of the icosahedron's vertices (index, count), in ascending
/// order: the same for all faces that share it, so that it is made once, and from the same sum.
using Weights = std::array<std::pair<int, int>, 3>;

/// (0, +-1, +-g) and its cyclic permutations, g the golden ratio.
std::array<Vec3, 12> icosahedron()
{
  std::array<Vec3, 12> out;
  std::size_t k = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double one : {1.0, -1.0}) {
      for (const double golden : {std::numbers::phi, -std::numbers::phi}) {
        Vec3 v = Vec3::Zero();
        v[(axis + 1) % 3] = one;
        v[(axis + 2) % 3] = golden;
        out[k++] = v;
      }
    }
  }
  return out;
}

/// Triples of vertices whose distances are all the edge length 2, counter-clockwise from outside.
std::vector<Triangle> faces(const std::array<Vec3, 12>& v)
{
  constexpr double longer_than_edge = 2.1;  // the next distance is 2 g = 3.24
  const auto edge = [&v](int a, int b) { return (v[a] - v[b]).norm() < longer_than_edge; };
  std::vector<Triangle> out;
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      for (int c = b + 1; c < 12; ++c) {
        if (!edge(a, b) || !edge(b, c) || !edge(a, c)) continue;
        const Vec3 &A = v[a], &B = v[b], &C = v[c];
        out.push_back(A.dot(B.cross(C)) > 0.0 ? Triangle{a, b, c} : Triangle{a, c, b});
      }
    }
  }
  return out;
}

class Subdivision {
 public:
  Subdivision(int parts, const std::array<double, 3>& metric)
      : parts_(parts), metric_(metric), corners_(icosahedron())
  {
    for (const Triangle& face : faces(corners_)) divide(face);
  }

  DirectionSphere sphere() && { return std::move(sphere_); }

 private:
  /// The point i/parts of the way from the first corner to the second and j/parts to the third.
  int point(const Triangle& face, int i, int j)
  {
    Weights weights{std::pair{face[0], parts_ - i - j}, std::pair{face[1], i}, std::pair{face[2], j}};
    for (auto& [corner, weight] : weights) corner = weight == 0 ? -1 : corner;
    std::sort(weights.begin(), weights.end());
    const auto [at, fresh] = known_.emplace(weights, static_cast<int>(sphere_.directions.size()));
    if (!fresh) return at->second;
    Vec3 x = Vec3::Zero();
    for (const auto& [corner, weight] : weights) {
      if (weight > 0) x += weight * corners_[corner];
    }
    x.normalize();
    for (int k = 0; k < 3; ++k) x[k] /= std::sqrt(metric_[k]);
    sphere_.directions.push_back(Direction::along({x.data(), 3}));
    return at->second;
  }

  void divide(const Triangle& face)
  {
    for (int i = 0; i < parts_; ++i) {
      for (int j = 0; i + j < parts_; ++j) {
        sphere_.triangles.push_back({point(face, i, j), point(face, i + 1, j), point(face, i, j + 1)});
        if (i + j + 1 < parts_) {
          sphere_.triangles.push_back(
              {point(face, i + 1, j), point(face, i + 1, j + 1), point(face, i, j + 1)});
        }
      }
    }
  }

  int parts_;
  std::array<double, 3> metric_;
  std::array<Vec3, 12> corners_;
  std::map<Weights, int> known_;
  DirectionSphere sphere_;
};

}  // namespace

DirectionSphere direction_sphere(int parts, const LoadCase& load)
{
  if (parts < 1 || parts > most_parts)
    throw InputError(fmt::format("expected 1 to {} parts of an edge, found {}", most_parts, parts));
  if (load.macro_count() != 3 || !load.takes_components())
    throw InputError("a sphere of directions needs three unknowns that all have the unit of the value");
  std::array<double, 3> metric{};
  load.metric(metric);
  return Subdivision(parts, metric).sphere();
}

}  // namespace hauberk
