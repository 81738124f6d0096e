/// Triangle meshes as elements: tori given as surfaces must be what contact mesh makes of tori, links, and
/// exact limits with their derivatives.

#include <scenes.hpp>
#include "contact/body_pair.hpp"
#include "equilibrium/gaps.hpp"
#include "equilibrium/rest.hpp"
#include "geometry/facets.hpp"
#include "geometry/separation.hpp"
#include "limits/limits.hpp"
#include "surfaces.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <random>

namespace hauberk::test {
namespace {

/// What contact mesh makes of a torus, as triangles.
Triangles torus(double R, double r0, double r1, int n)
{
  const Facets facets(R, r0, r1, n);
  Triangles out{facets.points(), {}};
  out.triangles.reserve(facets.triangles().size());
  for (const Facets::Triangle& t : facets.triangles()) out.triangles.push_back(t.points);
  return out;
}

LimitSettings mesh_settings(double last = 1e-6)
{
  LimitSettings settings;
  settings.contact = ContactChoice::mesh;
  settings.schedule.last = last;
  return settings;
}

LimitResult limit(const SceneSpec& spec, double last = 1e-6)
{
  const Sheet load(3);
  const Model m = make_model(spec, load, 0.0);
  return compute_limits(m, spec, {{Direction::at_degrees(0.0), Sense::positive}}, mesh_settings(last), 1)
      .front();
}

/// The scene with every element made a solid of the same facets.
SceneSpec as_surfaces(const SceneSpec& spec)
{
  SceneSpec out = spec;
  out.length = characteristic_length(spec);
  out.types.clear();
  for (PlacedElement& e : out.elements) {
    e.type = static_cast<int>(out.types.size());
    out.types.push_back(
        {"solid" + std::to_string(e.type),
         std::make_shared<Solid>(torus(e.parameters[0], e.parameters[1], e.parameters[2], spec.facets))});
    e.parameters = {1.0};
  }
  return out;
}

TEST(TorusAsSurface, HasTheSameFacetsAndEnergies)
{
  const Sheet load(3);
  SceneSpec spec = chain({5, 0.7, 0.7}, {4.6, 0.7, 0.9}, 15.5);
  spec.facets = 12;
  const Model tori = make_model(spec, load, 0.0), solids = make_model(as_surfaces(spec), load, 0.0);
  ASSERT_EQ(tori.bodies.size(), solids.bodies.size());
  for (std::size_t k = 0; k < tori.bodies.size(); ++k) {
    const Facets &a = *tori.bodies[k].facets, &b = *solids.bodies[k].facets;
    ASSERT_EQ(a.points().size(), b.points().size());
    for (std::size_t i = 0; i < a.points().size(); ++i)
      EXPECT_LT((a.points()[i] - b.points()[i]).norm(), 1e-15);
    ASSERT_EQ(a.triangles().size(), b.triangles().size());
    for (std::size_t i = 0; i < a.triangles().size(); ++i)
      EXPECT_EQ(a.triangles()[i].points, b.triangles()[i].points);
  }
  // Linked pairs are the same; the sign is that of circles only.
  ASSERT_EQ(tori.links.size(), 2U);
  ASSERT_EQ(solids.links.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(tori.links[k].image, solids.links[k].image);
    EXPECT_EQ(solids.links[k].number, 1);
  }
  const State rest = rest_state(tori);
  std::mt19937_64 rng(3);
  ContactSettings settings;
  settings.formulation = Formulation::mesh;
  settings.g_hat = 0.5;
  for (int trial = 0; trial < 10; ++trial) {
    Pose p;
    p.rotation = random_rotation(rng, 0.1);
    const Pose q{Vec3(1.7, 0.0, 0.0), rotation_exp(Vec3(1.57, 0.0, 0.0))};
    const PairContact a = pair_contact(tori.bodies[0], p, tori.bodies[1], q, settings, 2);
    const PairContact b = pair_contact(solids.bodies[0], p, solids.bodies[1], q, settings, 2);
    ASSERT_GT(a.terms.energy, 0.0);
    EXPECT_NEAR(a.terms.energy, b.terms.energy, 1e-12 * a.terms.energy);
    EXPECT_LT((a.terms.gradient - b.terms.gradient).norm(), 1e-11 * a.terms.gradient.norm());
    EXPECT_NEAR(a.min_gap, b.min_gap, 1e-14);
  }
}

TEST(TorusAsSurface, HasTheSameLimit)
{
  for (const int facets : {8, 13}) {
    SceneSpec spec = chain({5, 0.7, 0.7}, {4.6, 0.7, 0.9}, 15.5);
    spec.facets = facets;
    const LimitResult tori = limit(spec), solids = limit(as_surfaces(spec));
    ASSERT_EQ(tori.status, LimitStatus::locked) << tori.message;
    ASSERT_EQ(solids.status, LimitStatus::locked) << solids.message;
    // Where a flat rests on a flat the path decides what the last stage leaves of the gap, a tenth of its
    // 1e-6 L.
    constexpr double gap_of_last_stage = 1e-7;
    EXPECT_NEAR(*tori.value, *solids.value, gap_of_last_stage);
    fmt::print("{} facets: a torus as a surface differs by {:.1e} of {:.12f}\n", facets,
               *solids.value - *tori.value, *tori.value);
    // One torus and one solid.
    SceneSpec mixed = as_surfaces(spec);
    mixed.types[0] = spec.types[0];
    mixed.elements[0].parameters = spec.elements[0].parameters;
    const LimitResult both = limit(mixed);
    ASSERT_EQ(both.status, LimitStatus::locked) << both.message;
    EXPECT_NEAR(*tori.value, *both.value, 1e-12);
  }
}

/// Frames of scales a and b, every second one upright.
SceneSpec frames(double a, double b, double period = 12.0)
{
  SceneSpec s;
  s.types.push_back({"frame", std::make_shared<Solid>(octagon())});
  s.elements.push_back({0, {a}, {Vec3::Zero(), Mat3::Identity()}});
  s.elements.push_back({0, {b}, {Vec3(0.5 * period, 0, 0), rotation_exp(Vec3(1.5707963267948966, 0, 0))}});
  s.lattice = {Vec3(period, 0, 0), Vec3(0, 100, 0)};
  s.facets = 20;
  return s;
}

/// Corners of one hang in the middle of the flats of the other, whose edges, r sin h beside it with h = pi/8,
/// rest on chords of slope tan h. So centres are (a + b) (R - r cos h - r sin h tan h) = (a + b) (R - r/cos
/// h) apart.
const double reach_of_frames = 5.0 - 0.7 / std::cos(3.14159265358979323846 / 8.0);

TEST(Frames, LimitIsExactAndSoIsItsDerivative)
{
  const SceneSpec spec = frames(1.0, 0.9);
  const double exact = 2.0 * reach_of_frames * 1.9 / 12.0 - 1.0, slope = 2.0 * reach_of_frames / 12.0;
  const LimitResult r = limit(spec, 1e-8);
  ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
  EXPECT_NEAR(*r.value, exact, 1e-7);
  fmt::print("frames: error {:.1e}\n", *r.value - exact);
  EXPECT_NEAR(*limit(spec, 1e-3).value, exact, 1e-3);
  ASSERT_EQ(r.sensitivity_parameters.size(), 2U);
  constexpr double h = 1e-4;
  for (std::size_t e = 0; e < 2; ++e) {
    SceneSpec up = spec, down = spec;
    up.length = down.length = characteristic_length(spec);
    up.elements[e].parameters[0] += h;
    down.elements[e].parameters[0] -= h;
    const double difference = (*limit(up, 1e-8).value - *limit(down, 1e-8).value) / (2.0 * h);
    EXPECT_NEAR(difference, slope, 1e-4);
    EXPECT_NEAR(r.sensitivity_parameters[e].second, slope, 1e-4) << r.sensitivity_parameters[e].first;
  }
}

/// Sum of (range - gap)^3 over all features, which does not depend on their order and has no kinks at the
/// range, and its derivative in the scale of the first element, which its images have, too.
std::pair<double, double> sum_of_gaps(const Model& m, const State& s)
{
  constexpr double range = 0.4;
  const auto first = [&m](int body) { return m.bodies[body].element == 0; };
  std::pair<double, double> out{0.0, 0.0};
  for (const Gap& g : find_gaps(m, s, range, true)) {
    const double left = range - g.gap;
    out.first += left * left * left;
    out.second -= 3.0 * left * left * ((first(g.a) ? g.da[0] : 0.0) + (first(g.b) ? g.db[0] : 0.0));
  }
  return out;
}

TEST(Frames, GapsHaveTheirDerivatives)
{
  const Sheet load(3);
  const SceneSpec spec = frames(1.0, 0.9);
  const Model m = make_model(spec, load, 0.0);
  State s = rest_state(m);
  s.rotation[0] = rotation_exp(Vec3(0.05, 0.03, -0.04)) * s.rotation[0];
  const auto changed = [&](double h) {
    SceneSpec other = spec;
    other.length = m.length;
    other.elements[0].parameters[0] += h;
    return sum_of_gaps(make_model(other, load, 0.0), s).first;
  };
  constexpr double h = 1e-6;
  const double slope = sum_of_gaps(m, s).second;
  EXPECT_GT(std::abs(slope), 0.1);
  EXPECT_NEAR((changed(h) - changed(-h)) / (2.0 * h), slope, 1e-6 * std::abs(slope));
}

TEST(Frames, WithoutContactOfMeshesThereIsNoModel)
{
  const Sheet load(3);
  SceneSpec spec = frames(1.0, 1.0);
  spec.facets = 0;
  try {
    make_model(spec, load, 0.0);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "this scene has elements that are triangle meshes: set solver.contact to \"mesh\"");
  }
}

TEST(Frames, MeetingAndNestedOnesAreFoundAtRest)
{
  const Sheet load(3);
  const auto problem = [&load](const SceneSpec& spec) {
    const auto found = rest_problems(spec, make_model(spec, load, 0.0), false);
    return found.empty() ? std::string() : found.front();
  };
  EXPECT_EQ(problem(frames(1.0, 1.0)), "");
  EXPECT_NE(problem(frames(1.0, 1.0, 18.5)).find("meet at rest"), std::string::npos);
  SceneSpec nested = frames(1.0, 1.0);
  nested.types.push_back({"seed", std::make_shared<Solid>(tetrahedron())});
  nested.elements.push_back({1, {0.1}, {Vec3(5.0, 0.0, 0.0), Mat3::Identity()}});
  EXPECT_NE(problem(nested).find("are inside of each other at rest; move them apart"), std::string::npos)
      << problem(nested);
}

/// Bodies of surfaces with facets.
Body solid(const Triangles& t)
{
  const Solid shape(t);
  Body b = make_body(shape.primitives(std::vector<double>{1.0})[0], 0, 0, 1.0);
  b.facets = std::make_shared<const Facets>(*b.surface, b.R);
  return b;
}

Body ring(double R, double r, int n)
{
  Body b;
  b.R = R;
  b.r0 = b.r1 = r;
  b.bound = R + r;
  b.facets = std::make_shared<const Facets>(R, r, r, n);
  return b;
}

TEST(LinksOfSurfaces, FramesRingsAndCoils)
{
  const Body f = solid(frame());
  const Mat3 upright = rotation_exp(Vec3(1.5707963267948966, 0, 0));
  const Pose linked{Vec3(6.0, 0.1, 0.2), upright}, beside{Vec3(6.0, 5.0, 0.2), upright};
  EXPECT_EQ(linking_number(f, {}, f, linked), 1);
  EXPECT_EQ(linking_number(f, linked, f, {}), 1);
  EXPECT_EQ(linking_number(f, {}, f, beside), 0);
  EXPECT_EQ(linking_number(f, {}, f, {Vec3(0.0, 0.0, 3.0), Mat3::Identity()}), 0);
  // Through and back: as often one way as the other.
  EXPECT_EQ(linking_number(f, {}, solid(frame(1.0, 0.3, 0.2)), {Vec3::Zero(), upright}), 0);
  // A body without handles is linked with nothing.
  const Body ball = solid(tetrahedron());
  EXPECT_EQ(linking_number(f, {}, ball, {Vec3(0.1, 0.2, 0.0), Mat3::Identity()}), 0);
  // Tori with facets, in either place.
  const Body thin = ring(3.0, 0.2, 16);
  EXPECT_EQ(linking_number(f, {}, thin, {Vec3(6.0, 0.0, 0.0), upright}), 1);
  EXPECT_EQ(linking_number(thin, {Vec3(6.0, 0.0, 0.0), upright}, f, {}), 1);
  EXPECT_EQ(linking_number(thin, {Vec3(9.0, 0.0, 0.0), upright}, f, {}), 0);
}

TEST(LinksOfSurfaces, AreCountedAsOftenAsTheyGoAround)
{
  const Body core = ring(5.0, 0.2, 40), solid_core = solid(torus(5.0, 0.2, 0.2, 40));
  std::mt19937_64 rng(5);
  for (int turns = 0; turns < 5; ++turns) {
    const Body c = solid(coil(5.0, 1.0, turns, 0.2, 80));
    const Pose placed{Vec3(1.0, -2.0, 3.0), random_rotation(rng)};
    EXPECT_EQ(linking_number(c, placed, core, placed), turns);
    EXPECT_EQ(linking_number(core, placed, c, placed), turns);
    EXPECT_EQ(linking_number(c, placed, solid_core, placed), turns);
  }
}

/// Other loops generate the same: triangles in another order, points with other numbers.
TEST(LinksOfSurfaces, DoNotDependOnTheChoiceOfLoops)
{
  std::mt19937_64 rng(7);
  Triangles t = coil(5.0, 1.0, 3, 0.2, 60);
  const Body core = solid(torus(5.0, 0.2, 0.2, 30));
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<int> order(t.points.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
    std::shuffle(order.begin(), order.end(), rng);
    Triangles other;
    other.points.resize(t.points.size());
    for (std::size_t k = 0; k < order.size(); ++k) other.points[order[k]] = t.points[k];
    for (const auto& triangle : t.triangles) {
      auto& placed = other.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) placed[k] = order[triangle[k]];
    }
    std::shuffle(other.triangles.begin(), other.triangles.end(), rng);
    EXPECT_EQ(linking_number(solid(other), {}, core, {}), 3);
  }
}

TEST(LinksOfSurfaces, WhatKnowsNoSurfacesSaysSo)
{
  Body f = solid(frame());
  EXPECT_THROW(separation(f, {}, f, {Vec3(6.0, 0.0, 0.0), Mat3::Identity()}, 0.0, 1.0), InputError);
  ContactSettings arc;
  EXPECT_THROW(pair_contact(f, {}, f, {Vec3(6.0, 0.0, 0.0), Mat3::Identity()}, arc, 0), InputError);
  f.facets = nullptr;
  EXPECT_THROW(linking_number(f, {}, f, {}), InputError);
}

}  // namespace
}  // namespace hauberk::test
