/// Steps of tubes around curves that are called free of collisions, against many small ones.

#include <known_gaps.hpp>
#include <scenes.hpp>
#include "curve_pairs.hpp"
#include "geometry/separation.hpp"
#include "model/near_pairs.hpp"
#include "motion/advancement.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hauberk::test {
namespace {

constexpr double keep = 0.1;

/// A shape of one fixed primitive.
class Fixed final : public Shape {
 public:
  explicit Fixed(Primitive primitive) : primitive_(std::move(primitive)) {}

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return none_; }
  void do_primitives(std::span<const double>, std::vector<Primitive>& out) const override
  {
    out.assign(1, primitive_);
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    out.assign(1, {});
  }

 private:
  Primitive primitive_;
  std::vector<ParameterInfo> none_;
};

double smallest(const Model& m, const State& s)
{
  double out = std::numeric_limits<double>::infinity();
  for (const ElementPair& pair : near_pairs(m, s, 0.5)) {
    out = std::min(out, separation(m.bodies[pair.i], image_pose(m, s, pair.i, {0, 0}), m.bodies[pair.j],
                                   image_pose(m, s, pair.j, pair.image), 0.0, 1e300, 0.95)
                            .lower);
  }
  return out;
}

/// Two linked oval curves, or such a curve and a ring, round or oval: 0, 1, 2.
SceneSpec linked_with_curve(int other)
{
  std::mt19937_64 rng(2);
  SceneSpec spec = chain({1, 0.12, 0.12}, {1, 0.12, 0.12}, 3.0);
  spec.types[0].shape = std::make_shared<Fixed>(wavy(0.1, 0.12, rng));
  spec.elements[0].parameters.clear();
  if (other != 1) {
    spec.types.push_back(
        {"other", std::make_shared<Fixed>(other == 0 ? wavy(0.1, 0.12, rng) : ellipse(1.0, 0.1, 0.15))});
    spec.elements[1].type = 1;
    spec.elements[1].parameters.clear();
  } else {
    spec.types.push_back({"ring", std::make_shared<Rings>()});
    spec.elements[1].type = static_cast<int>(spec.types.size()) - 1;
  }
  spec.length = 1.0;
  return spec;
}

class CurveMotion : public ::testing::TestWithParam<int> {};

TEST_P(CurveMotion, NothingIsMissedAndLittleGivenAway)
{
  const Sheet load(3);
  std::mt19937_64 rng(3);
  const Model m = make_model(linked_with_curve(GetParam()), load, 0.0);
  const State rest = rest_state(m);
  const double at_rest = smallest(m, rest);
  ASSERT_GT(at_rest, 0.05);
  ASSERT_FALSE(m.links.empty());
  std::normal_distribution<double> normal;
  int cut = 0, whole = 0;
  std::vector<double> tightness;
  for (int trial = 0; trial < 40; ++trial) {
    Vector dy(m.dofs());
    const double size = trial % 2 == 0 ? 0.04 : 0.4;
    for (int k = 0; k < m.dofs(); ++k) dy[k] = (k < 3 ? 0.2 : 1.0) * size * normal(rng);
    const SafeStep safe = largest_safe_step(m, rest, dy, keep);
    ASSERT_GT(safe.alpha, 0.0);
    constexpr int steps = 200;
    double first_near = 2.0;
    for (int k = 1; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      const double gap = smallest(m, advanced(m, rest, dy, s));
      if (s <= safe.alpha) {
        EXPECT_GT(gap, 0.5 * keep * at_rest) << trial << " at " << s << " of " << safe.alpha;
      }
      if (gap <= 2.0 * keep * at_rest) {
        first_near = s;
        break;
      }
    }
    cut += safe.alpha < 1.0;
    whole += safe.alpha == 1.0;
    if (first_near <= 1.0) tightness.push_back(safe.alpha / first_near);
  }
  EXPECT_GT(cut, 5);
  EXPECT_GT(whole, 5);
  std::sort(tightness.begin(), tightness.end());
  ASSERT_GT(tightness.size(), 4U);
  EXPECT_GT(tightness[tightness.size() / 2], 0.5);
}

/// What checks have found of every panel is true wherever the bodies are moved, and spares the next checks
/// work.
TEST_P(CurveMotion, PanelsHoldInOtherPlaces)
{
  const Sheet load(3);
  const Model m = make_model(linked_with_curve(GetParam()), load, 0.0);
  std::mt19937_64 rng(4);
  std::normal_distribution<double> normal;
  GapBounds bounds;
  State state = rest_state(m);
  long with = 0, without = 0, panels = 0;
  for (int k = 0; k < 10; ++k) {
    Vector dy(m.dofs());
    for (int i = 0; i < m.dofs(); ++i) dy[i] = (i < 3 ? 0.2 : 1.0) * 0.02 * normal(rng);
    const SafeStep safe = largest_safe_step(m, state, dy, keep, 1, &bounds);
    ASSERT_GT(safe.alpha, 0.0);
    with += safe.evaluations;
    without += largest_safe_step(m, state, dy, keep).evaluations;
    for (const double along : {0.0, safe.alpha, 2.0}) {
      const KnownGapCheck check = check_known_gaps(m, bounds, advanced(m, state, dy, along), rng);
      EXPECT_EQ(check.wrong, "") << "step " << k << ", " << along;
      panels += check.panels;
    }
    state = advanced(m, state, dy, safe.alpha);
  }
  EXPECT_GT(panels, 200);
  EXPECT_LT(with, without);
}

/// A surface is not inside of a tube around a curve because it is where the tube of a circle would be.
TEST(CurveAndOval, OneIsWhereACircleWouldBe)
{
  const Sheet load(3);
  const Primitive trefoil = knot(2, 3, 0.1);
  const double R = make_body(trefoil, 0, 0, 1.0).R;
  SceneSpec spec = chain({1, 0.12, 0.12}, {1, 0.12, 0.12}, 9.0);
  spec.types[0].shape = std::make_shared<Fixed>(trefoil);
  spec.types.push_back({"oval", std::make_shared<Fixed>(ellipse(0.1, 0.02, 0.03))});
  spec.elements[0].parameters.clear();
  spec.elements[1] = {1, {}, {Vec3(R - 0.12, 0.0, 0.0), Mat3::Identity()}};  // its place (0, 0) at R
  spec.length = 1.0;
  const Model m = make_model(spec, load, 0.0);
  const State rest = rest_state(m);
  ASSERT_GT(smallest(m, rest), 0.05);
  Vector dy = Vector::Zero(m.dofs());
  dy[m.offset(1)] = 0.01;
  EXPECT_EQ(largest_safe_step(m, rest, dy, keep).alpha, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Others, CurveMotion, ::testing::Values(0, 1, 2), [](const auto& info) {
  return std::string(std::array{"curve", "circle", "ellipse"}[static_cast<std::size_t>(info.param)]);
});

}  // namespace
}  // namespace hauberk::test
