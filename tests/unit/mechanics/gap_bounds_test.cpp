/// Bounds of gaps that are kept from step to step: never above the gap, and no result depends on them.

#include <hauberk/mechanics/equilibrium.hpp>
#include <hauberk/mechanics/gaps.hpp>
#include <hauberk/mechanics/locking.hpp>
#include <hauberk/motion/gap_bounds.hpp>

#include "scenes.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace hauberk::test {
namespace {

/// Gradually moving states of a scene.
class Walk {
 public:
  explicit Walk(const Model& m) : m_(m), state_(rest_state(m)) {}

  const State& state() const { return state_; }

  /// A random step, of elements by up to `size` and of the strain by a tenth of it.
  Vector step(double size)
  {
    Vector dy(m_.dofs());
    for (Eigen::Index k = 0; k < dy.size(); ++k) dy[k] = size * uniform_(rng_);
    dy.head(m_.macro_count) *= 0.1;
    return dy;
  }
  void move(const Vector& dy, double alpha) { state_ = advanced(m_, state_, dy, alpha); }

 private:
  const Model& m_;
  State state_;
  std::mt19937_64 rng_{11};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

using BodiesInImage = std::tuple<int, int, Image>;

/// Least gap of any two bodies that are in range.
std::map<BodiesInImage, double> all_gaps(const Model& m, const State& s, double range)
{
  std::map<BodiesInImage, double> least;
  for (const Gap& g : find_gaps(m, s, range, false)) {
    const auto [at, added] = least.try_emplace({g.a, g.b, g.image}, g.gap);
    if (!added) at->second = std::min(at->second, g.gap);
  }
  return least;
}

double bound(const GapBounds& bounds, const Model& m, const State& s, const BodiesInImage& pair)
{
  const auto& [a, b, image] = pair;
  const int i = m.bodies[static_cast<std::size_t>(a)].element,
            j = m.bodies[static_cast<std::size_t>(b)].element;
  return bounds.at_least(m, a, image_pose(m, s, i, {}), b, image, image_pose(m, s, j, image));
}

/// Of two bodies alone the bound falls by exactly what a translation takes, and by the farthest that a point
/// goes in a turn.
TEST(GapBounds, FallByWhatMoves)
{
  const Sheet load(3);
  const Model m = make_model(threefold_round(), load, 0.0);
  constexpr int a = 1, b = 2;
  const Image image{1, 0, 0};
  const Pose pa{Vec3(0.1, 0.2, 0.3), Mat3::Identity()}, pb{Vec3(1.0, 0.4, -0.2), Mat3::Identity()};
  GapBounds bounds;
  EXPECT_LE(bounds.at_least(m, a, pa, b, image, pb), 0.0);
  bounds.remember(m, a, pa, b, image, pb, 0.25);
  EXPECT_NEAR(bounds.at_least(m, a, pa, b, image, pb), 0.25, 1e-11);
  EXPECT_LT(bounds.at_least(m, a, pa, b, image, pb), 0.25);
  EXPECT_LE(bounds.at_least(m, a, pa, b, {0, 0, 0}, pb), 0.0) << "another image";
  EXPECT_LE(bounds.at_least(m, b, pa, a, image, pb), 0.0) << "other bodies";

  Pose moved = pa;
  moved.position += Vec3(0.03, 0.0, -0.04);
  EXPECT_NEAR(bounds.at_least(m, a, moved, b, image, pb), 0.20, 1e-11);
  EXPECT_LT(bounds.at_least(m, a, Pose{moved.position * 100.0, moved.rotation}, b, image, pb), 0.0);

  // A turn about the body's own centre moves no point of it by more than a chord of the ball around it.
  const Body& A = m.bodies[a];
  const double angle = 0.1;
  Pose turned = pa;
  turned.rotation = Eigen::AngleAxisd(angle, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  turned.position -= turned.rotation * A.center - A.center;
  EXPECT_NEAR(bounds.at_least(m, a, turned, b, image, pb), 0.25 - 2.0 * std::sin(0.5 * angle) * A.bound,
              1e-11);

  // Both moved together: nothing has changed.
  const Mat3 around = Eigen::AngleAxisd(0.7, Vec3::UnitY()).toRotationMatrix();
  EXPECT_NEAR(bounds.at_least(m, a, {around * pa.position, around}, b, image, {around * pb.position, around}),
              0.25, 1e-11);

  // A worse bound changes nothing, a better one does.
  bounds.remember(m, a, moved, b, image, pb, 0.19);
  EXPECT_NEAR(bounds.at_least(m, a, pa, b, image, pb), 0.25, 1e-11);
  bounds.remember(m, a, moved, b, image, pb, 0.35);
  EXPECT_NEAR(bounds.at_least(m, a, pa, b, image, pb), 0.30, 1e-11);
}

/// What collision checks have certified in one state holds in all others, and says something.
TEST(GapBounds, AreBelowTheGapsWhereverBodiesAreMoved)
{
  const Sheet load(3);
  const Model m = make_model(threefold_round(), load, 0.01);
  GapBounds bounds;
  Walk walk(m);
  int known = 0, close = 0;
  for (int k = 0; k < 30; ++k) {
    const Vector dy = walk.step(0.02);
    const SafeStep safe = largest_safe_step(m, walk.state(), dy, 0.1, 1, &bounds);
    for (const double along : {0.0, safe.alpha, 3.0}) {
      const State s = advanced(m, walk.state(), dy, along);
      for (const auto& [pair, gap] : all_gaps(m, s, 1.0)) {
        const double least = bound(bounds, m, s, pair);
        EXPECT_LE(least, std::max(gap, 0.0)) << "step " << k << ", " << along;
        if (least <= 0.0) continue;
        ++known;
        close += least > 0.3 * gap ? 1 : 0;
      }
    }
    walk.move(dy, safe.alpha);
  }
  EXPECT_GT(known, 500);
  EXPECT_GT(3 * close, known) << "many bounds are of the order of the gaps";
}

/// Energies with and without are the same to the last bit, steps at least as long and as safe, for less.
TEST(GapBounds, ChangeTheWorkAndNothingElse)
{
  const Sheet load(3);
  for (const SceneSpec& scene : {chainmail(2, 1), threefold_round()}) {
    const Model m = make_model(scene, load, 0.0);
    for (const Formulation formulation : {Formulation::nearest, Formulation::arc}) {
      Stage stage;
      stage.contact = {formulation, 0.15, m.clearance};
      const Vector pull = load_vector(m, Direction(), Sense::positive);
      GapBounds bounds;
      Walk walk(m);
      long with = 0, without = 0;
      double energy = 0.0;
      for (int k = 0; k < 12; ++k) {
        const Vector dy = walk.step(0.02);
        const SafeStep some = checked_step(m, walk.state(), dy, 0.1, stage, &bounds),
                       all = checked_step(m, walk.state(), dy, 0.1, stage);
        EXPECT_EQ(some.alpha, all.alpha);
        walk.move(dy, some.alpha);
        const auto pairs = stage_pairs(m, walk.state(), stage);
        const TotalEnergy known = total_energy(m, walk.state(), pull, stage, pairs, 2, &bounds),
                          looked = total_energy(m, walk.state(), pull, stage, pairs, 2);
        ASSERT_TRUE(looked.admissible);
        EXPECT_EQ(known.energy, looked.energy);
        EXPECT_EQ(known.gradient, looked.gradient);
        EXPECT_EQ(known.hessian, looked.hessian);
        energy += looked.contact.energy;
        with += some.evaluations + known.contact.evaluations;
        without += all.evaluations + looked.contact.evaluations;
      }
      EXPECT_GT(energy, 0.0) << "contacts were in range";
      EXPECT_LT(with, without);
    }
  }
}

}  // namespace
}  // namespace hauberk::test
