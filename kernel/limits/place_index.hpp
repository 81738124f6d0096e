#pragma once
/// Which element, in which image, is at a place.

#include "model/model.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hauberk {

/// Coordinates of lattice translations: the integers nearest to those of x.
class LatticeCoordinates {
 public:
  explicit LatticeCoordinates(const Model& model);

  std::size_t size() const { return reciprocal_.size(); }
  /// The k-th coordinate of x along the lattice vectors.
  double at(std::size_t k, const Vec3& x) const { return reciprocal_[k].dot(x); }
  const Vec3& reciprocal(std::size_t k) const { return reciprocal_[k]; }
  Image nearest(const Vec3& x) const;

 private:
  std::vector<Vec3> reciprocal_;
};

/// An element of an image.
struct Placed {
  int element = 0;
  Image image{};
};

/// Finds rest positions by hashing. Immutable: thread safe.
class PlaceIndex {
 public:
  explicit PlaceIndex(const Model& model);

  /// All elements at x within symmetry_tolerance(x), in the order of elements; several may share an origin.
  void find(const Vec3& x, std::vector<Placed>& out) const;

 private:
  using Cell = std::array<std::int64_t, 3>;

  /// Position in units of grid cells.
  Vec3 grid(const Vec3& x) const;
  std::uint64_t key(Cell cell) const;

  const Model* model_;
  LatticeCoordinates lattice_;
  std::array<std::int64_t, 3> cells_{};  ///< per period; 0: nothing repeats
  std::unordered_map<std::uint64_t, std::vector<int>> elements_;
};

}  // namespace hauberk
