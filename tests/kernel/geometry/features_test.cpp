/// Nearest points of features against the distance of convex hulls, and the search for near ones against all
/// of them.

#include <scenes.hpp>
#include "geometry/facets.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <set>

namespace hauberk::test {
namespace {

Vec3 random_point(std::mt19937_64& rng)
{
  std::normal_distribution<double> normal;
  return {normal(rng), normal(rng), normal(rng)};
}

/// Distance of the hulls of up to three points each: the smallest over all subsets of corners whose affine
/// hulls have their nearest points inside.
double hull_distance(const std::array<Vec3, 3>& p, int np, const std::array<Vec3, 3>& f, int nf)
{
  double best = std::numeric_limits<double>::infinity();
  for (int mp = 1; mp < (1 << np); ++mp) {
    for (int mf = 1; mf < (1 << nf); ++mf) {
      std::vector<Vec3> a, b;
      for (int k = 0; k < np; ++k)
        if ((mp >> k & 1) != 0) a.push_back(p[k]);
      for (int k = 0; k < nf; ++k)
        if ((mf >> k & 1) != 0) b.push_back(f[k]);
      // Minimise |sum w a - sum v b|^2 with sum w = sum v = 1 by its equations of first order.
      const auto na = static_cast<Eigen::Index>(a.size()), n = na + static_cast<Eigen::Index>(b.size());
      Eigen::MatrixXd C(3, n), K = Eigen::MatrixXd::Zero(n + 2, n + 2);
      for (Eigen::Index k = 0; k < n; ++k) C.col(k) = k < na ? a[k] : Vec3(-b[k - na]);
      K.topLeftCorner(n, n) = C.transpose() * C;
      for (Eigen::Index k = 0; k < n; ++k) K(k, k < na ? n : n + 1) = K(k < na ? n : n + 1, k) = 1.0;
      Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n + 2);
      rhs.tail<2>().setOnes();
      const Eigen::VectorXd w = K.fullPivLu().solve(rhs);
      if ((K * w - rhs).norm() < 1e-9 && w.head(n).minCoeff() > -1e-12)
        best = std::min(best, (C * w.head(n)).norm());
    }
  }
  return best;
}

TEST(NearestFeatures, AgreeWithHulls)
{
  std::mt19937_64 rng(3);
  std::array<int, 3> seen{};
  for (int trial = 0; trial < 6000; ++trial) {
    FeaturePair pair;
    const int kind = trial % 3;
    pair.p_count = kind == 0 ? 1 : kind == 1 ? 3 : 2;
    pair.f_count = 4 - pair.p_count;
    std::array<Vec3, 3> p, f;
    const Vec3 apart = 1.5 * random_point(rng);
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = random_point(rng) + apart;
      f[k] = random_point(rng);
    }
    if (trial % 30 == 2) f[1] = f[0] + (0.3 + 0.01 * trial) * (p[1] - p[0]);  // parallel edges
    const NearestFeatures n = nearest_features(pair, p, f);
    const double expected = hull_distance(p, pair.p_count, f, pair.f_count);
    EXPECT_NEAR(n.distance, expected, 1e-11) << trial;
    ++seen[n.free];
    Vec3 on_p = Vec3::Zero(), on_f = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      if (static_cast<int>(k) < n.p.count) on_p += n.p.weights[k] * p[k];
      if (static_cast<int>(k) < n.f.count) on_f += n.f.weights[k] * f[k];
    }
    EXPECT_LT((on_p - n.on_p).norm() + (on_f - n.on_f).norm(), 1e-12);
    EXPECT_LT((n.on_p - n.on_f - n.distance * n.normal).norm(), 1e-9);
    EXPECT_NEAR(n.normal.norm(), 1.0, 1e-14);
  }
  for (const int count : seen) EXPECT_GT(count, 500) << "a kind of nearest points was hardly met";
}

class Rigid {
 public:
  Rigid(int n, std::uint64_t seed)
  {
    std::mt19937_64 rng(seed);
    const auto facets = std::make_shared<const Facets>(1.0, 0.2, 0.25, n);
    for (Body* b : {&first, &second}) {
      b->R = 1.0;
      b->r0 = 0.2;
      b->r1 = 0.25;
      b->facets = facets;
    }
    pose = {1.3 * random_point(rng), random_rotation(rng)};
  }
  PairFrame frame() const { return {first, pose, second, {}}; }

  Body first, second;
  Pose pose;
};

using Key = std::array<int, 6>;

Key key_of(const FeaturePair& pair)
{
  Key key{-1, -1, -1, -1, -1, -1};
  for (std::size_t k = 0; k < static_cast<std::size_t>(pair.p_count); ++k) key[k] = pair.p[k];
  for (std::size_t k = 0; k < static_cast<std::size_t>(pair.f_count); ++k) key[3 + k] = pair.f[k];
  return key;
}

/// Every pair of features within the range is found, once, and its corners are where the bodies are.
TEST(NearFeatures, MissNothing)
{
  const double range = 0.3;
  long found_total = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Rigid bodies(6, seed);
    const PairFrame frame = bodies.frame();
    const Facets &P = *bodies.first.facets, &F = *bodies.second.facets;
    std::multiset<Key> found;
    near_features(frame, range, [&](const FeaturePair& pair, const auto& p, const auto& f) {
      if (nearest_features(pair, p, f).distance < range) found.insert(key_of(pair));
    });
    const auto in_f = [&](int k) -> Vec3 {
      return bodies.pose.position + bodies.pose.rotation * P.points()[k];
    };
    const auto of_f = [&](int k) -> Vec3 { return F.points()[k]; };
    std::multiset<Key> expected;
    const auto check = [&](const FeaturePair& pair) {
      std::array<Vec3, 3> p, f;
      for (std::size_t k = 0; k < static_cast<std::size_t>(pair.p_count); ++k) p[k] = in_f(pair.p[k]);
      for (std::size_t k = 0; k < static_cast<std::size_t>(pair.f_count); ++k) f[k] = of_f(pair.f[k]);
      if (nearest_features(pair, p, f).distance < range) expected.insert(key_of(pair));
    };
    for (const auto& e : P.edges())
      for (const auto& g : F.edges()) check({{e[0], e[1]}, {g[0], g[1]}, 2, 2});
    for (int k = 0; k < static_cast<int>(P.points().size()); ++k) {
      for (const auto& t : F.triangles()) check({{k}, t.points, 1, 3});
      for (const auto& t : P.triangles()) check({t.points, {k}, 3, 1});
    }
    EXPECT_EQ(found, expected) << "seed " << seed;
    found_total += static_cast<long>(found.size());
  }
  EXPECT_GT(found_total, 1000);
}

TEST(FacetsIntersect, ThroughAndApart)
{
  Rigid bodies(12, 1);
  bodies.pose = {Vec3(1.0, 0.0, 0.0), Mat3(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()))};
  EXPECT_FALSE(facets_intersect(bodies.frame())) << "linked, each in the middle of the other's hole";
  bodies.pose.position.x() = 1.9;
  EXPECT_TRUE(facets_intersect(bodies.frame()));
  bodies.pose.position.x() = 2.6;
  EXPECT_FALSE(facets_intersect(bodies.frame()));
}

}  // namespace
}  // namespace hauberk::test
