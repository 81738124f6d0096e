/// Surfaces that plugins bring along: distances of pairs between bounds, against exact ones and against what
/// is done of tori; loops of struts; and solids that contradict themselves.

#include "solid_kit/solids.hpp"
#include "enclosure.hpp"
#include "layout.hpp"
#include "links.hpp"
#include "separation.hpp"
#include "solid_samples.hpp"
#include "strut_frame/capsule.hpp"
#include "surface.hpp"
#include "together.hpp"
#include "torus_solid.hpp"
#include "touching.hpp"

#include <hauberk/kit/implicit_solid.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

namespace hauberk::verification {
namespace {

using std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

template <class S, class... Sizes>
Primitive made(const Place& place, Sizes... sizes)
{
  Primitive out;
  out.name = "solid";
  out.place = place;
  enter_solid(out, std::make_shared<const S>(sizes...));
  out.solid_kind = out.solid->kind();
  return out;
}

Primitive capsule(const Place& place, double h, double r) { return made<Capsule>(place, h, r); }

Primitive torus(const Place& place, double R, double r0, double r1) { return {"ring", place, R, r0, r1}; }

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
  Vec3 vector(double size) { return size * Vec3(between(-1, 1), between(-1, 1), between(-1, 1)); }
  Place place(double size)
  {
    const Vec3 turn = vector(3.0);
    return {vector(size), Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()};
  }

 private:
  std::mt19937_64 engine_;
};

/// Distance of two segments: of an inner point of both where the common perpendicular has its feet there,
/// else of an end of one from the other.
double segments(const Vec3& a, const Vec3& da, const Vec3& b, const Vec3& db)
{
  const auto from = [](const Vec3& x, const Vec3& p, const Vec3& d) {
    return (x - p - std::clamp((x - p).dot(d) / d.squaredNorm(), -1.0, 1.0) * d).norm();
  };
  double nearest =
      std::min({from(a + da, b, db), from(a - da, b, db), from(b + db, a, da), from(b - db, a, da)});
  const Vec3 n = da.cross(db), r = b - a;
  if (n.squaredNorm() < 1e-20 * da.squaredNorm() * db.squaredNorm()) return nearest;
  const double s = r.cross(db).dot(n) / n.squaredNorm(), t = r.cross(da).dot(n) / n.squaredNorm();
  if (std::abs(s) < 1.0 && std::abs(t) < 1.0) nearest = std::min(nearest, std::abs(r.dot(n)) / n.norm());
  return nearest;
}

void expect_encloses(const Primitive& a, const Primitive& b, double exact, double width, int which)
{
  const Enclosure found = enclose(a, b, width, infinite);
  EXPECT_LE(found.least, exact + 1e-12) << which << ": not a lower bound";
  EXPECT_GE(found.found, exact - 1e-12) << which << ": nearer than there is";
  EXPECT_LE(found.found - found.least, width) << which << ": ended before, at " << exact;
}

TEST(Enclosure, OfStrutsIsTheDistanceOfSegments)
{
  Random random(7);
  for (int k = 0; k < 400; ++k) {
    Primitive a = capsule(random.place(4.0), random.between(1.0, 5.0), 0.3);
    Primitive b = capsule(random.place(4.0), random.between(1.0, 5.0), 0.4);
    if (k % 4 == 1) b.place.rotation = a.place.rotation;  // parallel: nearest along a stretch, or end to end
    if (k % 4 == 2) b.place.position = a.place.position + 6.0 * a.place.rotation.col(2);
    const double exact =
        segments(a.place.position, a.R * a.place.rotation.col(2) - 0.3 * a.place.rotation.col(2),
                 b.place.position, b.R * b.place.rotation.col(2) - 0.4 * b.place.rotation.col(2)) -
        0.7;
    if (!(exact > -0.3)) continue;  // deeper than a core has a normal
    expect_encloses(a, b, exact, 1e-10, k);
    expect_encloses(b, a, exact, 1e-10, k);
  }
}

/// Up to here pairs are compared: below the reach of all rings, where the distance has one foot.
constexpr double near = 1.2;

TEST(Enclosure, OfTorusSolidsIsThatOfTori)
{
  Random random(8);
  using Plain = kit::ImplicitSolid<test::PlainTorus>;
  int compared = 0;
  for (int k = 0; k < 150; ++k) {
    const Place at = random.place(5.0), other = random.place(5.0);
    const double R = random.between(3.0, 4.0), r = random.between(0.3, 0.6);
    const Primitive ring = torus(at, R, r, r);
    const Primitive ellipse = torus(other, 3.5, 0.5, random.between(0.3, 0.9));
    Primitive curve = torus(other, 3.5, 0.4, 0.4);
    curve.curve = {{Vec3(3.0, 0.0, 0.0), Vec3(0.0, 4.0, 0.0)}, {Vec3::Zero(), Vec3(0.0, 0.0, 0.5)}};
    for (const Primitive& b : {torus(other, 3.5, 0.5, 0.5), ellipse, curve}) {
      const double exact = separation(ring, b);
      if (!(exact > -0.2 && exact < near)) continue;
      ++compared;
      expect_encloses(made<test::TorusSolid>(at, R, r, 1), b, exact, 1e-10, k);
      expect_encloses(b, made<test::TorusSolid>(at, R, r, 2), exact, 1e-10, k);
      if (k < 40) expect_encloses(made<Plain>(at, std::vector{R, r}), b, exact, 1e-8, k);
    }
  }
  EXPECT_GT(compared, 60);
}

/// Two solids, none of which has a core.
TEST(Enclosure, OfTwoSurfacesIsThatOfTheirCores)
{
  Random random(9);
  using Plain = kit::ImplicitSolid<test::PlainTorus>;
  const std::vector first{3.5, 0.5}, second{3.0, 0.4};
  for (int k = 0; k < 40; ++k) {
    const Place at = random.place(4.0), other = random.place(4.0);
    const double exact = separation(torus(at, 3.5, 0.5, 0.5), torus(other, 3.0, 0.4, 0.4));
    if (!(exact > -0.2 && exact < near)) continue;
    expect_encloses(made<Plain>(at, first), made<Plain>(other, second), exact, 1e-9, k);
  }
  // Two balls that touch from outside, then along their long axes.
  using Ball = kit::ImplicitSolid<test::Ellipsoid>;
  const auto apart = [&](const Vec3& x, const std::vector<double>& axes) {
    return enclose(made<Ball>(Place{}, std::vector{2.0, 2.0, 2.0}),
                   made<Ball>(Place{x, Mat3::Identity()}, axes), 1e-9, infinite);
  };
  EXPECT_NEAR(apart({3.0, 0.0, 0.0}, {1.0, 1.0, 1.0}).found, 0.0, 1e-9);
  EXPECT_NEAR(apart({3.0, 0.0, 0.0}, {1.0, 1.0, 1.0}).least, 0.0, 2e-9);
  EXPECT_NEAR(apart({0.0, 4.0, 0.0}, {1.0, 1.5, 0.7}).least, 0.5, 2e-9);
}

/// Calls of a solid with something changed.
class Changed : public Solid {
 public:
  explicit Changed(std::shared_ptr<const Solid> of) : of_(std::move(of)) {}
  std::string kind() const override { return of_->kind(); }
  std::vector<std::string> size_names() const override { return of_->size_names(); }
  const std::vector<double>& sizes() const override { return of_->sizes(); }
  double radius() const override { return of_->radius(); }
  double thickness() const override { return of_->thickness(); }
  int probe_dimension() const override { return of_->probe_dimension(); }
  double offset() const override { return of_->offset() * wider; }
  Fold fold() const override { return of_->fold(); }
  ProbeDerivatives probe(const ProbeAngles& at) const override
  {
    ProbeDerivatives d = of_->probe(at);
    d.x.x() += shifted;
    return d;
  }
  ProbeBounds probe_bounds(double u, double v, double hu, double hv) const override
  {
    return of_->probe_bounds(u, v, hu, hv);
  }
  Vec3 surface_point(const ProbeAngles& at) const override { return larger * of_->surface_point(at); }
  SolidDistance distance(const Vec3& x) const override
  {
    SolidDistance d = of_->distance(x);
    d.distance *= steeper;
    d.at_least += claimed;
    return d;
  }
  SolidSmoothness smoothness() const override { return reach ? of_->smoothness() : SolidSmoothness{}; }
  void distance_sizes(const Vec3& x, std::span<double> out) const override { of_->distance_sizes(x, out); }
  void probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const override
  {
    of_->probe_sizes(at, n, out);
  }
  std::vector<std::vector<Vec3>> cores() const override { return of_->cores(); }

  double wider = 1.0, shifted = 0.0, larger = 1.0, steeper = 1.0, claimed = 0.0;
  bool reach = true;

 private:
  std::shared_ptr<const Solid> of_;
};

/// Without a reach only that distances are 1-Lipschitz is left: bounds stay bounds, and the search ends.
TEST(Enclosure, WithoutAReachIsWiderAndHolds)
{
  const auto loose = std::make_shared<Changed>(std::make_shared<test::TorusSolid>(3.0, 0.5, 2));
  loose->reach = false;
  Primitive a;
  enter_solid(a, loose);
  const Primitive b = made<test::TorusSolid>(Place{Vec3(3.0, 0.0, 0.0), Mat3::Identity()}, 3.0, 0.5, 2);
  const Primitive above = made<Changed>(Place{Vec3(0.0, 0.0, 1.0), Mat3::Identity()}, loose);
  const Enclosure found = enclose(a, above, 1e-10, infinite);
  EXPECT_LE(found.least, 0.0);
  EXPECT_GE(found.least, -1e-2) << "two rings that touch along a circle";
  EXPECT_NEAR(found.found, 0.0, 1e-4);
  EXPECT_LT(enclose(a, b, 1e-10, infinite).found, -0.4) << "crossing";
}

TEST(Samples, FindWhatContradictsItself)
{
  const std::vector<std::shared_ptr<const Solid>> all{
      std::make_shared<Capsule>(4.0, 0.5), std::make_shared<test::TorusSolid>(3.0, 0.5, 1),
      std::make_shared<test::TorusSolid>(3.0, 0.5, 2),
      std::make_shared<kit::ImplicitSolid<test::Ellipsoid>>(std::vector{1.0, 2.0, 3.0}),
      std::make_shared<kit::ImplicitSolid<test::RoundedRing>>(std::vector{3.0, 0.5, 0.4})};
  for (const auto& solid : all) {
    EXPECT_EQ(disagreement(*solid, 1e-9), "") << solid->kind();
    const auto found = [&](const std::function<void(Changed&)>& change) {
      Changed changed(solid);
      change(changed);
      return disagreement(changed, 1e-9);
    };
    EXPECT_NE(found([](Changed& c) { c.larger = 1.0 + 1e-7; }), "") << solid->kind();
    EXPECT_NE(found([](Changed& c) { c.steeper = 1.0 + 1e-6; }), "") << solid->kind();
    EXPECT_NE(found([](Changed& c) { c.shifted = 1e-7; }), "") << solid->kind();
    EXPECT_NE(found([](Changed& c) { c.claimed = 10.0; }), "") << solid->kind();
    if (solid->probe_dimension() == 1) {
      EXPECT_NE(found([](Changed& c) { c.wider = 1.0 + 1e-6; }), "") << solid->kind();
    }
  }
}

/// The closest points of two struts, and of a ring and a strut through it, from a place beside them.
TEST(Touching, OfSolidsIsWhereTheyAreNearest)
{
  const Mat3 across = Eigen::AngleAxisd(0.5 * pi, Vec3::UnitX()).toRotationMatrix();
  const Primitive along_z = capsule(Place{}, 5.0, 0.5),
                  along_y = capsule({Vec3(1.5, 1.0, 2.0), across}, 4.0, 0.5);
  const Touching t = touching_near(along_z, along_y, {0.7, 0.3, 1.5});
  EXPECT_NEAR(t.distance, 0.5, 1e-14);
  EXPECT_NEAR((t.on_a - Vec3(0.5, 0.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((t.on_b - Vec3(1.0, 0.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((t.normal - Vec3::UnitX()).norm(), 0.0, 1e-12);
  const Primitive ring = made<test::TorusSolid>(Place{}, 3.0, 0.4, 2);
  const Primitive strut = capsule({Vec3(2.0, 0.0, 0.0), Mat3::Identity()}, 5.0, 0.5);
  for (const auto& [a, b] : {std::pair(ring, strut), std::pair(strut, ring)}) {
    const std::vector<Touching> all = touchings(a, b, 0.2);
    ASSERT_FALSE(all.empty());
    for (const Touching& s : all) EXPECT_NEAR(s.distance, 0.1, 1e-12);
  }
}

/// A square of struts whose corners are at (+-half, +-half).
std::vector<Primitive> square(double half, double reach)
{
  const Mat3 x = Eigen::AngleAxisd(0.5 * pi, Vec3::UnitY()).toRotationMatrix();
  const Mat3 y = Eigen::AngleAxisd(0.5 * pi, Vec3::UnitX()).toRotationMatrix();
  return {capsule({Vec3(0, half, 0), x}, reach, 0.5), capsule({Vec3(0, -half, 0), x}, reach, 0.5),
          capsule({Vec3(half, 0, 0), y}, reach, 0.5), capsule({Vec3(-half, 0, 0), y}, reach, 0.5)};
}

TEST(StrutLoops, OfASquareIsOneThatARingIsLinkedWith)
{
  EXPECT_EQ(overlaps(square(5, 5)[0], square(5, 5)[2]).size(), 1U);
  EXPECT_EQ(overlaps(square(5, 5)[0], square(5, 5)[1]).size(), 0U);
  EXPECT_EQ(loops_together(square(5, 5)).size(), 1U);
  EXPECT_EQ(loops_together(square(5, 4.4)).size(), 1U) << "ends that overlap beside each other";
  EXPECT_EQ(loops_together(square(5, 3.9)).size(), 0U) << "corners that do not close";
  EXPECT_EQ(loops_together(square(5, 6)).size(), 1U) << "struts that cross";

  Scene scene;
  scene.length = 5.0;
  scene.elements.resize(2);
  scene.elements[0].tori = square(5, 5);
  scene.elements[0].reach = 10.0;
  scene.elements[1].tori = {torus(Place{}, 2.0, 0.3, 0.3)};
  scene.elements[1].reach = 2.5;
  find_loops(scene);
  const auto linked = [&](const Vec3& at, const Mat3& turn) {
    const std::vector<Link> found = links(scene, {Place{}, Place{at, turn}}, Mat3::Identity());
    return found.size() == 1 ? std::abs(found[0].number) : 0;
  };
  const Mat3 upright = Eigen::AngleAxisd(0.5 * pi, Vec3::UnitX()).toRotationMatrix();
  EXPECT_EQ(linked({5, 0, 0}, upright), 1);
  EXPECT_EQ(linked({5, 0, 1.5}, Mat3::Identity()), 0) << "flat, above it";
  EXPECT_EQ(linked({0, 0, 0}, upright), 0) << "through the middle, without a strut";
  // A solid ring is linked as a ring is.
  scene.elements[1].tori = {made<test::TorusSolid>(Place{}, 2.0, 0.3, 2)};
  EXPECT_EQ(linked({5, 0, 0}, upright), 1);
  EXPECT_EQ(linked({0, 0, 0}, upright), 0);
}

}  // namespace
}  // namespace hauberk::verification
