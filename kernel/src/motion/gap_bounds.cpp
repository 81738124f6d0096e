#include <hauberk/motion/gap_bounds.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

constexpr double rounding = 1e-12;  ///< L, of places and of what is made of them

}  // namespace

std::size_t GapBounds::Hash::operator()(const Key& k) const
{
  std::size_t h = 0;
  for (const int part : {k.a, k.b, k.image[0], k.image[1], k.image[2]})
    h = (h ^ static_cast<std::size_t>(static_cast<unsigned>(part))) * 0x9e3779b97f4a7c15U;
  return h ^ (h >> 29U);
}

double GapBounds::Entry::left(const Entry& now, double radius) const
{
  const double moved = (now.centre - centre).norm();
  return gap - moved - (now.rotation - rotation).norm() * std::sqrt(0.5) * radius - rounding;
}

GapBounds::Entry GapBounds::placed(const Model& model, int a, const Pose& pa, int b, const Pose& pb)
{
  const Body &A = model.bodies[static_cast<std::size_t>(a)], &B = model.bodies[static_cast<std::size_t>(b)];
  const Mat3 to_b = pb.rotation.transpose();
  Entry e;
  e.centre = to_b * (pa.position + pa.rotation * A.center - pb.position) - B.center;
  e.rotation = to_b * pa.rotation;
  return e;
}

double GapBounds::at_least(const Model& model, int a, const Pose& pa, int b, const Image& image,
                           const Pose& pb) const
{
  const auto known = entries_.find({a, b, image});
  if (known == entries_.end()) return 0.0;
  return known->second.left(placed(model, a, pa, b, pb), model.bodies[static_cast<std::size_t>(a)].bound);
}

void GapBounds::remember(const Model& model, int a, const Pose& pa, int b, const Image& image, const Pose& pb,
                         double gap)
{
  Entry now = placed(model, a, pa, b, pb);
  now.gap = gap;
  const auto [known, added] = entries_.try_emplace({a, b, image}, now);
  if (!added && known->second.left(now, model.bodies[static_cast<std::size_t>(a)].bound) < gap)
    known->second = now;
}

}  // namespace hauberk
