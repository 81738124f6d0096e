#include "motion/gap_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hauberk {
namespace {

/// Of rotations and of what is made of places of order 1, L.
constexpr double rounding_at_origin = 1e-12;
/// Panels of a pair that are worth their memory: ten times those of surfaces that are about to touch.
constexpr std::size_t most_panels = 100000;

}  // namespace

RelativePlace::RelativePlace(const Body& P, const Pose& pp, const Body& F, const Pose& pf)
{
  const Mat3 to_f = pf.rotation.transpose();
  centre = to_f * (pp.position + pp.rotation * P.center - pf.position) - F.center;
  rotation = to_f * pp.rotation;
  rounding = rounding_at_origin +
             4.0 * std::numeric_limits<double>::epsilon() * (pp.position.norm() + pf.position.norm());
}

double RelativePlace::farthest(const RelativePlace& other, double radius) const
{
  return (other.centre - centre).norm() + (other.rotation - rotation).norm() * std::sqrt(0.5) * radius +
         std::max(rounding, other.rounding);
}

double KnownGap::lost(const Body& A, const Pose& pa, const Body& B, const Pose& pb) const
{
  return second_probes(A, B) ? place.farthest({B, pb, A, pa}, B.bound)
                             : place.farthest({A, pa, B, pb}, A.bound);
}

std::size_t GapBounds::Hash::operator()(const Key& k) const
{
  std::size_t h = 0;
  for (const int part : {k.a, k.b, k.image[0], k.image[1], k.image[2]})
    h = (h ^ static_cast<std::size_t>(static_cast<unsigned>(part))) * 0x9e3779b97f4a7c15U;
  return h ^ (h >> 29U);
}

const KnownGap* GapBounds::known(int a, int b, const Image& image) const
{
  const auto found = entries_.find({a, b, image});
  return found == entries_.end() ? nullptr : &found->second;
}

void GapBounds::remember(int a, int b, const Image& image, KnownGap known)
{
  if (known.panels.size() > most_panels) {
    entries_.erase({a, b, image});
  } else {
    entries_.insert_or_assign({a, b, image}, std::move(known));
  }
}

}  // namespace hauberk
