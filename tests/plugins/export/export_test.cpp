#include "../../kernel/solid_kit/solids.hpp"
#include "export/fabric.hpp"
#include "export/mesh.hpp"
#include "export/picture.hpp"

#include <hauberk/error.hpp>
#include <hauberk/kit/implicit_solid.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

namespace hauberk::exporting {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

Primitive torus(double R, double r0, double r1)
{
  Primitive p;
  p.kind = r0 == r1 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
  p.size = {R, r0, r1};
  return p;
}

/// V - E + F where every edge is passed once each way; -1000 where one is not.
int euler_characteristic(const Mesh& mesh)
{
  std::map<std::pair<int, int>, int> passes;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++passes[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : passes) {
    const auto back = passes.find({edge.second, edge.first});
    if (count != 1 || back == passes.end() || back->second != 1) return -1000;
  }
  return static_cast<int>(mesh.points.size()) - static_cast<int>(passes.size() / 2) +
         static_cast<int>(mesh.triangles.size());
}

/// Pappus: area of the section times the way of its middle.
double torus_volume(double R, double r0, double r1) { return 2.0 * pi * R * pi * r0 * r1; }

TEST(ElementMesh, ATorusIsClosedAndItsVolumeConvergesWithTheChord)
{
  const std::vector<Primitive> ring{torus(5.0, 0.7, 0.4)};
  const double exact = torus_volume(5.0, 0.7, 0.4);
  std::vector<double> missing;
  for (const double chord : {4e-2, 1e-2, 2.5e-3}) {
    const Mesh mesh = element_mesh(ring, chord);
    EXPECT_EQ(euler_characteristic(mesh), 0);
    missing.push_back(exact - volume(mesh));
    EXPECT_GT(missing.back(), 0.0) << "points lie on a surface that is mostly convex";
  }
  EXPECT_NEAR(missing[0] / missing[1], 4.0, 0.6);
  EXPECT_NEAR(missing[1] / missing[2], 4.0, 0.6);
}

TEST(ElementMesh, PointsLieOnTheSurfaceAndFacetsWithinTheChord)
{
  const double R = 3.0, r = 0.5, chord = 1e-2;
  for (const bool joined : {false, true}) {
    std::vector<Primitive> ring{torus(R, r, r)};
    if (joined) ring.push_back(ring[0]);  // a ring and itself: the surface of a union, drawn by its field
    const Mesh mesh = element_mesh(ring, chord);
    const auto off = [&](const Vec3& x) { return std::hypot(std::hypot(x.x(), x.y()) - R, x.z()) - r; };
    double farthest_point = 0.0, deepest_facet = 0.0;
    for (const Vec3& x : mesh.points) farthest_point = std::max(farthest_point, std::abs(off(x)));
    for (const auto& t : mesh.triangles)
      deepest_facet = std::max(
          deepest_facet, std::abs(off((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0)));
    EXPECT_LT(farthest_point, joined ? 1e-3 : 1e-14);
    EXPECT_LT(deepest_facet, 1.05 * chord);
    EXPECT_GT(deepest_facet, 0.05 * chord) << "far more triangles than asked for";
  }
}

Primitive of_solid(std::shared_ptr<const Solid> solid)
{
  Primitive p;
  p.kind = PrimitiveKind::solid;
  p.position = Vec3(1.0, -2.0, 3.0);
  p.rotation = rotation_exp(Vec3(0.3, -0.4, 1.2));
  p.size = {solid->radius(), solid->thickness(), solid->thickness()};
  p.solid = std::move(solid);
  return p;
}

TEST(ElementMesh, ASolidIsSampledByItsChartCloserWhereItBendsMore)
{
  struct Case {
    std::shared_ptr<const Solid> solid;
    int euler;
    double volume;
  };
  // The area within (x/a)^4 + (y/b)^4 = 1 is 4 a b Gamma(5/4)^2/Gamma(3/2).
  const double section = 4.0 * 0.7 * 0.3 * std::pow(std::tgamma(1.25), 2) / std::tgamma(1.5);
  const std::vector<Case> cases{
      {std::make_shared<kit::ImplicitSolid<test::RoundedRing>>(std::vector{5.0, 0.7, 0.3}), 0,
       2.0 * pi * 5.0 * section},
      {std::make_shared<kit::ImplicitSolid<test::PlainTorus>>(std::vector{5.0, 0.7}), 0,
       torus_volume(5.0, 0.7, 0.7)},
      {std::make_shared<kit::ImplicitSolid<test::Capsule>>(std::vector{3.0, 0.5}), 2,
       pi * 0.25 * (6.0 + 4.0 / 3.0 * 0.5)},
      {std::make_shared<kit::ImplicitSolid<test::Ellipsoid>>(std::vector{3.0, 2.0, 0.5}), 2, 4.0 * pi}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.solid->kind());
    const std::vector<Primitive> one{of_solid(c.solid)};
    double missing = infinite;
    for (const double chord : {2e-2, 5e-3, 1.25e-3}) {
      const Mesh mesh = element_mesh(one, chord);
      EXPECT_EQ(euler_characteristic(mesh), c.euler);
      double farthest_point = 0.0, deepest_facet = 0.0;
      const auto off = [&](const Vec3& x) {
        return std::abs(c.solid->distance(one[0].rotation.transpose() * (x - one[0].position)).distance);
      };
      for (const Vec3& x : mesh.points) farthest_point = std::max(farthest_point, off(x));
      for (const auto& t : mesh.triangles)
        deepest_facet =
            std::max(deepest_facet, off((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0));
      EXPECT_LT(farthest_point, 1e-9);
      EXPECT_LT(deepest_facet, 1.05 * chord);
      EXPECT_GT(deepest_facet, 0.1 * chord) << "far more triangles than asked for";
      const double now = c.volume - volume(mesh);
      EXPECT_LT(std::abs(now), 0.7 * missing) << "at chord " << chord;
      missing = std::abs(now);
    }
    EXPECT_LT(missing, 2e-3 * c.volume);
  }
}

TEST(WireRadius, OfASolidIsHalfOfItsShortestWayThrough)
{
  const auto of = [](std::shared_ptr<const Solid> solid) {
    return wire_radius(std::vector{of_solid(std::move(solid))});
  };
  EXPECT_NEAR(of(std::make_shared<kit::ImplicitSolid<test::RoundedRing>>(std::vector{5.0, 0.7, 0.3})), 0.3,
              1e-6);
  EXPECT_NEAR(of(std::make_shared<kit::ImplicitSolid<test::RoundedRing>>(std::vector{5.0, 0.4, 0.7})), 0.4,
              1e-6);
  EXPECT_NEAR(of(std::make_shared<kit::ImplicitSolid<test::Ellipsoid>>(std::vector{3.0, 2.0, 0.5})), 0.5,
              1e-6);
  EXPECT_NEAR(of(std::make_shared<kit::ImplicitSolid<test::PlainTorus>>(std::vector{5.0, 0.7})), 0.7, 1e-6);
  EXPECT_EQ(of(std::make_shared<kit::ImplicitSolid<test::Capsule>>(std::vector{3.0, 0.5})), 0.5);
}

TEST(ElementMesh, RingsThatOverlapAlongThemselvesAreOneTorusOfKnownVolume)
{
  // Two tubes about one axis: the union of two discs, 0.6 apart, turned about it.
  const double r = 0.5, inner = 3.0, outer = 3.6, d = outer - inner;
  const double lens = 2.0 * r * r * std::acos(d / (2.0 * r)) - 0.5 * d * std::sqrt(4.0 * r * r - d * d);
  const double exact = torus_volume(inner, r, r) + torus_volume(outer, r, r) - pi * (inner + outer) * lens;
  std::vector<double> missing;
  for (const double chord : {4e-2, 1e-2}) {
    const std::vector<Primitive> pair{torus(inner, r, r), torus(outer, r, r)};
    const Mesh mesh = element_mesh(pair, chord);
    EXPECT_EQ(euler_characteristic(mesh), 0);
    missing.push_back(std::abs(volume(mesh) - exact));
  }
  EXPECT_LT(missing[1], 5e-3 * exact);
  EXPECT_NEAR(missing[0] / missing[1], 4.0, 1.2);
}

TEST(ElementMesh, AMiddleRingWithThreeAtItsSidesHasFourHoles)
{
  std::vector<Primitive> rings{torus(4.0, 0.6, 0.6)};
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 * pi * k / 3.0;
    Primitive side = torus(1.5, 0.6, 0.6);
    side.position = (4.0 + 1.5 + 0.5) * Vec3(std::cos(angle), std::sin(angle), 0.0);
    rings.push_back(side);
  }
  EXPECT_EQ(euler_characteristic(element_mesh(rings, 2e-2)), 2 - 2 * 4);
}

TEST(ElementMesh, PrimitivesThatDoNotOverlapStayApart)
{
  Primitive other = torus(5.0, 0.7, 0.7);
  other.rotation = Eigen::AngleAxisd(0.5 * pi, Vec3::UnitX()).toRotationMatrix();
  other.position = {5.0, 0.0, 0.0};
  const std::vector<Primitive> linked{torus(5.0, 0.7, 0.7), other};
  const Mesh mesh = element_mesh(linked, 1e-2);
  EXPECT_EQ(euler_characteristic(mesh), 0);  // of two tori
  EXPECT_NEAR(volume(mesh) / (2.0 * torus_volume(5.0, 0.7, 0.7)), 1.0, 2e-2);
}

TEST(ElementMesh, RefusesAChordThatNoMachineHolds)
{
  const std::vector<Primitive> ring{torus(5.0, 0.7, 0.7)};
  EXPECT_THROW(element_mesh(ring, 1e-9), InputError);
}

Fabric chain()
{
  // share/experiments/chain.json: rings of radius 5, upright and lying in turns, 6 apart.
  Fabric fabric;
  fabric.unit = "mm";
  fabric.state = "rest";
  fabric.lattice = fabric.rest_lattice = {Vec3(12.0, 0.0, 0.0), Vec3(0.0, 100.0, 0.0)};
  for (int k = 0; k < 2; ++k) {
    Pose pose;
    pose.position = {6.0 * k, 0.0, 0.0};
    if (k == 1) pose.rotation = Eigen::AngleAxisd(0.5 * pi, Vec3::UnitX()).toRotationMatrix();
    fabric.elements.push_back({"link", {5.0, 0.7, 0.7}, {torus(5.0, 0.7, 0.7)}, pose, pose});
  }
  return fabric;
}

TEST(Assembly, HasOneMeshForEqualElementsAndCopiesAtTheCellsVectors)
{
  const Assembly assembly = assemble(chain(), {3, 1, 1}, std::nullopt, 0.05);
  EXPECT_EQ(assembly.meshes.size(), 1U);
  ASSERT_EQ(assembly.copies.size(), 6U);
  EXPECT_EQ(assembly.copies[4].pose.position, Vec3(24.0, 0.0, 0.0));
  EXPECT_EQ(assembly.copies[5].name, "link 1 [2, 0]");
}

TEST(Assembly, NearestCopiesAreThoseOfTheClosedForm)
{
  // Rings of one plane are 12 apart and 11.4 across.
  const auto nearest = nearest_copies(assemble(chain(), {3, 1, 1}, std::nullopt, 0.1), 100.0);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->distance, 12.0 - 2.0 * 5.7, 1e-6);
  // Alone, linked rings 6 apart are nearest across the hole: 2 * 5 - 6 - 2 * 0.7.
  const auto linked = nearest_copies(assemble(chain(), {1, 1, 1}, std::nullopt, 0.1), 100.0);
  ASSERT_TRUE(linked);
  EXPECT_NEAR(linked->distance, 2.6, 1e-5);
}

TEST(Assembly, OutlineKeepsWhatIsWithinAndRefusesToLeaveNothing)
{
  const Assembly assembly = assemble(chain(), {5, 1, 1}, Outline{10.0, {}}, 0.1);
  EXPECT_EQ(assembly.copies.size(), 4U) << "at -9, -3, 3 and 9 about the middle";
  EXPECT_THROW(assemble(chain(), {2, 1, 1}, Outline{0.1, {}}, 0.1), InputError);
  Fabric taut = chain();
  taut.lattice[0] *= 1.4;
  EXPECT_EQ(assemble(taut, {5, 1, 1}, Outline{10.0, {}}, 0.1).copies.size(), 4U) << "the same piece";
  Fabric patch = chain();
  patch.lattice.clear();
  EXPECT_THROW(assemble(patch, {2, 1, 1}, std::nullopt, 0.1), InputError);
}

/// One row of cells more on every side adds nothing within.
TEST(Assembly, AnOutlineIsFilled)
{
  for (const double skew : {0.0, 3.7, -40.0}) {
    Fabric sheet = chain();
    if (skew > 0.0) sheet.elements[1].rest.position.x() += 60.0;  // the same fabric of other cells
    sheet.lattice = {Vec3(12.0, 0.0, 0.0), Vec3(skew, 7.0, 0.0)};
    sheet.rest_lattice = sheet.lattice;
    for (const Outline& outline : {Outline{31.0, {}}, Outline{0.0, {40.0, 12.5}}}) {
      const std::array<int, 3> cells = cells_that_fill(sheet, outline);
      const auto kept = [&](int more) {
        return assemble(sheet, {cells[0] + more, cells[1] + more, 1}, outline, 0.5).copies.size();
      };
      EXPECT_EQ(kept(0), kept(2)) << skew;
      // Every cell of 84 square millimetres has two.
      const double area = outline.radius > 0.0 ? pi * outline.radius * outline.radius
                                               : 4.0 * outline.half_sides[0] * outline.half_sides[1];
      EXPECT_NEAR(static_cast<double>(kept(0)), 2.0 * area / 84.0, 12.0) << skew;
    }
  }
  Fabric row = chain();
  row.lattice.resize(1);
  row.rest_lattice.resize(1);
  EXPECT_EQ(assemble(row, cells_that_fill(row, Outline{0.0, {33.0, 1.0}}), Outline{0.0, {33.0, 1.0}}, 0.5)
                .copies.size(),
            12U);
  row.lattice.clear();
  EXPECT_EQ(cells_that_fill(row, Outline{100.0, {}}), (std::array<int, 3>{1, 1, 1}))
      << "a patch is what it is";
}

TEST(Picture, HasTheScaleThatIsAskedFor)
{
  Fabric one = chain();
  one.elements.resize(1);
  const Assembly ring = assemble(one, {1, 1, 1}, std::nullopt, 1e-2);
  EXPECT_NEAR(scale_that_fits(ring, view_of("top"), 300, 200), 0.92 * 200.0 / 11.4, 0.02);
  for (const double scale : {5.0, 10.0}) {
    const Raster raster = render(ring, view_of("top"), 300, 200, scale);
    int width = 0;
    for (int x = 0; x < 300; ++x) width += raster.rgb[3 * (100 * 300 + x)] < 250 ? 1 : 0;
    EXPECT_NEAR(width, 2.0 * 1.4 * scale, 3.0) << "both sides of the tube on the middle row";
  }
}

TEST(Picture, ShowsARingFromAboveAsARing)
{
  Fabric one = chain();
  one.elements.resize(1);
  const Assembly ring = assemble(one, {1, 1, 1}, std::nullopt, 1e-2);
  const View top = view_of("top");
  const Raster raster = render(ring, top, 200, 200, scale_that_fits(ring, top, 200, 200));
  const auto covered = [&](int x, int y) { return raster.rgb[3 * (y * 200 + x)] < 250; };
  EXPECT_FALSE(covered(100, 100)) << "the hole";
  EXPECT_FALSE(covered(2, 2));
  long count = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) count += covered(x, y) ? 1 : 0;
  // An annulus of radii 4.3 and 5.7, which fills 92 % of the picture's side.
  const double scale = 0.92 * 200.0 / 11.4;
  EXPECT_NEAR(static_cast<double>(count) / (pi * (5.7 * 5.7 - 4.3 * 4.3) * scale * scale), 1.0, 0.03);
  // Light comes from the left and from behind.
  const auto brightness = [&](int x, int y) { return raster.rgb[3 * (y * 200 + x)]; };
  EXPECT_GT(brightness(100, 200 - 1 - 180), brightness(100, 200 - 1 - 12));
}

TEST(Picture, ViewsAreRefusedWithWhatWouldDo)
{
  EXPECT_EQ(view_of("-45,20").azimuth, -45.0);
  for (const char* text : {"", "above", "10", "10,95", "1,2,3", "nan,0"})
    EXPECT_THROW(view_of(text), InputError) << text;
}

}  // namespace
}  // namespace hauberk::exporting
