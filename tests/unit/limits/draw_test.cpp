/// Springs that draw a state to another one.

#include "scenes.hpp"

#include <hauberk/mechanics/equilibrium.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::test {
namespace {

/// A model whose elements are drawn far away, turns of more than a right angle included.
struct Drawn {
  Sheet load{2};
  Model model = make_model(chain({5, 0.7, 0.7}, {4.6, 0.7, 0.7}, 15.5), load, 0.0);
  Draw draw;
  Stage stage;
  State state;

  Drawn()
  {
    state = rest_state(model);
    draw.stiffness = 0.7;
    Vector dy(model.dofs());
    for (int k = 0; k < dy.size(); ++k) dy[k] = std::sin(1.0 + 2.3 * k);
    draw.target = advanced(model, state, dy, 1.0);
    stage.contact = {Formulation::nearest, 1e-6, 0.0};  // nothing touches
    stage.draw = &draw;
  }
  TotalEnergy energy(const State& s, int order) const
  {
    return total_energy(model, s, Vector::Zero(model.macro_count), stage, {}, order);
  }
};

TEST(Draw, GradientAndHessianAreThoseOfTheEnergy)
{
  const Drawn d;
  const TotalEnergy e = d.energy(d.state, 2);
  for (const double scale : {1.0, 0.3}) {
    Vector u(d.model.dofs());
    for (int k = 0; k < u.size(); ++k) u[k] = scale * std::cos(0.4 + 1.7 * k);
    const auto remainder = [&](double h) {
      return std::abs(d.energy(advanced(d.model, d.state, u, h), 0).energy - e.energy -
                      h * e.gradient.dot(u) - 0.5 * h * h * u.dot(e.hessian * u));
    };
    // Third order: a wrong gradient leaves a ratio of 2, a wrong Hessian of 4.
    const double ratio = remainder(2e-3) / remainder(1e-3);
    EXPECT_GT(ratio, 7.5);
    EXPECT_LT(ratio, 8.5);
  }
}

TEST(Draw, VanishesAtItsTarget)
{
  const Drawn d;
  const TotalEnergy e = d.energy(d.draw.target, 2);
  EXPECT_NEAR(e.energy, 0.0, 1e-15);
  EXPECT_LT(e.gradient.norm(), 1e-14);
  const Vector expected = d.draw.stiffness * d.model.metric;
  EXPECT_LT((e.hessian - Matrix(expected.asDiagonal())).norm(), 1e-13 * expected.norm());
}

}  // namespace
}  // namespace hauberk::test
