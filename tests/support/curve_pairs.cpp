#include "curve_pairs.hpp"

#include <scenes.hpp>

namespace hauberk::test {

Primitive circle(double R, double r)
{
  Primitive p;
  p.size = {R, r, r};
  return p;
}

Primitive ellipse(double R, double r0, double r1)
{
  Primitive p;
  p.kind = PrimitiveKind::revolved_ellipse;
  p.size = {R, r0, r1};
  return p;
}

Primitive curve_tube(std::vector<Harmonic> harmonics, double r)
{
  Primitive p;
  p.kind = PrimitiveKind::curve_tube;
  p.size = {1.0, r, r};
  p.curve = std::move(harmonics);
  return p;
}

Primitive circle_curve(double R, double r) { return curve_tube({{Vec3(R, 0, 0), Vec3(0, R, 0)}}, r); }

Primitive wavy(double size, double r, std::mt19937_64& rng)
{
  std::normal_distribution<double> normal(0.0, size);
  std::vector<Harmonic> h(3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double scale = 1.0 / static_cast<double>((k + 1) * (k + 1));
    for (int i = 0; i < 3; ++i) {
      h[k].c[i] = scale * normal(rng);
      h[k].s[i] = scale * normal(rng);
    }
  }
  h[0].c.x() += 1.1;
  h[0].s.y() += 0.9;
  return curve_tube(std::move(h), r);
}

Primitive knot(int p, int q, double r)
{
  std::vector<Harmonic> h(p + q);
  const auto at = [&h](int k) -> Harmonic& { return h[k - 1]; };
  at(p).c.x() += 1.0;
  at(p).s.y() += 1.0;
  at(q + p).c.x() += 0.2;
  at(q + p).s.y() += 0.2;
  at(std::abs(q - p)).c.x() += 0.2;
  at(std::abs(q - p)).s.y() -= q > p ? 0.2 : -0.2;
  at(q).s.z() += 0.4;
  return curve_tube(std::move(h), r);
}

Pose linked_pose(double distance, double turn, std::mt19937_64& rng)
{
  Pose pose;
  pose.position = Vec3(distance, 0, 0) + 0.1 * Vec3(random_rotation(rng).col(0));
  pose.rotation = random_rotation(rng, turn) * rotation_exp(Vec3(0.5 * std::numbers::pi, 0, 0));
  return pose;
}

}  // namespace hauberk::test
