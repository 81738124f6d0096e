/// Limits of chains of solids: those of chains of the built-in tori, with the same sensitivities.

#include "limits/limits.hpp"
#include "model/links.hpp"
#include "scenes.hpp"
#include "solid_kit/solids.hpp"
#include "torus_solid.hpp"

#include <hauberk/kit/solid_shape.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace hauberk::test {
namespace {

/// An author's torus as a shape.
template <class Author>
struct WithParameters : Author {
  static std::vector<ParameterInfo> parameters()
  {
    return {{"R", "length", 1.0, 1e-9, 1e9, "", true}, {"r", "length", 1.0, 1e-9, 1e9, "", true}};
  }
};

enum class Written {
  by_hand_core,     ///< TorusSolid, probed along its core
  by_hand_surface,  ///< the same, probed over its surface
  kit_core,         ///< two templates and a core
  kit_surface       ///< two templates, with a field that is no distance
};

std::shared_ptr<const Shape> shape(Written how)
{
  switch (how) {
    case Written::by_hand_core:
      return std::make_shared<TorusSolidShape>(1);
    case Written::by_hand_surface:
      return std::make_shared<TorusSolidShape>(2);
    case Written::kit_core:
      return std::make_shared<kit::SolidShape<WithParameters<Torus>>>("torus");
    case Written::kit_surface:
      return std::make_shared<kit::SolidShape<WithParameters<PlainTorus>>>("torus");
  }
  return nullptr;
}

struct Case {
  const char* name;
  ContactChoice contact;
  Written how;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class SolidLimits : public ::testing::TestWithParam<Case> {};

LimitResult stretched(const SceneSpec& scene, ContactChoice contact)
{
  const Sheet load(3);
  const Model model = make_model(scene, load, 0.1);
  LimitSettings settings;
  settings.contact = contact;
  return compute_limits(model, scene, {{Direction::at_degrees(0.0), Sense::positive}}, settings, 1)[0];
}

TEST_P(SolidLimits, OfAChainAreThoseOfTori)
{
  SceneSpec tori = chain({5, 0.7, 0.7}, {4.6, 0.7, 0.7}, 15.5);
  tori.length = 5.0;
  SceneSpec solids = tori;
  for (ElementType& type : solids.types) type.shape = shape(GetParam().how);
  for (PlacedElement& element : solids.elements) element.parameters.resize(2);
  const LimitResult x = stretched(tori, GetParam().contact), y = stretched(solids, GetParam().contact);
  ASSERT_EQ(x.status, LimitStatus::locked) << x.message;
  ASSERT_EQ(y.status, LimitStatus::locked) << y.message;
  // Taut: the period is 2 (R + R' - r - r' - clearance) where rings are at right angles.
  EXPECT_NEAR(*y.value, 2.0 * (5.0 + 4.6 - 1.4 - 0.1) / 15.5 - 1.0, 1e-8);
  EXPECT_NEAR(*y.value, *x.value, 1e-9);
  ASSERT_TRUE(y.sensitivity_clearance);
  // Sensitivities are those of contact forces, which the distances of a field that is none leave balanced to
  // 2e-5.
  const double balanced = GetParam().how == Written::kit_surface ? 1e-5 : 1e-6;
  EXPECT_NEAR(*y.sensitivity_clearance, -2.0 / 15.5, balanced);
  for (const auto& [name, derivative] : y.sensitivity_parameters)
    EXPECT_NEAR(derivative, (name.back() == 'R' ? 2.0 : -2.0) / 15.5, balanced) << name;
  EXPECT_EQ(y.sensitivity_parameters.size(), 4U);
}

/// Integrals over the surfaces of solids cost ten times as many distances as their minima.
TEST(SolidStages, OfSurfacesBeginWithMinima)
{
  const auto formulations = [](Written how, ContactChoice choice) {
    SceneSpec scene = chain({5, 0.7, 0.7}, {4.6, 0.7, 0.7}, 15.5);
    scene.length = 5.0;
    for (ElementType& type : scene.types) type.shape = shape(how);
    for (PlacedElement& element : scene.elements) element.parameters.resize(2);
    const Sheet load(3);
    std::vector<Formulation> out;
    for (const PlannedStage& stage : planned_stages(make_model(scene, load, 0.1), choice, Schedule()))
      out.push_back(stage.formulation);
    return out;
  };
  using enum Formulation;
  const std::vector<Formulation> surfaces = formulations(Written::kit_surface, ContactChoice::automatic);
  EXPECT_EQ(surfaces, std::vector<Formulation>(surfaces.size(), nearest));
  EXPECT_EQ(formulations(Written::kit_surface, ContactChoice::arc),
            std::vector<Formulation>(surfaces.size(), arc));
  EXPECT_EQ(formulations(Written::kit_core, ContactChoice::automatic).front(), arc);
}

/// Two upright rings that cross each other, and a ring around one of them, which `through` makes.
SceneSpec crossed(std::shared_ptr<const Shape> through, std::vector<double> sizes)
{
  const double quarter = 0.5 * std::numbers::pi;
  const Mat3 upright = rotation_exp(Vec3(quarter, 0, 0));
  SceneSpec s;
  s.types.push_back({"crossed", std::make_shared<Rings>(std::vector<Rings::Ring>{{Vec3::Zero(), upright},
                                                                                 {Vec3(4, 0, 0), upright}})});
  s.types.push_back({"ring", std::move(through)});
  s.elements.push_back({0, {5, 0.5, 0.5, 5, 0.5, 0.5}, {}});
  s.elements.push_back({1, std::move(sizes), {Vec3(9, 0, 0), Mat3::Identity()}});
  s.lattice = {Vec3(60, 0, 0), Vec3(0, 60, 0)};
  s.length = 5.0;
  return s;
}

TEST(SolidLinks, WithLoopsOfSeveralPrimitivesAreThoseOfTori)
{
  const Sheet load(3);
  const auto found = [&](const SceneSpec& scene) {
    const Model m = make_model(scene, load, 0.0);
    EXPECT_FALSE(m.spines.empty()) << "the two rings make no loop together";
    const std::vector<ElementLink> links = element_links(m);
    return links.size() == 1 ? std::pair(links[0].primitives, links[0].together) : std::pair(-1, -1);
  };
  const auto expected = found(crossed(std::make_shared<Rings>(), {2.5, 0.4, 0.4}));
  EXPECT_GE(expected.first + expected.second, 1);
  for (const int dimension : {1, 2})
    EXPECT_EQ(found(crossed(std::make_shared<TorusSolidShape>(dimension), {2.5, 0.4})), expected)
        << "probe of dimension " << dimension;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, SolidLimits,
    ::testing::Values(Case{"arc_cores", ContactChoice::arc, Written::by_hand_core},
                      Case{"nearest_cores", ContactChoice::nearest, Written::by_hand_core},
                      Case{"constrained_cores", ContactChoice::constrained, Written::by_hand_core},
                      Case{"surfaces", ContactChoice::automatic, Written::by_hand_surface},
                      Case{"kit_cores", ContactChoice::automatic, Written::kit_core},
                      Case{"kit_surfaces", ContactChoice::automatic, Written::kit_surface}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace hauberk::test
