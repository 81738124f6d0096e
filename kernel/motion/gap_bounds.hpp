#pragma once
/// Lower bounds of gaps that were certified once and hold, less what has moved, until bodies come near.

#include "geometry/pair_frame.hpp"
#include "model/model.hpp"

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace hauberk {

/// Where a probing body P is in the frame of the element that the probed body F belongs to.
struct RelativePlace {
  Vec3 centre = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
  double rounding = 0.0;  ///< of both, and of what is made of them

  RelativePlace() = default;
  RelativePlace(const Body& P, const Pose& pp, const Body& F, const Pose& pf);

  /// No point within `radius` of P's centre is farther than this from where it is in the other place:
  ///
  ///     |c' - c| + |R' - R| radius,
  ///
  /// of a difference of rotations the spectral norm, which is the Frobenius norm over sqrt(2); and rounding.
  double farthest(const RelativePlace& other, double radius) const;
};

/// A panel of P's probe set and a lower bound of the gap over it.
struct KnownPanel {
  Panel s;
  double gap = 0.0;
};

/// What is known of the gap (surface distance minus clearance) of two bodies at one relative placement.
struct KnownGap {
  RelativePlace place;             ///< of the body that probes, see second_probes()
  std::vector<KnownPanel> panels;  ///< all of the probe set, by rising bound; never empty
  long from_scratch = 0;           ///< closest points of the first look that began with nothing known

  /// How much smaller a gap may be at these poses of the elements of A and B.
  double lost(const Body& A, const Pose& pa, const Body& B, const Pose& pb) const;

  /// Certified: no more than the gap at these poses.
  double at_least(const Body& A, const Pose& pa, const Body& B, const Pose& pb) const
  {
    return panels.front().gap - lost(A, pa, B, pb);
  }
};

/// What is known of the gaps of a model's bodies, from one step to the next. It belongs to placements, not to
/// steps: an entry is good for any states of the same model, in any order, less what lies between. Reading is
/// thread safe, `remember` is not.
class GapBounds {
 public:
  /// Of bodies a and b, b in this image; null where nothing is known. Until the next `remember`.
  const KnownGap* known(int a, int b, const Image& image) const;

  /// Puts this in the place of what was known of a and b; nothing, where it is more than is worth keeping.
  void remember(int a, int b, const Image& image, KnownGap known);

 private:
  struct Key {
    int a, b;
    Image image;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const;
  };

  std::unordered_map<Key, KnownGap, Hash> entries_;
};

}  // namespace hauberk
