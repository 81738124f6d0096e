/// Derivatives of contact energies and gaps in parameters that turn primitives: central differences at
/// several step sizes must converge with second order.

#include "differences.hpp"
#include "equilibrium/contact_energy.hpp"
#include "equilibrium/gaps.hpp"
#include "model/near_pairs.hpp"
#include "scenes.hpp"
#include "torus_solid.hpp"
#include "turned.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

enum class Kind { circle, ellipse, curve, solid };

/// About 5 wide, 0.7 thick.
Primitive ring(Kind kind)
{
  Primitive out;
  if (kind == Kind::solid) {
    out = torus_solid(4.8, 0.7, 1);
  } else if (kind == Kind::curve) {
    out.kind = PrimitiveKind::curve_tube;
    out.curve = {{Vec3(5.0, 0, 0.1), Vec3(0.2, 4.6, 0)}, {Vec3(0, 0.1, 0.2), Vec3(0.1, 0, 0)}};
    out.size = {1.0, 0.7, 0.7};
  } else {
    out.kind = kind == Kind::circle ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
    out.size = {4.9, 0.7, kind == Kind::circle ? 0.7 : 0.9};
  }
  out.name = "ring";
  out.position = Vec3(0.3, -0.2, 0.4);
  return out;
}

struct Case {
  const char* name;
  Formulation formulation;
  Kind first, second;
};

class RotationParameters : public ::testing::TestWithParam<Case> {
 protected:
  RotationParameters()
  {
    const Case& c = GetParam();
    const double quarter = 0.5 * std::numbers::pi;
    spec.types = {{"first", std::make_shared<Turned>(std::vector{ring(c.first)})},
                  {"second", std::make_shared<Turned>(std::vector{ring(c.second)})}};
    spec.elements.push_back({0, {0.15, -0.1, 0.2}, {Vec3::Zero(), rotation_exp(Vec3(0.1, 0.05, 0))}});
    spec.elements.push_back({1, {-0.1, 0.1, 0.05}, {Vec3(7.75, 0, 0), rotation_exp(Vec3(quarter, 0.1, 0))}});
    spec.lattice = {Vec3(15.5, 0, 0), Vec3(0, 300, 0)};
    spec.length = 4.8;
    if (c.formulation == Formulation::mesh) spec.facets = 20;
    model = make_model(spec, load, 0.01);
    state = rest_state(model);
  }

  Model turned(int element, std::size_t k, double by) const
  {
    SceneSpec moved = spec;
    moved.elements[element].parameters[k] += by;
    return make_model(moved, load, 0.01);
  }

  Sheet load{3};
  SceneSpec spec;
  Model model;
  State state;
};

TEST_P(RotationParameters, OfTheEnergy)
{
  const ContactSettings settings{GetParam().formulation, 0.25, model.clearance};
  const auto pairs = near_pairs(model, state, 1.0);
  const ContactEnergy e = contact_energy(model, state, pairs, settings, {1, true, false});
  ASSERT_GT(e.min_gap, 0.0);
  const double scale = e.parameters.norm();
  ASSERT_GT(scale, 1e-2);
  for (int element = 0; element < 2; ++element) {
    EXPECT_GT(e.parameters.col(element).norm(), 1e-2) << element;
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> error{};
      for (int j = 0; j < 3; ++j) {
        const double h = 4e-4 / (1 << j);
        std::array<double, 2> v{};
        for (std::size_t side = 0; side < 2; ++side)
          v[side] = contact_energy(turned(element, k, side == 0 ? h : -h), state, pairs, settings, {}).energy;
        error[j] = std::abs((v[0] - v[1]) / (2.0 * h) - e.parameters(static_cast<Eigen::Index>(k), element));
      }
      expect_second_order(error, scale, 5e-6);
    }
  }
}

TEST_P(RotationParameters, OfTheGaps)
{
  constexpr double range = 0.25;
  const std::vector<Gap> gaps = find_gaps(model, state, range, true);
  ASSERT_FALSE(gaps.empty());
  const auto smallest = [](const std::vector<Gap>& all, int a) {
    const Gap* least = nullptr;
    for (const Gap& g : all)
      if (g.a == a && (least == nullptr || g.gap < least->gap)) least = &g;
    return *least;
  };
  const int a = gaps.front().a;
  const Gap here = smallest(gaps, a);
  for (int element = 0; element < 2; ++element) {
    const Vector& claimed = element == model.bodies[here.a].element ? here.da : here.db;
    EXPECT_GT(claimed.norm(), 1e-3);
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> error{};
      for (int j = 0; j < 3; ++j) {
        const double h = 4e-4 / (1 << j);
        std::array<double, 2> v{};
        for (std::size_t side = 0; side < 2; ++side)
          v[side] = smallest(find_gaps(turned(element, k, side == 0 ? h : -h), state, range, false), a).gap;
        error[j] = std::abs((v[0] - v[1]) / (2.0 * h) - claimed[k]);
      }
      expect_second_order(error, 1.0, 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, RotationParameters,
    ::testing::Values(Case{"arc_circle_circle", Formulation::arc, Kind::circle, Kind::circle},
                      Case{"arc_curve_curve", Formulation::arc, Kind::curve, Kind::curve},
                      Case{"arc_curve_ellipse", Formulation::arc, Kind::curve, Kind::ellipse},
                      Case{"nearest_circle_ellipse", Formulation::nearest, Kind::circle, Kind::ellipse},
                      Case{"nearest_ellipse_ellipse", Formulation::nearest, Kind::ellipse, Kind::ellipse},
                      Case{"nearest_curve_curve", Formulation::nearest, Kind::curve, Kind::curve},
                      Case{"nearest_solid_circle", Formulation::nearest, Kind::solid, Kind::circle},
                      Case{"published_circle_ellipse", Formulation::published, Kind::circle, Kind::ellipse},
                      Case{"mesh_circle_curve", Formulation::mesh, Kind::circle, Kind::curve}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace hauberk::test
