/// Symmetries of scenes: groups against those derived by hand, and what must be equal at images of states.

#include "limits/symmetry.hpp"

#include "limits/donors.hpp"

#include "equilibrium/gaps.hpp"
#include "loadcases/in_plane_periodic/in_plane_periodic.hpp"
#include "loadcases/paraboloid_bending/paraboloid_bending.hpp"
#include "loadcases/volumetric_periodic/volumetric_periodic.hpp"
#include "model/links.hpp"
#include "symmetric_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hauberk::test {
namespace {

const InPlanePeriodic flat(StrainMeasure::tensor, {}, {false, false}),
    deep(StrainMeasure::tensor, {true, 0.0}, {false, false}),
    layer(StrainMeasure::tensor, {false, 1.0}, {false, false}),
    equation_12(StrainMeasure::equation_12, {}, {false, false});
const ParaboloidBending bending({});
const VolumetricPeriodic solid;

Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

bool has_part(const std::vector<SceneSymmetry>& group, const Mat3& O)
{
  return std::any_of(group.begin(), group.end(),
                     [&O](const SceneSymmetry& g) { return (g.O - O).norm() < 1e-9; });
}

/// Exactly these orthogonal parts, each once.
void expect_parts(const std::vector<SceneSymmetry>& group, const std::vector<Mat3>& parts)
{
  EXPECT_EQ(group.size(), parts.size());
  for (const Mat3& O : parts) EXPECT_TRUE(has_part(group, O)) << O;
}

/// Equations of the definition, and that nothing is there twice.
void expect_group(const Model& m, const std::vector<SceneSymmetry>& group)
{
  std::set<std::pair<std::vector<int>, std::vector<long>>> different;
  for (const SceneSymmetry& g : group) {
    std::vector<long> part;
    for (const double x : g.O.reshaped()) part.push_back(std::lround(1e6 * x));
    EXPECT_TRUE(different.insert({g.to, part}).second);
    EXPECT_LT((g.O.transpose() * g.O - Mat3::Identity()).norm(), 1e-14);
    std::vector<int> to = g.to;
    std::sort(to.begin(), to.end());
    for (int i = 0; i < m.element_count(); ++i) EXPECT_EQ(to[i], i);
    for (std::size_t i = 0; i < g.to.size(); ++i) {
      const std::size_t j = g.to[i];
      const Vec3 X = g.O * m.rest[i].position + g.t;
      EXPECT_LT((X - m.rest[j].position - m.translation(g.image[i])).norm(), symmetry_tolerance(X));
      EXPECT_LT((g.O * m.rest[i].rotation - m.rest[j].rotation * g.local[i]).norm(), 1e-13);
      EXPECT_NEAR(g.local[i].determinant(), g.O.determinant(), 1e-13);
    }
  }
  ASSERT_FALSE(group.empty());
  EXPECT_EQ(group.front().O, Mat3::Identity());
  EXPECT_EQ(group.front().t, Vec3::Zero());
}

struct Known {
  const char* name;
  SceneSpec scene;
  const LoadCase* load;
  std::size_t points, all;
};

std::vector<Known> known_groups()
{
  SceneSpec oval = threefold_round();
  for (std::size_t k = 2; k < oval.elements[0].parameters.size(); k += 3)
    oval.elements[0].parameters[k] = k == 2 ? 1.5 : 1.4;
  oval.lattice = {Vec3(9.59123136, 5.5375, 0), Vec3(0, 11.075, 0)};  // as files round it
  return {
      // A threefold axis, three mirrors through it, and the sheet turned over: D3h. No turn by 180 degrees.
      {"threefold", threefold_round(), &flat, 12, 12},
      {"published threefold, rounded", oval, &flat, 12, 12},
      {"threefold 2 x 2", repeated(threefold_round(), 2, 2), &flat, 12, 48},
      {"threefold 3 x 1", repeated(threefold_round(), 3, 1), &flat, 4, 12},
      {"threefold turned", scaled_and_turned(threefold_round(), 1.0, 0.37), &deep, 12, 12},
      // The fourfold axis is at a cross; D4h.
      {"fourfold", fourfold(), &flat, 16, 16},
      {"fourfold 2 x 2", repeated(fourfold(), 2, 2), &layer, 16, 64},
      {"fourfold 2 x 1", repeated(fourfold(), 2, 1), &flat, 8, 16},
      // Three mirrors, of which those of y and of z exchange the columns: D2h.
      {"chainmail", chainmail(1, 1), &flat, 8, 8},
      {"chainmail 2 x 2", chainmail(2, 2), &flat, 8, 32},
      {"chainmail 3 x 2, z free", chainmail(3, 2), &deep, 8, 48},
      {"chain", chain({5, 0.7, 0.7}, {5, 0.7, 0.7}, 16.5), &flat, 8, 8},
      {"chain of two kinds", chain({5, 0.7, 0.7}, {4, 0.7, 0.5}, 14.6), &flat, 8, 8},
      {"japanese 4-in-1", japanese(false), &flat, 16, 16},
      {"japanese 6-in-1", japanese(true), &flat, 24, 24},
      {"japanese 6-in-1, 2 x 2", repeated(japanese(true), 2, 2), &deep, 24, 96},
      // About its apex it has what the element in the middle has: the outline has more.
      {"patch of threefold elements", threefold_patch(), &bending, 12, 12},
      {"cubic", cubic(), &solid, 48, 48},
      // Fd-3m, P-43m and, with the turn about (1, 1, 1), R-3c.
      {"diamond of tetrahedra", diamond(), &solid, 48, 48},
      {"truncated tetrahedra", truncated_tetrahedra(), &solid, 24, 24},
      {"octahedra turned both ways", octahedra_solid(), &solid, 12, 12},
      // The knot is chiral: D3 alone.
      {"trefoils", trefoils(), &flat, 6, 6},
  };
}

TEST(Symmetry, GroupsAreThoseDerivedByHand)
{
  for (const Known& k : known_groups()) {
    SCOPED_TRACE(k.name);
    const Model m = make_model(k.scene, *k.load, 0.0);
    const std::vector<SceneSymmetry> points = point_symmetries(m), all = scene_symmetries(m);
    EXPECT_EQ(points.size(), k.points);
    EXPECT_EQ(all.size(), k.all);
    expect_group(m, points);
    expect_group(m, all);
    // A group: the inverse of each is there, too.
    for (const SceneSymmetry& g : all) {
      const SceneSymmetry back = inverse(m, g);
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&back](const SceneSymmetry& h) {
        return (h.O - back.O).norm() < 1e-9 && h.to == back.to;
      }));
    }
  }
}

/// Both rings of the cell alike: the translation between them is found although nobody declared it.
TEST(Symmetry, HiddenTranslationsAreFound)
{
  const Model m = make_model(chainmail(1, 1, 0.0), flat, 0.0);
  EXPECT_EQ(scene_symmetries(m).size(), 16U);
}

TEST(Symmetry, KnotsHaveNoMirrors)
{
  const Model m = make_model(trefoils(), flat, 0.0);
  for (const SceneSymmetry& g : point_symmetries(m)) EXPECT_NEAR(g.O.determinant(), 1.0, 1e-12);
  EXPECT_TRUE(has_part(point_symmetries(m), diagonal(-1, 1, -1)));
}

TEST(Symmetry, AChangedSizeLosesWhatMovesIt)
{
  const Mat3 one = Mat3::Identity();
  SceneSpec threefold = threefold_round();
  threefold.elements[0].parameters[4] += 1e-5;  // r0 of the side ring at -90 degrees
  expect_parts(scene_symmetries(make_model(threefold, flat, 0.0)),
               {one, diagonal(-1, 1, 1), diagonal(1, 1, -1), diagonal(-1, 1, -1)});

  SceneSpec mail = chainmail(2, 2);
  mail.elements[3].parameters[0] -= 1e-3;  // R of one ring: its own symmetries are left, and no translation
  expect_parts(scene_symmetries(make_model(mail, flat, 0.0)),
               {one, diagonal(-1, 1, 1), diagonal(1, -1, -1), diagonal(-1, -1, -1)});
  // A change within the tolerance is none.
  mail = chainmail(2, 2);
  mail.elements[3].parameters[0] -= 1e-9;
  EXPECT_EQ(scene_symmetries(make_model(mail, flat, 0.0)).size(), 32U);
}

TEST(Symmetry, AMovedElementLosesWhatMovesIt)
{
  const Mat3 one = Mat3::Identity();
  SceneSpec mail = chainmail(1, 1);
  mail.elements[1].rest.position.x() += 1e-3;  // the ring in the middle leaves the mirror of x
  // With it the glides go that exchange the rings. Half turns have centres between the rings wherever they
  // are.
  expect_parts(scene_symmetries(make_model(mail, flat, 0.0)),
               {one, diagonal(-1, -1, 1), diagonal(1, -1, -1), diagonal(-1, 1, -1)});
  SceneSpec turned = fourfold();
  turned.elements[1].rest.rotation = rotation_exp(Vec3(0.1, 0, 0)) * turned.elements[1].rest.rotation;
  // Half turns that carry it to itself about x, y and z, and mirrors of x; all that keep its tilt about x.
  expect_parts(scene_symmetries(make_model(turned, flat, 0.0)),
               {one, diagonal(-1, 1, 1), diagonal(1, -1, -1), diagonal(-1, -1, -1)});
  // The lattice opened from 60 to 62 degrees keeps the mirror across its bisector and the sheet's two sides.
  SceneSpec opened = threefold_round();
  const auto at = [](double degrees) {
    return Vec3(threefold_spacing * std::cos(degrees * degree),
                threefold_spacing * std::sin(degrees * degree), 0);
  };
  opened.lattice = {at(29.0), at(91.0)};
  EXPECT_EQ(scene_symmetries(make_model(opened, flat, 0.0)).size(), 4U);
  opened.lattice = {at(30.0), at(92.0)};
  EXPECT_EQ(scene_symmetries(make_model(opened, flat, 0.0)).size(), 2U);
}

TEST(Symmetry, APatchHasThoseOfItsOutline)
{
  SceneSpec patch = threefold_patch();
  patch.elements.erase(patch.elements.begin() + 1);  // at 30 degrees, a mirror of the element
  const Model m = make_model(patch, bending, 0.0);
  const std::vector<SceneSymmetry> group = scene_symmetries(m);
  EXPECT_EQ(group.size(), 4U);
  for (const SceneSymmetry& g : group) {
    const Vec3 gone(std::cos(30.0 * degree), std::sin(30.0 * degree), 0.0);
    EXPECT_LT((g.O * gone - gone).norm(), 1e-9);
  }
  // Raised above the plane of the apex, it turns over about its own height.
  SceneSpec raised = threefold_patch();
  for (PlacedElement& e : raised.elements) e.rest.position.z() += 2.0;
  EXPECT_EQ(scene_symmetries(make_model(raised, bending, 0.0)).size(), 12U);
  raised.elements[0].rest.position.z() += 0.5;  // the one in the middle: no longer
  EXPECT_EQ(scene_symmetries(make_model(raised, bending, 0.0)).size(), 6U);
}

TEST(Symmetry, MeshesAreOnlyMoved)
{
  SceneSpec mail = chainmail(2, 2);
  mail.facets = 12;
  const std::vector<SceneSymmetry> group = scene_symmetries(make_model(mail, flat, 0.0));
  EXPECT_EQ(group.size(), 4U);
  for (const SceneSymmetry& g : group) EXPECT_EQ(g.O, Mat3::Identity());
}

/// A load case that does not say how its unknowns transform has translations alone.
TEST(Symmetry, UnknownLoadCasesHaveTranslations)
{
  class Silent final : public Sheet {
    bool do_transform(const Mat3&, std::span<const double>, std::span<double>) const override
    {
      return false;
    }
  };
  const Silent silent;
  EXPECT_EQ(scene_symmetries(make_model(chainmail(2, 2), silent, 0.0)).size(), 4U);
}

TEST(Symmetry, LargeScenesHaveTheirPointsAlone)
{
  const Model m = make_model(chainmail(20, 20), flat, 0.0);  // 3200 symmetries of 800 elements
  EXPECT_EQ(scene_symmetries(m).size(), 8U);
  // One ring that stands out leaves what carries it to itself.
  SceneSpec mail = chainmail(20, 20);
  mail.elements[400].rest.position.z() += 0.01;
  expect_parts(scene_symmetries(make_model(mail, deep, 0.0)), {Mat3::Identity(), diagonal(-1, 1, 1)});
}

/// A random state near rest with random macroscopic unknowns, free of collisions.
State random_state(const Model& m, std::mt19937_64& rng)
{
  std::normal_distribution<double> normal;
  for (double size = 0.02; size > 1e-6; size *= 0.5) {
    Vector dy(m.dofs());
    for (double& x : dy) x = normal(rng);
    dy.array() *= size / m.metric.array().sqrt();
    const State s = advanced(m, rest_state(m), free_part(m, dy), 1.0);
    if (smallest_gap(m, s, 1.0) > 1e-3) return s;
  }
  throw std::runtime_error("rest has no room");
}

double energy(const Model& m, const State& s)
{
  ContactSettings settings;
  settings.formulation = Formulation::nearest;
  settings.g_hat = 0.3;
  return contact_energy(m, s, near_pairs(m, s, settings.g_hat), settings, {}).energy;
}

std::vector<double> gap_list(const Model& m, const State& s)
{
  std::vector<double> out;
  for (const Gap& g : find_gaps(m, s, 0.3, false)) out.push_back(g.gap);
  std::sort(out.begin(), out.end());
  return out;
}

std::span<const double> macro_of(const State& s)
{
  return {s.macro.data(), static_cast<std::size_t>(s.macro.size())};
}

TEST(Symmetry, ImagesOfStatesAreAsGood)
{
  std::mt19937_64 rng(7);
  for (const Known& k : known_groups()) {
    SCOPED_TRACE(k.name);
    const Model m = make_model(k.scene, *k.load, 0.0);
    const State s = random_state(m, rng);
    const double own = energy(m, s);
    const std::vector<double> gaps = gap_list(m, s);
    ASSERT_GT(own, 0.0);
    ASSERT_TRUE(links_kept(m, s));
    // Scenes that are symmetric only up to the digits of their file are so in their images.
    const double exact = std::string(k.name).find("rounded") == std::string::npos ? 1e-11 : 1e-6;
    bool moved = false;
    for (const SceneSymmetry& g : scene_symmetries(m)) {
      const std::optional<State> image = transformed(m, g, s);
      ASSERT_TRUE(image);
      moved = moved || difference(m, s, *image).norm() > 1e-3;
      EXPECT_NEAR(energy(m, *image), own, exact * own);
      const std::vector<double> others = gap_list(m, *image);
      ASSERT_EQ(others.size(), gaps.size());
      for (std::size_t i = 0; i < gaps.size(); ++i) EXPECT_NEAR(others[i], gaps[i], exact);
      EXPECT_TRUE(links_kept(m, *image));
      for (const Mat3& Q : image->rotation) EXPECT_NEAR(Q.determinant(), 1.0, 1e-13);
      const Vector dy = difference(m, rest_state(m), *image);
      EXPECT_LT((dy - free_part(m, dy)).norm(), 1e-12) << "what equalities hold";
      const std::optional<State> back = transformed(m, inverse(m, g), *image);
      ASSERT_TRUE(back);
      EXPECT_LT(difference(m, s, *back).norm(), 1e-12 * m.dofs());
    }
    EXPECT_TRUE(moved);
  }
}

/// Limits that are searched from many starts: those of loads that push along some line.
TEST(Loads, ThoseThatPushMayFold)
{
  const auto folds = [](const Model& m, const std::vector<double>& components) {
    return may_fold(m, {Direction::along(components), Sense::positive});
  };
  const Model space = make_model(diamond(), solid, 0.0), sheet = make_model(chainmail(1, 1), flat, 0.0);
  EXPECT_FALSE(folds(space, {1, 1, 1, 0, 0, 0}));
  EXPECT_FALSE(folds(space, {0, 1, 0, 0, 0, 0}));
  EXPECT_TRUE(folds(space, {0, -1, 0, 0, 0, 0}));
  EXPECT_TRUE(folds(space, {1, 1, -1e-3, 0, 0, 0}));
  const std::vector<double> volume{1, 1, 1, 0, 0, 0};
  EXPECT_TRUE(may_fold(space, {Direction::along(volume), Sense::negative}));
  EXPECT_TRUE(folds(space, {0, 0, 0, 0, 0, 1}));
  // (1, 1, 0) (1, 1, 0)^T pulls along one line; a little more shear pushes across it.
  EXPECT_FALSE(folds(space, {1, 1, 0, 0, 0, 0.999}));
  EXPECT_TRUE(folds(space, {1, 1, 0, 0, 0, 1.001}));
  EXPECT_FALSE(folds(sheet, {1, 0, 0}));
  EXPECT_TRUE(folds(sheet, {1, -1, 0}));
  EXPECT_TRUE(folds(sheet, {0, 0, 1}));
  EXPECT_TRUE(may_fold(sheet, {Direction::at_degrees(30), Sense::negative}));
  EXPECT_FALSE(may_fold(sheet, {Direction::at_degrees(30), Sense::positive}));
  // Nothing is linked, and nothing holds such a solid together.
  EXPECT_FALSE(folds(make_model(cubic(), solid, 0.0), {0, -1, 0, 0, 0, 0}));
}

/// A patch above the plane of its apex turns over about its own height: its image lies there, too.
TEST(Symmetry, ImagesKeepTheHeightOfAPatch)
{
  SceneSpec raised = threefold_patch();
  for (PlacedElement& e : raised.elements) e.rest.position.z() += 2.0;
  const Model m = make_model(raised, bending, 0.0);
  const State rest = rest_state(m);
  int reversed = 0;
  for (const SceneSymmetry& g : scene_symmetries(m)) {
    const std::optional<State> image = transformed(m, g, rest);
    ASSERT_TRUE(image);
    EXPECT_LT(difference(m, rest, *image).norm(), 1e-12);
    reversed += g.O(2, 2) < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(reversed, 6);
}

TEST(Symmetry, WallsAreMappedToWalls)
{
  const Model m = make_model(chainmail(2, 1), layer, 0.0);
  ASSERT_FALSE(m.walls.empty());
  std::mt19937_64 rng(3);
  const State s = random_state(m, rng);
  const auto offsets = [&m](const State& state) {
    std::vector<double> out;
    for (const LinearInequality& w : m.walls) {
      out.push_back(w.offset);
      for (const LinearTerm& t : w.terms)
        out.back() += t.coefficient * state.e[t.element * m.coordinate_count + t.coordinate];
    }
    std::sort(out.begin(), out.end());
    return out;
  };
  for (const SceneSymmetry& g : scene_symmetries(m)) {
    const std::vector<double> a = offsets(s), b = offsets(*transformed(m, g, s));
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
  }
}

/// The value of the image of a task at the image of a state is that of the task at the state.
TEST(Symmetry, TasksAreCarriedWithTheirValues)
{
  std::mt19937_64 rng(11);
  for (const Known& k : known_groups()) {
    SCOPED_TRACE(k.name);
    const Model m = make_model(k.scene, *k.load, 0.0);
    const State s = random_state(m, rng);
    std::vector<double> components;
    for (int i = 0; i < m.macro_count; ++i) components.push_back(std::sin(1.0 + i));
    int carried = 0;
    for (const SceneSymmetry& g : point_symmetries(m)) {
      const State image = *transformed(m, g, s);
      for (const Direction& d :
           {Direction::at_degrees(10.0), Direction::at_degrees(90.0), Direction::along(components)}) {
        const std::optional<LimitTask> task = transformed(m, g, LimitTask{d, Sense::positive});
        if (!task) continue;
        ++carried;
        const double before = load_vector(m, d, Sense::positive).dot(s.macro);
        EXPECT_NEAR(load_vector(m, task->direction, task->sense).dot(image.macro), before, 1e-12);
        EXPECT_NEAR(std::abs(m.load->value(task->direction, macro_of(image))),
                    std::abs(m.load->value(d, macro_of(s))), 1e-12);
      }
    }
    // Only angles of solids leave the plane.
    if (k.load != &solid) {
      EXPECT_EQ(carried, 3 * static_cast<int>(k.points));
    }
  }
}

/// Angles that the images of a task have, sorted.
std::vector<double> angles(const Model& m, double degrees)
{
  std::vector<double> out;
  for (const SceneSymmetry& g : point_symmetries(m)) {
    const std::optional<LimitTask> task =
        transformed(m, g, LimitTask{Direction::at_degrees(degrees), Sense::positive});
    if (!task) continue;
    const double a = task->direction.degrees();
    if (std::none_of(out.begin(), out.end(), [a](double b) { return std::abs(a - b) < 1e-9; }))
      out.push_back(a);
  }
  std::sort(out.begin(), out.end());
  return out;
}

void expect_angles(const std::vector<double>& found, const std::vector<double>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-9);
}

TEST(Symmetry, EqualDirectionsAreThoseOfTheFabric)
{
  const Model threefold = make_model(threefold_round(), flat, 0.0),
              mail = make_model(chainmail(2, 2), flat, 0.0), four = make_model(fourfold(), flat, 0.0),
              six = make_model(japanese(true), flat, 0.0);
  expect_angles(angles(threefold, 10.0), {10, 50, 70, 110, 130, 170});
  expect_angles(angles(threefold, 0.0), {0, 60, 120});
  expect_angles(angles(six, 30.0), {30, 90, 150});
  expect_angles(angles(mail, 10.0), {10, 170});
  expect_angles(angles(mail, 90.0), {90});
  expect_angles(angles(four, 10.0), {10, 80, 100, 170});
  expect_angles(angles(four, 0.0), {0, 90});
  // The published measure depends on the frame: only what maps the axes to themselves keeps its values.
  expect_angles(angles(make_model(threefold_round(), equation_12, 0.0), 10.0), {10, 170});
  expect_angles(angles(make_model(fourfold(), equation_12, 0.0), 10.0), {10, 80, 100, 170});
}

TEST(Symmetry, WhatTurnsAPatchOverReversesItsSense)
{
  const Model m = make_model(threefold_patch(), bending, 0.0);
  int reversed = 0;
  for (const SceneSymmetry& g : point_symmetries(m)) {
    const std::optional<LimitTask> task =
        transformed(m, g, LimitTask{Direction::at_degrees(20.0), Sense::positive});
    ASSERT_TRUE(task);
    EXPECT_EQ(task->sense == Sense::negative, g.O(2, 2) < 0.0);
    reversed += task->sense == Sense::negative ? 1 : 0;
  }
  EXPECT_EQ(reversed, 6);
}

}  // namespace
}  // namespace hauberk::test
