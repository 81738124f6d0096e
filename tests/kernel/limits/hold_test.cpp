/// Limits that hold conditions on the macroscopic strain: the axial limit and what it is measured against.

#include "limits/limits.hpp"
#include "model/links.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::test {
namespace {

const KeepGoing always = [] { return true; };

/// A sheet that holds the shear, and on request the lateral strain, of the load's frame.
class HeldSheet final : public Sheet {
 public:
  explicit HeldSheet(bool lateral) : lateral_(lateral) {}

 protected:
  std::vector<std::string> do_hold() const override
  {
    return lateral_ ? std::vector<std::string>{"shear", "lateral"} : std::vector<std::string>{"shear"};
  }
  std::vector<MacroCondition> do_conditions(double theta) const override
  {
    const double c = std::cos(theta), s = std::sin(theta);
    std::vector<MacroCondition> out{{"shear", {-c * s, c * s, c * c - s * s}}};
    if (lateral_) out.push_back({"lateral", {s * s, c * c, -2.0 * c * s}});
    return out;
  }

 private:
  bool lateral_;
};

struct HeldChainmail {
  HeldSheet load;
  SceneSpec scene = chainmail(1, 1);
  Model model = make_model(scene, load, 0.0);
  LimitSettings settings;

  explicit HeldChainmail(bool lateral = false) : load(lateral) { settings.perturbation = 0.01; }

  LimitResult limit(double degrees, Sense sense = Sense::positive) const
  {
    return compute_limits(model, scene, {{Direction::at_degrees(degrees), sense}}, settings, 1)[0];
  }
};

/// The tensor components of a result along n and across it.
struct Components {
  double axial, shear, lateral;
  Components(const LimitResult& r, double degrees)
  {
    const Eigen::Vector2d n(std::cos(degrees * degree), std::sin(degrees * degree)), m(-n.y(), n.x());
    Eigen::Matrix2d eps;
    eps << r.macro[0].second, r.macro[2].second, r.macro[2].second, r.macro[1].second;
    axial = n.dot(eps * n);
    shear = n.dot(eps * m);
    lateral = m.dot(eps * m);
  }
};

TEST(Hold, StatesKeepTheirConditions)
{
  for (const double degrees : {0.0, 25.0, 50.0}) {
    for (const Sense sense : {Sense::positive, Sense::negative}) {
      const LimitResult r = HeldChainmail().limit(degrees, sense);
      ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
      EXPECT_EQ(r.hold, std::vector<std::string>{"shear"});
      ASSERT_EQ(r.reactions.size(), 1U);
      EXPECT_NEAR(Components(r, degrees).shear, 0.0, 1e-15);
      EXPECT_NEAR(Components(r, degrees).axial, *r.value, 1e-15);
      EXPECT_LT(*r.force_balance, 1e-4);

      const LimitResult clamped = HeldChainmail(true).limit(degrees, sense);
      ASSERT_EQ(clamped.status, LimitStatus::locked) << clamped.message;
      ASSERT_EQ(clamped.reactions.size(), 2U);
      EXPECT_NEAR(Components(clamped, degrees).shear, 0.0, 1e-15);
      EXPECT_NEAR(Components(clamped, degrees).lateral, 0.0, 1e-15);
    }
  }
}

/// More that is held goes less far: [] beyond ["shear"] beyond ["shear", "lateral"], and not the same here.
TEST(Hold, LessFreedomGoesLessFar)
{
  const double degrees = 50.0;
  const Sheet sheet{2};
  const SceneSpec scene = chainmail(1, 1);
  const Model model = make_model(scene, sheet, 0.0);
  const double free =
      *compute_limits(model, scene, {{Direction::at_degrees(degrees), Sense::positive}}, {}, 1)[0].value;
  const double axial = *HeldChainmail().limit(degrees).value,
               clamped = *HeldChainmail(true).limit(degrees).value;
  EXPECT_GT(free, axial + 1e-3);
  EXPECT_GT(axial, clamped + 1e-3);
}

/// The reaction is d value / d(shear): found with no conditions at all, by a stiff spring that holds the
/// shear at +-x. A spring K (a . macro - x)^2 / 2 is a tether and the load K x a.
TEST(Hold, ReactionIsTheDerivativeInWhatIsHeld)
{
  const double degrees = 25.0, stiffness = 1e6, x = 1e-3;
  const HeldChainmail held;
  const LimitResult r = held.limit(degrees);
  ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
  const MacroLoad load = macro_load(held.model, Direction::at_degrees(degrees), Sense::positive);
  const Vector a = load.held.col(0);
  const auto value = [&](double offset) {
    State s = rest_state(held.model);
    s = perturbed(held.model, s, held.settings.perturbation, held.settings.seed, Copies::alike);
    Vector pull = load.pull + stiffness * offset * a;
    for (const double g_hat : {3e-2, 3e-3, 3e-4, 3e-5, 3e-6, 3e-7}) {
      Stage stage;
      stage.contact = {g_hat > 1e-4 ? Formulation::arc : Formulation::nearest, g_hat, 0.0};
      stage.mu = 0.03 * g_hat;
      stage.tether = a;
      stage.tether_stiffness = stiffness;
      const StageResult end = solve_stage(held.model, s, pull, stage, always);
      EXPECT_EQ(end.status, StageStatus::minimum) << g_hat << ' ' << end.message;
    }
    return std::pair(load.pull.dot(s.macro), a.dot(s.macro));
  };
  const auto [up, up_shear] = value(x);
  const auto [down, down_shear] = value(-x);
  EXPECT_NEAR(up_shear, x, 1e-5);
  const double slope = (up - down) / (up_shear - down_shear);
  EXPECT_GT(std::abs(slope), 0.05) << "the test needs a reaction";
  EXPECT_NEAR(r.reactions[0].second, slope, 1e-3 * std::abs(slope) + 1e-3);
  EXPECT_NEAR(0.5 * (up + down), *r.value, 1e-4) << "the same branch";
}

/// A state of another direction breaks what is held; it is brought there on a certified path.
TEST(Hold, BeginsFromStatesThatBreakTheConditions)
{
  const HeldChainmail held;
  const LimitTask from{Direction::at_degrees(50.0), Sense::negative},
      to{Direction::at_degrees(20.0), Sense::negative};
  const Locked donor = limit_from_start(held.model, from, held.settings, 0, always);
  ASSERT_EQ(donor.status, LockStatus::locked);
  const MacroLoad load = macro_load(held.model, to.direction, to.sense);
  EXPECT_GT(missed(load.held, donor.state.macro), 1e-3);
  const Locked found = limit_from_state(held.model, to, held.settings, donor.state, always);
  ASSERT_EQ(found.status, LockStatus::locked) << found.message;
  EXPECT_LT(missed(load.held, found.state.macro), 1e-15);
  EXPECT_TRUE(links_kept(held.model, found.state));
}

/// The constrained method, which shares no stage with the barriers, ends at the same state with the same
/// reaction.
TEST(Hold, ConstrainedAgrees)
{
  HeldChainmail held;
  const LimitResult barrier = held.limit(25.0);
  held.settings.contact = ContactChoice::constrained;
  const LimitResult constrained = held.limit(25.0);
  ASSERT_EQ(constrained.status, LimitStatus::locked) << constrained.message;
  EXPECT_NEAR(*constrained.value, *barrier.value, 1e-8);
  EXPECT_NEAR(constrained.reactions[0].second, barrier.reactions[0].second, 1e-4);
}

/// A subspace of a curved load case: positions and both derivatives are those of the full one.
TEST(Hold, HeldModelHasThePosesOfTheFullOne)
{
  const HeldChainmail held;
  const MacroLoad load = macro_load(held.model, Direction::at_degrees(35.0), Sense::positive);
  const HeldModel restricted(held.model, load.held);
  ASSERT_EQ(restricted.model().macro_count, 2);
  State q = rest_state(restricted.model());
  q.macro << 0.03, -0.02;
  q.e.setLinSpaced(0.01, 0.04);
  const State full = restricted.full(q);
  EXPECT_LT(missed(load.held, full.macro), 1e-16);
  const State back = restricted.restricted(full);
  EXPECT_NEAR((back.macro - q.macro).norm(), 0.0, 1e-15);
  for (int i = 0; i < held.model.element_count(); ++i) {
    const Pose a = image_pose(held.model, full, i, {1, 2}), b = image_pose(restricted.model(), q, i, {1, 2});
    EXPECT_NEAR((a.position - b.position).norm(), 0.0, 1e-14);
  }
  // The norm of a step is that of the full model's.
  Vector dq = Vector::Zero(restricted.model().dofs());
  dq.head(2) << 0.3, 0.7;
  Vector dy = Vector::Zero(held.model.dofs());
  dy.head(3) = restricted.full({dq.head(2), q.e, q.rotation}).macro;
  EXPECT_NEAR(step_norm(restricted.model(), dq), step_norm(held.model, dy), 1e-12);
}

}  // namespace
}  // namespace hauberk::test
