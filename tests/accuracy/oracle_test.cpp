// The brute force itself, checked against plain sampling of both surfaces: no reduction, no closed form.

#include "circle_roots.hpp"
#include "random_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::brute {
namespace {

using std::numbers::pi;

/// Smallest distance of two surface samples, then steepest pattern search over the four angles.
double sampled_distance(const Torus& a, const Torus& b)
{
  constexpr int nu = 48, nv = 16;
  std::vector<Vec3> p, q;
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      p.push_back(a.surface(2 * pi * i / nu, 2 * pi * j / nv));
      q.push_back(b.surface(2 * pi * i / nu, 2 * pi * j / nv));
    }
  }
  struct Start {
    double d;
    std::array<double, 4> c;
  };
  std::vector<Start> starts;
  for (int i = 0; i < nu * nv; ++i) {
    double best = 1e300;
    int at = 0;
    for (int j = 0; j < nu * nv; ++j) {
      const double d = (p[i] - q[j]).squaredNorm();
      if (d < best) {
        best = d;
        at = j;
      }
    }
    const int row = i / nv, other = at / nv;
    starts.push_back(
        {best, {2 * pi * row / nu, 2 * pi * (i % nv) / nv, 2 * pi * other / nu, 2 * pi * (at % nv) / nv}});
  }
  std::sort(starts.begin(), starts.end(), [](const Start& x, const Start& y) { return x.d < y.d; });
  const auto distance = [&](const std::array<double, 4>& c) {
    return (a.surface(c[0], c[1]) - b.surface(c[2], c[3])).norm();
  };
  double best = 1e300;
  for (std::size_t k = 0; k < 12; ++k) {
    std::array<double, 4> c = starts[k].c, e{};
    double d = distance(c), step = 0.1;
    while (step > 1e-7) {
      bool moved = false;
      e = c;
      for (std::size_t i = 0; i < 4; ++i) {
        for (const double s : {step, -step}) {
          std::array<double, 4> t = c;
          t[i] += s;
          if (distance(t) < d) {
            c = t;
            d = distance(t);
            moved = true;
            break;
          }
        }
      }
      if (moved) {
        std::array<double, 4> t;
        for (std::size_t i = 0; i < 4; ++i) t[i] = 2.0 * c[i] - e[i];
        if (distance(t) < d) {
          c = t;
          d = distance(t);
        }
      } else {
        step *= 0.5;
      }
    }
    best = std::min(best, d);
  }
  return best;
}

TEST(Oracle, FootLiesOnTheSurfaceAndIsTheClosestOfManySamples)
{
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int k = 0; k < 300; ++k) {
    Torus t;
    t.axes = any_rotation(rng);
    t.r0 = 0.05 + 0.4 * u(rng);
    t.r1 = k % 3 == 0 ? t.r0 : t.r0 * std::pow(5.0, 2.0 * u(rng) - 1.0);
    const Vec3 x = 2.0 * u(rng) * any_direction(rng);
    const Foot f = foot(t, x);
    const Vec3 y = t.axes.transpose() * f.point;
    const double X = (std::hypot(y.x(), y.y()) - t.R) / t.r0, Z = y.z() / t.r1;
    EXPECT_NEAR(X * X + Z * Z, 1.0, 1e-9);
    double nearest = 1e300;
    for (int i = 0; i < 200; ++i) {
      for (int j = 0; j < 100; ++j)
        nearest = std::min(nearest, (x - t.surface(2 * pi * i / 200, 2 * pi * j / 100)).norm());
    }
    EXPECT_GE(nearest, std::abs(f.distance) - 1e-12);
    EXPECT_LE(nearest, std::abs(f.distance) + 0.06);
  }
}

TEST(Oracle, AgreesWithSamplingOfBothSurfaces)
{
  int compared = 0;
  for (long k = 0; k < 72; ++k) {
    const TorusPair p = random_pair(k);
    const double d = surface_distance(p.a, p.b);
    if (d < 0.02) continue;  // two samples near touching surfaces slide, pattern search is too slow there
    ++compared;
    const double sampled = sampled_distance(p.a, p.b);
    EXPECT_GE(sampled, d - 1e-9) << "pair " << k << ' ' << name(p.family);
    EXPECT_LE(sampled, d + 2e-3 * (1.0 + d)) << "pair " << k << ' ' << name(p.family);
  }
  EXPECT_GT(compared, 30);
}

TEST(Oracle, ProbingEitherTorusGivesTheSame)
{
  for (long k = 0; k < 240; ++k) {
    const TorusPair p = random_pair(k);
    const double ab = all_minima(p.a, p.b).front().distance, ba = all_minima(p.b, p.a).front().distance;
    if (ab <= 0.0 || ba <= 0.0) continue;
    EXPECT_NEAR(ab, ba, 1e-10) << "pair " << k << ' ' << name(p.family);
  }
}

TEST(Oracle, LeavesASaddleThatLiesOnASample)
{
  // u = 0, v = pi is a saddle by symmetry; the minima on both sides of it are 2e-9 lower, 0.03 rad away.
  const TorusPair p = random_pair(11729);
  ASSERT_EQ(p.family, Family::through_center);
  const Sampling dense{4096, 1024, 256};
  EXPECT_NEAR(surface_distance(p.a, p.b), surface_distance(p.b, p.a, dense), 1e-14);
  EXPECT_NEAR(surface_distance(p.a, p.b), 0.384943342068083, 1e-14);
}

TEST(Oracle, GaussIntegralKnowsTheHopfLink)
{
  Torus a, b;
  b.axes = rotation_exp(Vec3(0.5 * pi, 0, 0));
  b.center = Vec3(1, 0, 0);
  EXPECT_EQ(std::abs(gauss_linking(a, b)), 1);
  EXPECT_EQ(gauss_linking(a, b), gauss_linking(b, a));
  b.center = Vec3(2.5, 0, 0);
  EXPECT_EQ(gauss_linking(a, b), 0);
  b.center = Vec3(0.5, 0, 0);
  b.R = 0.3;
  EXPECT_EQ(gauss_linking(a, b), 0);
}

}  // namespace
}  // namespace hauberk::brute
