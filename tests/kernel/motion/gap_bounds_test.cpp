/// Bounds of gaps that are kept from step to step: never above the gaps, and no energy depends on them.

#include "motion/gap_bounds.hpp"

#include "equilibrium/gaps.hpp"
#include "equilibrium/locking.hpp"
#include "equilibrium/stage.hpp"
#include "geometry/panel_field.hpp"
#include "known_gaps.hpp"
#include "model/near_pairs.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace hauberk::test {
namespace {

using std::numbers::pi;

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

/// What is known of a gap at these poses; 0 where nothing is.
double at_least(const GapBounds& bounds, const Model& m, int a, const Pose& pa, int b, const Image& image,
                const Pose& pb)
{
  const KnownGap* known = bounds.known(a, b, image);
  if (known == nullptr) return 0.0;
  return known->at_least(m.bodies[a], pa, m.bodies[b], pb);
}

double bound(const GapBounds& bounds, const Model& m, const State& s, const BodiesInImage& pair)
{
  const auto& [a, b, image] = pair;
  const int i = m.bodies[a].element, j = m.bodies[b].element;
  return at_least(bounds, m, a, image_pose(m, s, i, {}), b, image, image_pose(m, s, j, image));
}

/// Known of two bodies: one gap over all of the probe set.
KnownGap of_all(const Model& m, int a, const Pose& pa, int b, const Pose& pb, double gap)
{
  const Body &A = m.bodies[a], &B = m.bodies[b];
  KnownGap known;
  known.place = second_probes(A, B) ? RelativePlace(B, pb, A, pa) : RelativePlace(A, pa, B, pb);
  known.panels = {{{pi, pi, pi, pi}, gap}};
  return known;
}

/// Of two bodies alone the bound falls by exactly what a translation takes, and by the farthest that a point
/// goes in a turn; whichever of the two probes.
TEST(GapBounds, FallByWhatMoves)
{
  const Sheet load(3);
  const Model m = make_model(threefold_round(), load, 0.0);
  const Image image{1, 0, 0};
  const Pose pa{Vec3(0.1, 0.2, 0.3), Mat3::Identity()}, pb{Vec3(1.0, 0.4, -0.2), Mat3::Identity()};
  // The centre ring is the largest: the first two are alike, of the others the second one probes.
  for (const auto& [a, b] : {std::pair(1, 2), std::pair(0, 3)}) {
    const Body &A = m.bodies[a], &B = m.bodies[b];
    ASSERT_EQ(second_probes(A, B), a == 0);
    GapBounds bounds;
    EXPECT_LE(at_least(bounds, m, a, pa, b, image, pb), 0.0);
    bounds.remember(a, b, image, of_all(m, a, pa, b, pb, 0.25));
    EXPECT_NEAR(at_least(bounds, m, a, pa, b, image, pb), 0.25, 1e-11);
    EXPECT_LT(at_least(bounds, m, a, pa, b, image, pb), 0.25);
    EXPECT_LE(at_least(bounds, m, a, pa, b, {0, 0, 0}, pb), 0.0) << "another image";
    EXPECT_LE(at_least(bounds, m, b, pa, a, image, pb), 0.0) << "other bodies";

    Pose moved = pa;
    moved.position += Vec3(0.03, 0.0, -0.04);
    EXPECT_NEAR(at_least(bounds, m, a, moved, b, image, pb), 0.20, 1e-11);
    EXPECT_LT(at_least(bounds, m, a, Pose{moved.position * 100.0, moved.rotation}, b, image, pb), 0.0);

    // A turn of the probing body about its own centre moves no point of it by more than a chord of the ball
    // around it.
    const double angle = 0.1;
    const auto turned = [&](Pose pose, const Body& body) {
      pose.rotation = Eigen::AngleAxisd(angle, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
      pose.position -= pose.rotation * body.center - body.center;
      return pose;
    };
    const double left = a == 0 ? at_least(bounds, m, a, pa, b, image, turned(pb, B))
                               : at_least(bounds, m, a, turned(pa, A), b, image, pb);
    EXPECT_NEAR(left, 0.25 - 2.0 * std::sin(0.5 * angle) * (a == 0 ? B : A).bound, 1e-11);

    // Both moved together: nothing has changed.
    const Mat3 around = Eigen::AngleAxisd(0.7, Vec3::UnitY()).toRotationMatrix();
    EXPECT_NEAR(
        at_least(bounds, m, a, {around * pa.position, around}, b, image, {around * pb.position, around}),
        0.25, 1e-11);

    // What is remembered takes the place of what was.
    bounds.remember(a, b, image, of_all(m, a, moved, b, pb, 0.19));
    EXPECT_NEAR(at_least(bounds, m, a, moved, b, image, pb), 0.19, 1e-11);
  }
}

/// Panels are all of the probe set, by rising bound, and the gap is nowhere below their bounds: at places on
/// each of them, in states that steps lead to, whole or not, and in others.
TEST(GapBounds, HoldPanelByPanel)
{
  const Sheet load(3);
  for (const SceneSpec& scene : {threefold_round(), chainmail(2, 1, 36.5, 1.3)}) {
    const Model m = make_model(scene, load, 0.01);
    GapBounds bounds;
    Walk walk(m);
    std::mt19937_64 rng(5);
    KnownGapCheck all;
    int shortened = 0;
    for (int k = 0; k < 12; ++k) {
      const Vector dy = walk.step(k % 2 == 0 ? 0.2 : 0.005);
      const SafeStep safe = largest_safe_step(m, walk.state(), dy, 0.1, 1, &bounds);
      shortened += safe.alpha < 1.0 ? 1 : 0;
      for (const double along : {0.0, safe.alpha, 2.0}) {
        const KnownGapCheck check = check_known_gaps(m, bounds, advanced(m, walk.state(), dy, along), rng);
        EXPECT_EQ(check.wrong, "") << "step " << k << ", " << along;
        all.panels += check.panels;
        all.positive += check.positive;
      }
      walk.move(dy, safe.alpha);
    }
    EXPECT_GT(shortened, 1) << "some checks end early";
    EXPECT_LT(shortened, 11);
    EXPECT_GT(all.panels, 1000);
    EXPECT_GT(2 * all.positive, all.panels) << "most bounds say something";
  }
}

/// Panels on either side of the angle 0 meet, those that only touch do, and without panels all may be near.
TEST(NearPanels, MeetAroundTheCircle)
{
  const NearPanels near({{0.1, 6.2, 0.15, 0.2}, {3.0, 3.0, 0.1, 0.1}});
  EXPECT_TRUE(near.meet({6.2, 0.05, 0.1, 0.1}));
  EXPECT_TRUE(near.meet({6.2 + 0.1, 6.3, 0.01, 0.01}));
  EXPECT_FALSE(near.meet({6.0, 0.05, 0.1, 0.1})) << "too far in u";
  EXPECT_FALSE(near.meet({6.2, 0.45, 0.1, 0.1})) << "too far in v";
  EXPECT_FALSE(near.meet({3.0, 6.2, 0.1, 0.1})) << "u of one, v of the other";
  EXPECT_TRUE(near.meet({3.25, 2.75, 0.15, 0.15})) << "touching";
  EXPECT_TRUE(NearPanels().meet({1.0, 1.0, 0.1, 0.1}));
  EXPECT_TRUE(near.widened(0.2, 0.0).meet({6.0, 0.05, 0.1, 0.1}));
  EXPECT_TRUE(near.widened(0.0, 0.3).meet({6.2, 0.45, 0.1, 0.1}));
}

/// `constrained` takes the points of an energy for the rows of gaps, also where two gaps are equal: both list
/// minima in one order, which they only do if the same body probes.
TEST(GapBounds, AreProbedAsEnergiesAre)
{
  const Sheet load(3);
  int equal = 0;
  for (const auto& [first, second] : {std::pair(4.9, 4.0), std::pair(4.0, 4.9)}) {
    for (const double period : {12.12, 12.14, 12.16, 12.18, 12.2}) {
      // Tubes that are flatter than the rings are wide touch at four places at once.
      const Model m = make_model(chain({first, 1.15, 2.2}, {second, 1.15, 2.2}, period), load, 0.0);
      const State s = rest_state(m);
      const ContactSettings nearest{Formulation::nearest, 0.2, 0.0};
      Request request;
      request.order = 1;
      request.points = true;
      const ContactEnergy e = contact_energy(m, s, near_pairs(m, s, nearest.g_hat), nearest, request);
      const std::vector<Gap> gaps = find_gaps(m, s, nearest.g_hat, true);
      ASSERT_EQ(gaps.size(), e.points.size());
      for (std::size_t k = 0; k < gaps.size(); ++k) {
        const ContactEnergy::Point& p = e.points[k];
        ASSERT_EQ(std::tie(gaps[k].a, gaps[k].b, gaps[k].image), std::tie(p.a, p.b, p.image));
        if (p.a == p.b) continue;  // an element and its own image move together
        EXPECT_LT((gaps[k].dy.segment<3>(m.offset(p.a)) + p.contact.normal).norm(), 1e-9) << k;
        if (k > 0 && gaps[k].a == gaps[k - 1].a && gaps[k].image == gaps[k - 1].image)
          equal += std::abs(gaps[k].gap - gaps[k - 1].gap) < 1e-13 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(equal, 10);
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

/// Energies with and without are the same, of tubes to the last bit; steps, which end where a check is
/// content, are as safe and not much shorter; all for less.
TEST(GapBounds, ChangeTheWorkAndNothingElse)
{
  const Sheet load(3);
  struct Case {
    SceneSpec scene;
    double rounding;
  };
  for (const auto& [scene, rounding] :
       {Case{chainmail(2, 1), 0.0}, Case{threefold_round(), 0.0}, Case{chainmail(1, 1, 36.5, 1.3), 1e-12}}) {
    const Model m = make_model(scene, load, 0.0);
    for (const Formulation formulation : {Formulation::nearest, Formulation::arc}) {
      Stage stage;
      stage.contact = {formulation, 0.15, m.clearance};
      const Vector pull = load_vector(m, Direction(), Sense::positive);
      GapBounds bounds;
      Walk walk(m);
      long with = 0, without = 0;
      double energy = 0.0, way = 0.0;
      for (int k = 0; k < 12; ++k) {
        const Vector dy = walk.step(0.02);
        const SafeStep some = checked_step(m, walk.state(), dy, 0.1, stage, &bounds),
                       all = checked_step(m, walk.state(), dy, 0.1, stage);
        EXPECT_GE(some.alpha, 0.5 * all.alpha);
        way += some.alpha;
        const auto before = all_gaps(m, walk.state(), 0.5);
        for (const double part : {0.25, 0.5, 0.75, 1.0}) {
          const State there = advanced(m, walk.state(), dy, part * some.alpha);
          EXPECT_GT(smallest_gap(m, there, 0.5), 0.0);
          const auto after = all_gaps(m, there, 0.5);
          for (const auto& [bodies, gap] : before) {
            const auto then = after.find(bodies);
            if (then == after.end()) continue;  // farther now
            EXPECT_GE(then->second, 0.1 * gap * (1.0 - 1e-9));
          }
        }
        walk.move(dy, some.alpha);
        const auto pairs = stage_pairs(m, walk.state(), stage);
        const TotalEnergy known = total_energy(m, walk.state(), pull, stage, pairs, 2, &bounds),
                          looked = total_energy(m, walk.state(), pull, stage, pairs, 2);
        ASSERT_TRUE(looked.admissible);
        EXPECT_LE(std::abs(known.energy - looked.energy), rounding * std::abs(looked.energy));
        EXPECT_LE((known.gradient - looked.gradient).norm(), rounding * looked.gradient.norm());
        EXPECT_LE((known.hessian - looked.hessian).norm(), rounding * looked.hessian.norm());
        energy += looked.contact.energy;
        with += some.evaluations + known.contact.evaluations;
        without += all.evaluations + looked.contact.evaluations;
      }
      EXPECT_GT(way, 2.0);
      EXPECT_GT(energy, 0.0) << "contacts were in range";
      EXPECT_LT(with, without);
    }
  }
}

}  // namespace
}  // namespace hauberk::test
