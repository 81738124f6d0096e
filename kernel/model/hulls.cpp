#include "model/hulls.hpp"

#include "geometry/closed_curve.hpp"
#include "model/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk {
namespace {

/// Support function of a body, the largest d . x, or slightly more; of a triangle mesh and of a solid that of
/// a ball.
double support(const Body& b, const Pose& pose, const Vec3& d)
{
  const Frame f = world_frame(b, pose);
  const Vec3 local = f.axes.transpose() * d;
  if (b.surface || b.solid) return f.center.dot(d) + b.bound * d.norm();
  if (!b.curve) {
    const double across = std::hypot(local.x(), local.y());
    return f.center.dot(d) + b.R * across + std::hypot(b.r0 * across, b.r1 * local.z());
  }
  constexpr int samples = 128;
  const double h = 2.0 * std::numbers::pi / samples;
  double most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < samples; ++k) most = std::max(most, local.dot(b.curve->at(Angle(h * k)).x));
  // Between two samples the curve is no farther than this beyond their chord.
  return f.center.dot(d) + most + (b.curve->second() * h * h / 8.0 + b.r0) * d.norm();
}

/// Width of the hulls' overlap along d: below zero a plane across d lies between them.
class Overlap {
 public:
  Overlap(const Model& m, int i, const Pose& first, int j, const Pose& second)
      : m_(m), i_(i), j_(j), first_(first), second_(second)
  {
  }
  double along(const Vec3& d) const { return of(i_, first_, d) + of(j_, second_, -d); }

 private:
  double of(int element, const Pose& pose, const Vec3& d) const
  {
    const std::size_t e = element;
    double most = -std::numeric_limits<double>::infinity();
    for (int k = m_.first_body[e]; k < m_.first_body[e + 1]; ++k)
      most = std::max(most, support(m_.bodies[k], pose, d));
    return most;
  }
  const Model& m_;
  int i_, j_;
  const Pose &first_, &second_;
};

/// From the best of a few directions downhill; where the width is negative it has no other minima, since it
/// is convex over the ball of directions.
bool plane_between(const Overlap& overlap, const Vec3& ahead)
{
  Vec3 d = ahead;
  double width = overlap.along(d);
  const auto keep = [&](const Vec3& other) {
    if (!(other.norm() > 0.0)) return false;
    const Vec3 unit = other.normalized();
    const double there = overlap.along(unit);
    if (there >= width) return false;
    width = there;
    d = unit;
    return true;
  };
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) keep(Vec3(x, y, z));
  for (double step = 0.5; step > 1e-6 && width >= 0.0;) {
    bool fell = false;
    for (Eigen::Index k = 0; k < 3; ++k)
      for (const double way : {step, -step}) fell = keep(d + way * Vec3::Unit(k)) || fell;
    if (!fell) step *= 0.5;
  }
  return width < 0.0;
}

}  // namespace

bool hulls_apart(const Model& m, const State& s)
{
  const std::vector<Pose> p = poses(m, s);
  for (const ElementPair& pair : near_pairs(m, s, 0.0)) {
    const Pose& first = p[pair.i];
    const Pose second = image_pose(m, s, pair.j, pair.image);
    const Vec3 between = second.position - first.position;
    const Vec3 ahead = between.norm() > 0.0 ? between.normalized() : Vec3(Vec3::UnitZ());
    if (!plane_between(Overlap(m, pair.i, first, pair.j, second), ahead)) return false;
  }
  return true;
}

}  // namespace hauberk
