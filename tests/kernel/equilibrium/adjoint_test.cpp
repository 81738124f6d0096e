/// Adjoint gradients against re-solved differences at fixed stiffness, and against explicit ones.

#include "equilibrium/adjoint.hpp"

#include "equilibrium/gaps.hpp"
#include "equilibrium/locking.hpp"
#include "limits/limits.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

namespace hauberk::test {
namespace {

const KeepGoing always = [] { return true; };

/// One cell of chainmail whose two rings differ, so that contact forces are unique.
SceneSpec uneven()
{
  SceneSpec s = chainmail(1, 1);
  s.elements[0].parameters = {4.85, 1.10, 1.10};
  s.elements[1].parameters = {4.80, 1.14, 1.14};
  s.length = 4.9;
  return s;
}

Schedule to(double last)
{
  Schedule schedule;
  schedule.first = 0.1;
  schedule.last = last;
  schedule.change = last;  // integrated finely: what a rough integral is off, gradients do not know
  schedule.tolerance = schedule.last_tolerance = 1e-13;
  return schedule;
}

struct Solved {
  Model model;
  Vector load;
  Locked locked;
};

Solved solve(const SceneSpec& scene, const Sheet& sheet, double last, const Locked* from = nullptr)
{
  Solved s{make_model(scene, sheet, 0.0), {}, {}};
  s.load = load_vector(s.model, Direction::at_degrees(70.0), Sense::positive);
  if (from == nullptr) {
    const State start = perturbed(s.model, rest_state(s.model), 1e-3, 1, Copies::apart);
    s.locked = lock(s.model, start, s.load, ContactChoice::arc, to(last), always);
    EXPECT_EQ(s.locked.status, LockStatus::locked) << s.locked.message;
  } else {  // the same stage alone, from a state that is close to its minimum
    s.locked = *from;
    const StageResult r = solve_stage(s.model, s.locked.state, s.load, from->stage, always);
    EXPECT_EQ(r.status, StageStatus::minimum) << r.message;
  }
  return s;
}

Matrix explicit_gradient(const Solved& s)
{
  Request request;
  request.order = 1;
  request.parameters = true;
  const Stage& stage = s.locked.stage;
  const auto pairs = stage_pairs(s.model, s.locked.state, stage);
  return -stage.mu * contact_energy(s.model, s.locked.state, pairs, stage.contact, request).parameters;
}

Vector unit(const Model& m, int k)
{
  Vector q = Vector::Zero(m.dofs());
  q[k] = 1.0;
  return q;
}

TEST(Adjoint, AgreesWithSolvingAgainForEveryStrain)
{
  const Sheet sheet(2);
  const SceneSpec scene = uneven();
  const Solved at = solve(scene, sheet, 1e-2);
  const double gap = smallest_gap(at.model, at.locked.state, 0.1) * scene.length;
  for (int k = 0; k < at.model.macro_count; ++k) {
    const AdjointGradient g =
        adjoint_gradient(at.model, at.locked.state, at.load, at.locked.stage, unit(at.model, k));
    EXPECT_LT(g.residual, 1e-8) << "strain " << k;
    const double largest = g.parameters.cwiseAbs().maxCoeff();
    EXPECT_GT(largest, 1e-3) << "strain " << k;
    for (std::size_t e = 0; e < 2; ++e) {
      for (const std::vector<std::size_t>& group : {std::vector<std::size_t>{0}, {1, 2}}) {  // R; r0 = r1
        double stated = 0.0;
        for (const std::size_t p : group) stated += g.parameters(static_cast<int>(p), static_cast<int>(e));
        std::array<double, 2> error{};
        for (std::size_t j = 0; j < 2; ++j) {
          const double h = 0.2 * gap / (j == 0 ? 1.0 : 2.0);  // below the smallest gap
          std::array<double, 2> value{};
          for (std::size_t side = 0; side < 2; ++side) {
            SceneSpec changed = scene;
            for (const std::size_t p : group) changed.elements[e].parameters[p] += side == 0 ? h : -h;
            value[side] = solve(changed, sheet, 0.0, &at.locked).locked.state.macro[k];
          }
          error[j] = std::abs((value[0] - value[1]) / (2.0 * h) - stated);
        }
        // Of second order, down to the noise of solved states (5e-9) over 2 h.
        EXPECT_LT(error[1], 2e-3 * largest) << k << ' ' << e << ' ' << group.front();
        EXPECT_LT(error[1], std::max(0.35 * error[0], 1e-5 * largest))
            << k << ' ' << e << ' ' << group.front();
      }
    }
  }
}

TEST(Adjoint, OfTheValueTendsToTheExplicitGradientAsStagesGoDown)
{
  // Value and value minus contact energy differ by mu contact, which falls with the activation distance.
  const Sheet sheet(2);
  const SceneSpec scene = uneven();
  std::array<double, 3> difference{};
  for (std::size_t k = 0; k < difference.size(); ++k) {
    const Solved at = solve(scene, sheet, 1e-2 * std::pow(0.1, static_cast<double>(k)));
    Vector quantity = Vector::Zero(at.model.dofs());
    quantity.head(at.model.macro_count) = at.load;
    const Matrix adjoint =
        adjoint_gradient(at.model, at.locked.state, at.load, at.locked.stage, quantity).parameters;
    const Matrix direct = explicit_gradient(at);
    EXPECT_GT(direct.cwiseAbs().maxCoeff(), 0.05);
    difference[k] = (adjoint - direct).cwiseAbs().maxCoeff() / direct.cwiseAbs().maxCoeff();
  }
  EXPECT_GT(difference[0], 1e-4) << "nothing to tend";
  EXPECT_LT(difference[1], 0.2 * difference[0]);
  EXPECT_LT(difference[2], 0.2 * difference[1]);
}

TEST(Adjoint, WhatTheEquilibriumDoesNotFixIsSaid)
{
  // Rings of revolution are free to spin about their axes: their angle has no derivative.
  const Sheet sheet(2);
  const Solved at = solve(uneven(), sheet, 1e-2);
  const Vec3 axis = at.locked.state.rotation[0] * Vec3::UnitZ();
  Vector quantity = Vector::Zero(at.model.dofs());
  quantity.segment<3>(at.model.offset(0) + at.model.coordinate_count) = axis;
  const AdjointGradient g = adjoint_gradient(at.model, at.locked.state, at.load, at.locked.stage, quantity);
  EXPECT_GT(g.residual, 0.99);
  // Nothing depends on nothing.
  const AdjointGradient none =
      adjoint_gradient(at.model, at.locked.state, at.load, at.locked.stage, Vector::Zero(at.model.dofs()));
  EXPECT_EQ(none.parameters, Matrix::Zero(3, 2));
  EXPECT_EQ(none.residual, 0.0);
}

/// A minimum that is predicted from its response misses the one that is solved for by the square of the
/// change.
TEST(ResponseOfMinimum, IsItsDerivative)
{
  const Sheet sheet(2);
  const SceneSpec scene = uneven();
  const Solved at = solve(scene, sheet, 1e-2);
  const auto changed = [&scene](double by) {
    SceneSpec s = scene;
    s.elements[0].parameters[0] += by;
    s.elements[1].parameters[1] -= 0.4 * by;
    s.elements[1].parameters[2] -= 0.4 * by;
    return s;
  };
  constexpr double whole = 1e-3, share = 1e-3;
  const Model ahead = make_model(changed(share * whole), sheet, 0.0);
  long evaluations = 0;
  const std::optional<Vector> response =
      response_of_minimum(at.model, ahead, share, at.locked.state, at.load, at.locked.stage, evaluations);
  ASSERT_TRUE(response.has_value());
  EXPECT_GT(evaluations, 0);
  std::array<double, 3> missed{};
  double moved = 0.0;
  for (std::size_t k = 0; k < missed.size(); ++k) {
    const double part = 1.0 / static_cast<double>(1U << k);
    const Solved there = solve(changed(part * whole), sheet, 1e-2, &at.locked);
    const Vector way = difference(at.model, at.locked.state, there.locked.state);
    missed[k] = (way - part * *response).head(3).norm();
    moved = way.head(3).norm();
  }
  EXPECT_LT(missed[2], 0.05 * moved);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(std::log2(missed[k] / missed[k + 1]), 2.0, 0.3) << missed[k];
}

/// Where a surface of the changed model touches there is no response.
TEST(ResponseOfMinimum, IsNoneWhereGapsClose)
{
  const Sheet sheet(2);
  const Solved at = solve(uneven(), sheet, 1e-2);
  SceneSpec thick = uneven();
  thick.elements[0].parameters[1] = thick.elements[0].parameters[2] = 1.2;
  long evaluations = 0;
  EXPECT_FALSE(response_of_minimum(at.model, make_model(thick, sheet, 0.0), 1.0, at.locked.state, at.load,
                                   at.locked.stage, evaluations)
                   .has_value());
}

}  // namespace
}  // namespace hauberk::test
