/// Two linked rings turning through a merge: eigenvalues against closed forms, forces against differences of
/// energies, jumps of every formulation, and complete tables.

#include "scenes.hpp"
#include "tasks/transition/evaluation.hpp"
#include "tasks/transition/transition_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

constexpr double R = 5.0, r = 0.7, gap = 0.02, activation = 0.1;  // mm
constexpr double core_distance = 2.0 * r + gap;

/// Cross angle at which the nearest point splits: cos = 1 - D/R.
const double split_degrees = std::acos(1.0 - core_distance / R) / degree;

/// Two rings that touch nearly, on the x axis, at a cross angle; r1 = r unless given.
SceneSpec rings(double cross_degrees, double r1 = r, double apart = gap)
{
  SceneSpec scene = test::chain({R, r, r1}, {R, r, r1}, 100.0);
  scene.elements[0].rest = {};
  scene.elements[1].rest = {{2.0 * R - 2.0 * r - apart, 0, 0}, rotation_exp({cross_degrees * degree, 0, 0})};
  return scene;
}

struct Scene {
  test::Sheet sheet;
  SceneSpec spec;
  Model model;

  explicit Scene(const SceneSpec& s) : spec(s), model(make_model(s, sheet, 0.0)) {}
};

/// A turn about the x axis through the merge, and the tilt of figure 2.
RigidMotion twist(double from, double to)
{
  RigidMotion m;
  m.axis = {1, 0, 0};
  m.angle_from = from * degree;
  m.angle_to = to * degree;
  return m;
}

RigidMotion tilt(const Model& model, double cross_degrees, double degrees)
{
  const double half = 0.5 * cross_degrees * degree;
  RigidMotion m;
  m.axis = {0, -std::sin(half), std::cos(half)};
  m.through = Vec3(R - 0.5 * core_distance, 0, 0) / model.length;
  m.angle_from = -degrees * degree;
  m.angle_to = degrees * degree;
  return m;
}

TransitionSpec spec_of(const Model& model, std::vector<TransitionMotion> paths)
{
  TransitionSpec spec;
  spec.model = &model;
  spec.g_hat = activation / model.length;
  spec.range = 3.0 * spec.g_hat;
  spec.contacts = {"nearest", "published", "arc", "auto"};
  spec.paths = std::move(paths);
  spec.length_unit = "mm";
  return spec;
}

TransitionResult run(const TransitionSpec& spec, unsigned threads = 1)
{
  return run_transition(
      spec, threads, [](std::size_t, std::size_t) {}, [] { return true; });
}

double bound(const TransitionJump& jump) { return std::max(jump.relative, jump.resolution); }

TEST(Rings, RelativeCurvatureOfPerpendicularRings)
{
  const Scene s(rings(90.0));
  const auto minima = minima_at({&s.model, 0, 1, twist(0, 1)}, 0.1, 0.0);
  ASSERT_EQ(minima.size(), 1U);
  EXPECT_NEAR(minima[0].distance, gap, 1e-13);
  // Along a ring's tube: the ring curves away with 1/(R - r), the other's tube towards it with 1/(r + g).
  EXPECT_NEAR(minima[0].relative_curvature, (1.0 / (r + gap) - 1.0 / (R - r)) * s.model.length, 1e-10);
}

TEST(Rings, BothEigenvaluesVanishWhereTheNearestPointSplits)
{
  const Scene s(rings(split_degrees));
  const MovingPair pair{&s.model, 0, 1, twist(0.0, 1.0)};
  const auto far = minima_at(pair, 0.1, 1.0), near = minima_at(pair, 0.1, 1e-6);
  ASSERT_EQ(far.size(), 1U);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_NEAR(near[0].relative_curvature / far[0].relative_curvature, 1e-6, 1e-7);
  EXPECT_NEAR(*near[0].eigenvalue / *far[0].eigenvalue, 1e-6, 1e-7);
  EXPECT_EQ(minima_at({&s.model, 0, 1, twist(0.0, -1.0)}, 0.1, 1.0).size(), 2U);
}

/// Every component of the force on the moving element is what the energy loses along it: differences over h
/// and h/2, whose errors fall by four.
TEST(Rings, ForceIsMinusTheSlopeOfTheEnergy)
{
  const Scene s(rings(43.27));
  const double length = s.model.length;
  const auto energy_at = [&](const RigidMotion& m, const ContactSettings& settings, double at) {
    return evaluate({&s.model, 0, 1, m}, settings, at, 0).energy;
  };
  for (const Formulation f : {Formulation::nearest, Formulation::published, Formulation::arc}) {
    const ContactSettings settings{f, activation / length, 0.0};
    RigidMotion still = tilt(s.model, 43.27, 0.68);
    const double at = 0.17;  // away from merges
    const PathPoint p = evaluate({&s.model, 0, 1, still}, settings, at, 2);
    EXPECT_GT(p.gradient.norm(), 0.1);
    for (int component = 0; component < 7; ++component) {
      // The motion itself, and six that begin where it is.
      RigidMotion m = still;
      double exact = p.slope, size = 2e-2;
      if (component < 6) {
        const Pose here = moved(still, s.model.rest[1], at);
        Scene there(s.spec);
        there.spec.elements[1].rest = {here.position * length, here.rotation};
        m = RigidMotion{};
        m.through = here.position;
        (component < 3 ? m.shift_to : m.axis)[component % 3] = 1.0;
        if (component >= 3) m.angle_to = 1.0;
        exact = p.gradient[component];
        size = 1e-4;
        const Scene model(there.spec);
        std::array<double, 2> error{};
        for (std::size_t k = 0; k < 2; ++k) {
          const double h = size / static_cast<double>(1 << k);
          RigidMotion both = m;
          both.angle_from = -both.angle_to;
          both.shift_from = -both.shift_to;
          const auto value = [&](double x) {
            return evaluate({&model.model, 0, 1, both}, settings, 0.5 + 0.5 * x, 0).energy;
          };
          error[k] = std::abs((value(h) - value(-h)) / (2.0 * h) - exact);
        }
        EXPECT_TRUE(error[1] < 0.3 * error[0] || error[1] < 1e-5 * p.gradient.norm())
            << name_of(f) << " " << component << ": " << error[0] << " " << error[1] << " of " << exact;
        continue;
      }
      std::array<double, 3> error{};
      for (std::size_t k = 0; k < error.size(); ++k) {
        const double h = size / static_cast<double>(1 << k);
        error[k] =
            std::abs((energy_at(m, settings, at + h) - energy_at(m, settings, at - h)) / (2.0 * h) - exact);
      }
      EXPECT_NEAR(error[0] / error[1], 4.0, 0.4) << name_of(f) << ": " << error[0] << " " << error[1];
      EXPECT_NEAR(error[1] / error[2], 4.0, 0.4) << name_of(f) << ": " << error[1] << " " << error[2];
    }
    // The gradient's slope likewise.
    const double h = 1e-4;
    const PathPoint a = evaluate({&s.model, 0, 1, still}, settings, at - h, 1),
                    b = evaluate({&s.model, 0, 1, still}, settings, at + h, 1);
    EXPECT_LT(((b.gradient - a.gradient) / (2.0 * h) - p.gradient_slope).norm(),
              1e-5 * p.gradient_slope.norm())
        << name_of(f);
  }
}

/// A nearest point that vanishes against a saddle is followed until its eigenvalue is nearly zero: dropped
/// earlier, it would take more than a vanishing part of the published energy with it.
TEST(Rings, ANearestPointIsKeptUntilItVanishes)
{
  const Scene s(rings(43.27));
  const MovingPair pair{&s.model, 0, 1, tilt(s.model, 43.27, 0.68)};
  double two = 0.5, one = 1.0;  // the first one vanishes on the way
  ASSERT_EQ(minima_at(pair, 0.1, two).size(), 2U);
  ASSERT_EQ(minima_at(pair, 0.1, one).size(), 1U);
  const double regular = minima_at(pair, 0.1, one)[0].relative_curvature;
  while (one - two > 1e-12) {
    const double middle = 0.5 * (one + two);
    (minima_at(pair, 0.1, middle).size() == 2 ? two : one) = middle;
  }
  double least = regular;
  for (const TransitionMinimum& m : minima_at(pair, 0.1, two)) least = std::min(least, m.relative_curvature);
  EXPECT_LT(least, 2e-5 * regular);
}

class Merges : public ::testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    scene_ = new Scene(rings(43.27));
    result_ =
        new TransitionResult(run(spec_of(scene_->model, {{"folds", tilt(scene_->model, 43.27, 0.68), 50},
                                                         {"pitchfork", twist(4.0, -1.5), 50}})));
  }
  static void TearDownTestSuite()
  {
    delete result_;
    delete scene_;
  }
  static Scene* scene_;
  static TransitionResult* result_;
};
Scene* Merges::scene_ = nullptr;
TransitionResult* Merges::result_ = nullptr;

TEST_F(Merges, OneContactBecomesTwo)
{
  ASSERT_EQ(result_->paths.size(), 2U);
  const auto& folds = result_->paths[0].samples;
  EXPECT_EQ(folds.front().minima.size(), 1U);
  EXPECT_EQ(folds[25].minima.size(), 2U);
  EXPECT_EQ(folds.back().minima.size(), 1U);
  EXPECT_EQ(folds.front().minima[0].contact, 0);
  EXPECT_EQ(folds.back().minima[0].contact, 1) << "another one than at the start";
  const auto& pitchfork = result_->paths[1].samples;
  EXPECT_EQ(pitchfork.front().minima.size(), 1U);
  EXPECT_EQ(pitchfork.back().minima.size(), 2U);
  EXPECT_NEAR(pitchfork.back().minima[0].distance, pitchfork.back().minima[1].distance, 1e-12);
}

TEST_F(Merges, OnlyUnsmoothedNearestPointsJump)
{
  for (const TransitionPath& path : result_->paths) {
    for (const TransitionCurve& c : path.curves) {
      if (c.contact == "nearest") {
        EXPECT_GT(c.energy.relative, 0.05) << path.name;
        EXPECT_GT(c.force.relative, 0.05) << path.name;
        EXPECT_LT(c.energy.resolution, 1e-6) << path.name;
      } else {
        EXPECT_LT(bound(c.energy), c.contact == "published" ? 1e-6 : 1e-7) << path.name << " " << c.contact;
      }
      if (c.contact == "arc" || c.contact == "auto") {
        EXPECT_LT(bound(c.force), 1e-6) << path.name << " " << c.contact;
        ASSERT_TRUE(c.quadrature);
        EXPECT_LT(c.quadrature->first, 1e-7);
        EXPECT_LT(c.quadrature->second, 1e-6);
      }
    }
  }
}

TEST_F(Merges, TheJumpIsWhereTheNearestPointSplits)
{
  const double at = result_->paths[1].curves[0].energy.at;
  EXPECT_NEAR(43.27 + 4.0 - 5.5 * at, split_degrees, 1e-3);
}

TEST_F(Merges, TablesAreComplete)
{
  const std::string csv = transition_csv(*result_);
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  std::size_t rows = 0;
  for (std::size_t at = 0; at < csv.size(); ++rows) {
    const std::size_t end = csv.find('\n', at);
    const std::string line = csv.substr(at, end - at);
    EXPECT_EQ(commas(line), 9 + 4 * 8 - 1);
    EXPECT_EQ(line.find(",,"), std::string::npos) << line;
    at = end + 1;
  }
  EXPECT_EQ(rows, 1U + 2U * 51U);
  EXPECT_EQ(
      csv.find("path,step,s,degrees,shift,minima,distance,eigenvalue,relative_curvature,nearest_energy,"),
      0U);
  std::size_t minima = 0;
  for (const TransitionPath& path : result_->paths)
    for (const TransitionSample& sample : path.samples) minima += sample.minima.size();
  const std::string list = transition_minima_csv(*result_);
  EXPECT_EQ(static_cast<std::size_t>(std::count(list.begin(), list.end(), '\n')), 1U + minima);
}

TEST(Rings, AutoIsNearestWhereTheActivationDistanceIsSmall)
{
  const Scene s(rings(60.0));
  TransitionSpec spec = spec_of(s.model, {{"turn", twist(0, 1), 2}});
  spec.g_hat = 1e-4;
  spec.contacts = {"auto"};
  EXPECT_EQ(run(spec).paths[0].curves[0].formulation, "nearest");
}

/// A hundred times nearer, where auto is nearest: what comes near a merge is done again with arc.
TEST(Rings, AutoBeginsAgainWithArcWhereContactsMerge)
{
  const double small = 0.01 * gap, split = std::acos(1.0 - (2.0 * r + small) / R) / degree;
  const Scene s(rings(split, r, small));
  TransitionSpec spec =
      spec_of(s.model, {{"pitchfork", twist(0.3, -0.15), 20}, {"regular", twist(2.0, 4.0), 2}});
  spec.g_hat = 0.01 * activation / s.model.length;
  spec.contacts = {"nearest", "auto"};
  const TransitionResult result = run(spec);
  ASSERT_EQ(result.paths.size(), 2U);
  const TransitionCurve& nearest = result.paths[0].curves[0];
  EXPECT_GT(nearest.energy.relative, 0.2);
  EXPECT_GT(nearest.force.relative, 0.2);
  const TransitionCurve& automatic = result.paths[0].curves[1];
  EXPECT_EQ(automatic.formulation, "arc");
  EXPECT_LT(bound(automatic.energy), 1e-7);
  EXPECT_LT(bound(automatic.force), 1e-6);
  EXPECT_EQ(result.paths[1].curves[1].formulation, "nearest");
}

TEST(Rings, ThreadsDoNotMatter)
{
  const Scene s(rings(43.27));
  const TransitionSpec spec = spec_of(s.model, {{"folds", tilt(s.model, 43.27, 0.68), 10}});
  EXPECT_EQ(transition_csv(run(spec, 1)), transition_csv(run(spec, 3)));
}

TEST(Rings, OverlapsAreProblems)
{
  const Scene s(rings(43.27));
  RigidMotion m;
  m.shift_to = Vec3(0.05, 0, 0) / s.model.length;
  const TransitionSpec spec = spec_of(s.model, {{"apart", twist(0, 1), 4}, {"into each other", m, 4}});
  const auto problems = transition_problems(spec);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].first, 1U);
  EXPECT_EQ(problems[0].second,
            "the surfaces touch or overlap at step 2 of 4; keep them apart on the whole path");
}

}  // namespace
}  // namespace hauberk
