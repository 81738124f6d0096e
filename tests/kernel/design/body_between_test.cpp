/// Bodies between two designs: where they end, and that nothing of them is faster than is said.

#include "design/body_between.hpp"
#include "geometry/closed_curve.hpp"
#include "scenes.hpp"
#include "torus_solid.hpp"

#include <hauberk/solid.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hauberk::test {
namespace {

using std::numbers::pi;

enum class Kind { torus, curve, solid };

Primitive drawn(Kind kind, std::mt19937_64& rng)
{
  std::uniform_real_distribution<double> size(0.8, 1.5), place(-1.0, 1.0);
  Primitive out;
  const double R = size(rng);
  if (kind == Kind::solid) {
    out = torus_solid(R, 0.3 * size(rng), 2);
  } else if (kind == Kind::curve) {
    out.kind = PrimitiveKind::curve_tube;
    out.curve = {{Vec3(R, 0, 0.1 * place(rng)), Vec3(0, R, 0.1 * place(rng))},
                 {Vec3(0.1 * place(rng), 0, 0), Vec3(0, 0, 0.1 * place(rng))}};
    const double r = 0.2 * size(rng);
    out.size = {R, r, r};
  } else {
    out.kind = PrimitiveKind::revolved_ellipse;
    out.size = {R, 0.3 * size(rng), 0.3 * size(rng)};
  }
  out.position = Vec3(place(rng), place(rng), place(rng));
  out.rotation = random_rotation(rng, 0.99 * pi);
  return out;
}

/// The surface point of the same chart angles, in the element frame.
Vec3 surface_point(const Body& b, double u, double v)
{
  Vec3 x;
  if (b.solid) {
    x = b.solid->surface_point({std::cos(u), std::sin(u), std::cos(v), std::sin(v)}) / b.unit;
  } else if (b.curve) {
    // The tube's points face the same directions of its frame; of the circle around a core point that is
    // farthest along d the surface point is core + r d.
    const Vec3 d(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
    x = b.curve->at(Angle(u)).x + b.r0 * d;
  } else {
    const double w = b.R + b.r0 * std::cos(v);
    x = Vec3(w * std::cos(u), w * std::sin(u), b.r1 * std::sin(v));
  }
  return b.center + b.axes * x;
}

TEST(BodyBetween, NoSurfacePointIsFasterThanItsSpeed)
{
  std::mt19937_64 rng(31);
  for (const Kind kind : {Kind::torus, Kind::curve, Kind::solid}) {
    double closest = 0.0;
    for (int trial = 0; trial < 40; ++trial) {
      Primitive from = drawn(kind, rng), to = drawn(kind, rng);
      if (trial % 2 == 0) {  // a turn alone: then the speed is that of the farthest point
        const Mat3 rotation = to.rotation;
        to = from;
        to.rotation = rotation;
      }
      const Body a = make_body(from, 0, 0, 2.0), b = make_body(to, 0, 0, 2.0);
      const double speed = shape_speed(a, b);
      constexpr int steps = 24;
      for (int k = 0; k < steps; ++k) {
        const Body p = body_between(a, b, static_cast<double>(k) / steps);
        const Body q = body_between(a, b, static_cast<double>(k + 1) / steps);
        for (double u = 0.1; u < 2.0 * pi; u += 0.7)
          for (double v = 0.1; v < 2.0 * pi; v += 0.9) {
            const double moved = (surface_point(q, u, v) - surface_point(p, u, v)).norm() * steps;
            ASSERT_LE(moved, speed * (1.0 + 1e-9)) << trial << " " << k;
            closest = std::max(closest, moved / speed);
          }
      }
    }
    EXPECT_GT(closest, 0.9);
  }
}

TEST(BodyBetween, EndsWhereTheOtherBodyIs)
{
  std::mt19937_64 rng(32);
  const Mat3 half_turn = rotation_exp(pi * Vec3(1.0, 2.0, -2.0) / 3.0);
  for (int trial = 0; trial < 20; ++trial) {
    const Primitive from = drawn(Kind::torus, rng);
    Primitive to = drawn(Kind::torus, rng);
    if (trial % 4 == 0) to.rotation = half_turn * from.rotation;
    if (trial % 4 == 1) to.rotation = rotation_exp((pi - 1e-8) * Vec3(0.6, 0.8, 0.0)) * from.rotation;
    if (trial % 4 == 2) to.rotation = from.rotation;
    const Body a = make_body(from, 0, 0, 1.0), b = make_body(to, 0, 0, 1.0);
    EXPECT_LT((body_between(a, b, 1.0).axes - b.axes).norm(), 1e-14) << trial;
    EXPECT_EQ(body_between(a, b, 0.0).axes, a.axes);
    // Half of the way is as far from both ends.
    const Mat3 middle = body_between(a, b, 0.5).axes;
    EXPECT_NEAR((middle - a.axes).norm(), (middle - b.axes).norm(), 1e-14) << trial;
    if (trial % 4 == 2) {
      EXPECT_EQ(middle, a.axes);
    }
  }
}

}  // namespace
}  // namespace hauberk::test
