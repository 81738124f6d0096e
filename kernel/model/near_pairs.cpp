#include "model/near_pairs.hpp"

#include "model/model.hpp"
#include "numerics/interrupted.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

namespace hauberk {
namespace {

/// Images of one pair that are looked at.
constexpr double most_images = 1e8;
/// Of fewer elements all pairs are looked at.
constexpr int few = 64;
/// Buckets an element, at most: in cells that are nearly empty all pairs are looked at.
constexpr double few_buckets = 100.0;

double widest_reach(const Model& m) { return *std::max_element(m.reach.begin(), m.reach.end()); }

/// All pairs of a patch, looked at one by one.
std::vector<ElementPair> pairs_one_by_one(const Model& m, const std::vector<Pose>& p, double margin)
{
  std::vector<ElementPair> pairs;
  const int n = m.element_count();
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      const std::size_t a = i, b = j;
      if ((p[a].position - p[b].position).norm() < m.reach[a] + m.reach[b] + margin)
        pairs.push_back({i, j, {}});
    }
  }
  return pairs;
}

using Bucket = std::array<int, 3>;

/// The same through buckets as wide as any pair's reach: neighbours are in neighbouring ones.
std::vector<ElementPair> pairs_by_buckets(const Model& m, const std::vector<Pose>& p, double margin)
{
  const double width = 2.0 * widest_reach(m) + margin;
  const auto bucket = [width](const Vec3& x) {
    const Vec3 cell = (x / width).array().floor();
    return Bucket{static_cast<int>(cell[0]), static_cast<int>(cell[1]), static_cast<int>(cell[2])};
  };
  std::map<Bucket, std::vector<int>> buckets;
  for (int i = 0; i < m.element_count(); ++i) buckets[bucket(p[i].position)].push_back(i);
  std::vector<ElementPair> pairs;
  for (int i = 0; i < m.element_count(); ++i) {
    const std::size_t a = i;
    const Bucket at = bucket(p[a].position);
    const std::size_t first = pairs.size();
    for (int k = 0; k < 27; ++k) {
      const auto found = buckets.find({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1});
      if (found == buckets.end()) continue;
      for (const int j : found->second) {
        const std::size_t b = j;
        if (j > i && (p[a].position - p[b].position).norm() < m.reach[a] + m.reach[b] + margin)
          pairs.push_back({i, j, {}});
      }
    }
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
              [](const ElementPair& x, const ElementPair& y) { return x.j < y.j; });
  }
  return pairs;
}

/// The deformed lattice: images are x + k t1 + l t2, in the plane, or with a third vector in space.
struct DeformedLattice {
  Mat3 inverse;                 ///< of (t1, t2, t3); of a sheet t3 = e_z
  std::array<double, 3> row{};  ///< norms of its rows: coordinates of a vector are at most that times its
                                ///< length; 0 where there is no vector

  DeformedLattice(const Model& m, const State& s, const std::vector<Pose>& p)
  {
    Mat3 lattice = Mat3::Identity();
    for (std::size_t k = 0; k < m.lattice.size(); ++k) {
      Image image{};
      image[k] = 1;
      const auto column = static_cast<Eigen::Index>(k);
      lattice.col(column) = image_pose(m, s, 0, image).position - p.front().position;
      if (m.lattice.size() < 3) lattice(2, column) = 0.0;
    }
    inverse = lattice.inverse();
    for (std::size_t k = 0; k < m.lattice.size(); ++k) row[k] = inverse.row(k).norm();
  }
};

/// Of an element and its own images, one of each two that are opposite.
bool counts(const Image& image) { return image > Image{}; }

/// All pairs of a cell and its images, looked at one by one: those images of which x_i is within reach.
std::vector<ElementPair> images_one_by_one(const Model& m, const State& s, const std::vector<Pose>& p,
                                           double margin, const std::function<bool()>* keep_going)
{
  constexpr double slack = 1e-9;  // for rounding; distances decide
  const DeformedLattice lattice(m, s, p);
  std::vector<ElementPair> pairs;
  const int n = m.element_count();
  long looked = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) {
      const std::size_t a = i, b = j;
      const double r = m.reach[a] + m.reach[b] + margin;
      const Vec3 at = lattice.inverse * (p[a].position - p[b].position);
      Image first{}, last{};
      double images = 1.0;
      for (std::size_t k = 0; k < m.lattice.size(); ++k) {
        const double width = r * lattice.row[k] + slack, middle = at[k];
        images *= 2.0 * width + 1.0;
        if (!(images <= most_images)) {
          throw ComputationError(
              fmt::format("elements {} and {}: more than {:g} images of the cell are within their reach", i,
                          j, most_images));
        }
        first[k] = static_cast<int>(std::ceil(middle - width));
        last[k] = static_cast<int>(std::floor(middle + width));
      }
      Image image;
      for (image[0] = first[0]; image[0] <= last[0]; ++image[0]) {
        for (image[1] = first[1]; image[1] <= last[1]; ++image[1]) {
          for (image[2] = first[2]; image[2] <= last[2]; ++image[2]) {
            poll(keep_going, ++looked);
            if (i == j && !counts(image)) continue;
            const Vec3 x = image_pose(m, s, j, image).position;
            if ((p[a].position - x).norm() < r) pairs.push_back({i, j, image});
          }
        }
      }
    }
  }
  return pairs;
}

/// A cell with so many elements that buckets pay: columns and rows of the deformed lattice, as wide as any
/// pair's reach.
class LatticeBuckets {
 public:
  LatticeBuckets(const Model& m, const State& s, const std::vector<Pose>& p, double margin)
      : m_(m), s_(s), p_(p), margin_(margin), lattice_(m, s, p)
  {
    // 1/row is how far apart lines of the lattice are.
    const double width = 2.0 * widest_reach(m) + margin;
    const double most = m.element_count();  // more would be empty
    count_ = {static_cast<int>(std::min(most, 1.0 / (lattice_.row[0] * width))),
              static_cast<int>(std::min(most, 1.0 / (lattice_.row[1] * width)))};
    // A long cell has many along one side only.
    if (static_cast<double>(count_[0]) * count_[1] > few_buckets * most) count_ = {0, 0};
  }

  /// Fewer than three along a side would meet themselves. In space all pairs are looked at.
  bool pay() const { return m_.lattice.size() == 2 && count_[0] >= 3 && count_[1] >= 3; }

  std::vector<ElementPair> pairs()
  {
    fill();
    std::vector<ElementPair> out;
    for (int i = 0; i < m_.element_count(); ++i) {
      const std::size_t first = out.size();
      for (int k = 0; k < 9; ++k) add_from(i, k % 3 - 1, k / 3 - 1, out);
      std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                [](const ElementPair& x, const ElementPair& y) {
                  return x.j != y.j ? x.j < y.j : x.image < y.image;
                });
    }
    return out;
  }

 private:
  /// Where an element is: its bucket in the cell, and the cell.
  struct Place {
    std::array<int, 2> bucket{}, cell{};
  };

  void fill()
  {
    buckets_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]));
    for (int i = 0; i < m_.element_count(); ++i) {
      const Vec3 x = lattice_.inverse * p_[i].position;
      Place place;
      for (std::size_t k = 0; k < 2; ++k) {
        const double coordinate = x[k], cell = std::floor(coordinate);
        place.cell[k] = static_cast<int>(cell);
        place.bucket[k] = std::min(count_[k] - 1, static_cast<int>((coordinate - cell) * count_[k]));
      }
      places_.push_back(place);
      bucket(place.bucket).push_back(i);
    }
  }

  std::vector<int>& bucket(const std::array<int, 2>& at)
  {
    const int number = at[0] * count_[1] + at[1];
    return buckets_[number];
  }

  /// Pairs of i with elements of the bucket d1, d2 away.
  void add_from(int i, int d1, int d2, std::vector<ElementPair>& out)
  {
    const Place& at = places_[i];
    std::array<int, 2> there{at.bucket[0] + d1, at.bucket[1] + d2}, beyond{};
    for (std::size_t k = 0; k < 2; ++k) {
      beyond[k] = there[k] < 0 ? -1 : there[k] >= count_[k] ? 1 : 0;
      there[k] -= beyond[k] * count_[k];
    }
    const std::size_t a = i;
    for (const int j : bucket(there)) {
      if (j < i) continue;
      const std::size_t b = j;
      const Image image{beyond[0] - places_[b].cell[0] + at.cell[0],
                        beyond[1] - places_[b].cell[1] + at.cell[1], 0};
      if (i == j && !counts(image)) continue;
      const Vec3 x = image_pose(m_, s_, j, image).position;
      if ((p_[a].position - x).norm() < m_.reach[a] + m_.reach[b] + margin_) out.push_back({i, j, image});
    }
  }

  const Model& m_;
  const State& s_;
  const std::vector<Pose>& p_;
  double margin_;
  DeformedLattice lattice_;
  std::array<int, 2> count_{};
  std::vector<Place> places_;
  std::vector<std::vector<int>> buckets_;
};

}  // namespace

std::vector<ElementPair> near_pairs(const Model& m, const State& s, double margin,
                                    const std::function<bool()>* keep_going)
{
  const std::vector<Pose> p = poses(m, s);
  const bool finite = std::isfinite(margin) && s.macro.allFinite() && s.e.allFinite();
  if (!finite) throw ComputationError("the state is not finite: a step went wrong");
  if (m.lattice.empty())
    return m.element_count() < few ? pairs_one_by_one(m, p, margin) : pairs_by_buckets(m, p, margin);
  if (m.element_count() >= few) {
    LatticeBuckets buckets(m, s, p, margin);
    if (buckets.pay()) return buckets.pairs();
  }
  return images_one_by_one(m, s, p, margin, keep_going);
}

}  // namespace hauberk
