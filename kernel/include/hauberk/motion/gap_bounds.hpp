#pragma once
/// Lower bounds of gaps that were certified once and hold, less what has moved, until bodies come near.

#include <hauberk/geometry/body.hpp>
#include <hauberk/mechanics/model.hpp>

#include <unordered_map>

namespace hauberk {

/// What is known of the gaps of a model's bodies, from one step to the next.
///
/// A gap (surface distance minus clearance) that is at least g where body A is at (c, R) in the frame of body
/// B is, where it is at (c', R'), at least
///
///     g - |c' - c| - |R' - R| r,
///
/// as no point of A, within r of its centre, has moved farther; of the two norms of matrices the spectral one
/// is meant, which of a difference of rotations is the Frobenius norm over sqrt(2). So an entry is good for
/// any states of the same model, in any order. Reading is thread safe, `remember` is not.
class GapBounds {
 public:
  /// Certified: no more than the gap of bodies a and b, b in this image, at these poses of their elements.
  /// Zero, or less, where nothing is known.
  double at_least(const Model& model, int a, const Pose& pa, int b, const Image& image, const Pose& pb) const;

  /// Keeps a lower bound of the gap at these poses, if it is better than what is there.
  void remember(const Model& model, int a, const Pose& pa, int b, const Image& image, const Pose& pb,
                double gap);

 private:
  struct Key {
    int a, b;
    Image image;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const;
  };
  struct Entry {
    double gap = 0.0;
    Vec3 centre;    ///< of A in B's frame, as is
    Mat3 rotation;  ///< this one
    double left(const Entry& now, double radius) const;
  };
  static Entry placed(const Model& model, int a, const Pose& pa, int b, const Pose& pb);

  std::unordered_map<Key, Entry, Hash> entries_;
};

}  // namespace hauberk
