/// Contact energy of meshes: derivatives by differences, also of nearly parallel edges, and invariances.

#include <scenes.hpp>
#include "contact/body_pair.hpp"
#include "contact/mesh.hpp"
#include "geometry/facets.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>

namespace hauberk::test {
namespace {

struct Pair {
  Body a, b;
  Pose pa, pb;
};

/// Two linked rings, the second turned by `tilt` about x and moved towards the first one's tube.
Pair linked(int n, double tilt, double shift)
{
  Pair out;
  const auto set = [n](Body& body, double R) {
    body.R = R;
    body.r0 = 0.14;
    body.r1 = 0.18;
    body.center = Vec3(0.1, -0.05, 0.02);
    body.bound = R + 0.18;
    body.facets = std::make_shared<const Facets>(R, 0.14, 0.18, n);
  };
  set(out.a, 1.0);
  set(out.b, 0.9);
  out.pb.position = Vec3(shift, 0.03, -0.02);
  out.pb.rotation = Eigen::AngleAxisd(tilt, Vec3(1.0, 0.1, 0.2).normalized()).toRotationMatrix();
  return out;
}

PairContact contact(const Pair& pair, double g_hat, int order)
{
  ContactSettings settings;
  settings.formulation = Formulation::mesh;
  settings.g_hat = g_hat;
  settings.clearance = 0.01;
  return pair_contact(pair.a, pair.pa, pair.b, pair.pb, settings, order);
}

/// Moved by d = (shift of a, turn of a, turn of b).
Pair moved(Pair pair, const Vec9& d)
{
  pair.pa.position += d.head<3>();
  pair.pa.rotation = rotation_exp(d.segment<3>(3)) * pair.pa.rotation;
  pair.pb.rotation = rotation_exp(d.tail<3>()) * pair.pb.rotation;
  return pair;
}

/// Central differences of the energy along random directions. The energy's second derivative jumps where
/// nearest features change, so steps are short, and most directions, not all, must agree.
void expect_derivatives(const Pair& pair, double g_hat, std::uint64_t seed)
{
  const PairContact at = contact(pair, g_hat, 2);
  ASSERT_GT(at.min_gap, 0.0);
  ASSERT_GT(at.terms.energy, 0.0);
  EXPECT_LT((at.terms.hessian - at.terms.hessian.transpose()).norm(), 1e-10 * at.terms.hessian.norm());
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal;
  int smooth = 0;
  constexpr int directions = 20;
  for (int k = 0; k < directions; ++k) {
    Vec9 d;
    for (int i = 0; i < 9; ++i) d[i] = normal(rng);
    const double h = 2e-6;
    const auto value = [&](double s) { return contact(moved(pair, s * d), g_hat, 1); };
    const PairContact p = value(h), q = value(-h);
    EXPECT_NEAR((p.terms.energy - q.terms.energy) / (2.0 * h), at.terms.gradient.dot(d),
                1e-6 * at.terms.gradient.norm() * d.norm());
    // The gradient is in the frame of each state; along exp(s w) its component along d is the energy's
    // derivative.
    const double bend = (p.terms.gradient - q.terms.gradient).dot(d) / (2.0 * h);
    smooth += std::abs(bend - d.dot(at.terms.hessian * d)) < 2e-5 * at.terms.hessian.norm() * d.squaredNorm();
  }
  EXPECT_GE(smooth, directions - 3);
}

TEST(MeshEnergy, Derivatives)
{
  for (const int n : {6, 11}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(n);
      SCOPED_TRACE(seed);
      expect_derivatives(linked(n, 1.2 + 0.1 * static_cast<double>(seed), 1.05), 0.5, seed);
    }
  }
}

/// Coaxial rings, one above the other: opposite edges are parallel up to a small tilt.
TEST(MeshEnergy, DerivativesOfNearlyParallelEdges)
{
  for (const double tilt : {1e-3, 1e-2}) {
    SCOPED_TRACE(tilt);
    Pair pair = linked(8, tilt, 0.0);
    pair.b.R = pair.a.R;
    pair.b.facets = pair.a.facets;
    pair.pb.position = Vec3(0.002, 0.001, 0.5);
    expect_derivatives(pair, 0.4, 7);
  }
}

/// Exactly parallel edges weigh nothing, so the energy is that of points and triangles alone and stays
/// finite.
TEST(MeshEnergy, ParallelEdgesVanish)
{
  Pair pair = linked(8, 0.0, 0.0);
  pair.b.R = pair.a.R;
  pair.b.facets = pair.a.facets;
  pair.b.center = pair.a.center;
  pair.pb = {Vec3(0.0, 0.0, 0.45), Mat3::Identity()};
  const PairContact at = contact(pair, 0.3, 2);
  EXPECT_TRUE(std::isfinite(at.terms.hessian.norm()));
  EXPECT_GT(at.terms.energy, 0.0);
}

/// The pair as a whole may be moved and turned; the names of the bodies do not matter.
TEST(MeshEnergy, Invariances)
{
  const Pair pair = linked(9, 1.4, 1.05);
  const PairContact at = contact(pair, 0.5, 1);
  std::mt19937_64 rng(4);
  const Mat3 Q = random_rotation(rng);
  Pair turned = pair;
  for (Pose* pose : {&turned.pa, &turned.pb})
    *pose = {Q * pose->position + Vec3(3, -2, 1), Q * pose->rotation};
  EXPECT_NEAR(contact(turned, 0.5, 0).terms.energy, at.terms.energy, 1e-10 * at.terms.energy);
  Pair swapped{pair.b, pair.a, pair.pb, pair.pa};
  EXPECT_NEAR(contact(swapped, 0.5, 0).terms.energy, at.terms.energy, 1e-10 * at.terms.energy);
  // Turning both by w about the origin of b: eta = w x (x_a - x_b).
  const Vec3 w(0.3, -0.7, 0.5);
  Vec9 d;
  d << w.cross(pair.pa.position - pair.pb.position), w, w;
  EXPECT_NEAR(at.terms.gradient.dot(d), 0.0, 1e-9 * at.terms.gradient.norm());
}

/// The smallest of the listed gaps is the distance of the meshes, and changes as its derivatives say.
TEST(MeshEnergy, SmallestFeatureGap)
{
  const Pair pair = linked(9, 1.4, 1.05);
  const PairFrame frame(pair.a, pair.pa, pair.b, pair.pb);
  const double distance = smallest_feature_distance(frame, 1.0);
  const std::vector<FeatureGap> gaps = feature_gaps(frame, 1.5 * distance, 0.01);
  ASSERT_GT(gaps.size(), 1U);
  const FeatureGap& least = *std::min_element(
      gaps.begin(), gaps.end(), [](const FeatureGap& a, const FeatureGap& b) { return a.gap < b.gap; });
  EXPECT_NEAR(least.gap + 0.01, distance, 1e-15);
  EXPECT_TRUE(std::isinf(smallest_feature_distance(frame, 0.99 * distance)));
  // Whatever is looked at first.
  double range = 1.01 * distance;
  for (int k = 0; k < 24; ++k, range *= 1.3) EXPECT_EQ(smallest_feature_distance(frame, range), distance);
  const PairTerms terms = to_world(least.terms, frame.M, pair.pa.position - pair.pb.position, 1);
  std::mt19937_64 rng(9);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 10; ++trial) {
    Vec9 d;
    for (int i = 0; i < 9; ++i) d[i] = normal(rng);
    const double h = 1e-6;
    const auto at = [&](double s) {
      const Pair there = moved(pair, s * d);
      return smallest_feature_distance(PairFrame(there.a, there.pa, there.b, there.pb), 1.0);
    };
    EXPECT_NEAR((at(h) - at(-h)) / (2.0 * h), terms.gradient.dot(d), 1e-8);
  }
}

}  // namespace
}  // namespace hauberk::test
