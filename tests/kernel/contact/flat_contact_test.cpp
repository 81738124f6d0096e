/// Surfaces that are nearest to each other along whole curves or faces: one of these places is found at
/// least, with its distance, outside of each other and inside.

#include "contact/barrier.hpp"
#include "contact/formulation.hpp"
#include "geometry/separation.hpp"
#include "shapes/rounded_ring/rounded_ring.hpp"
#include "torus_solid.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

Body body_of(Primitive p)
{
  // As Shape::primitives does.
  if (p.solid) p.size = {p.solid->radius(), p.solid->thickness(), p.solid->thickness()};
  return make_body(p, 0, 0, 1.0);
}

Body torus(double R, double r0, double r1)
{
  Primitive p;
  p.kind = r0 == r1 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
  p.size = {R, r0, r1};
  return body_of(p);
}

Body flat_wire()
{
  Primitive p;
  p.kind = PrimitiveKind::solid;
  p.solid = std::make_shared<const kit::ImplicitSolid<RoundedRing>>(std::vector<double>{1.0, 0.3, 0.2, 0.1});
  return body_of(p);
}

/// The least distance that the search for minima finds within 0.5, `there` from the first body.
double nearest(const Body& a, const Body& b, const Pose& there)
{
  const PairFrame frame(a, {Vec3::Zero(), Mat3::Identity()}, b, there);
  int evaluations = 0;
  const std::vector<Minimum> found = probe_dimension(frame) == 1 ? local_minima<1>(frame, 0.5, evaluations)
                                                                 : local_minima<2>(frame, 0.5, evaluations);
  return found.empty() ? std::numeric_limits<double>::infinity() : found.front().distance;
}

/// Rings one above the other, apart by `gap` along their common axis, and turned about it.
double stacked(const Body& a, const Body& b, double heights, double gap)
{
  return nearest(a, b, {Vec3(0.0, 0.0, heights + gap), rotation_exp(Vec3(0.0, 0.0, 0.3))});
}

TEST(FlatContact, OfCoaxialRingsIsFound)
{
  for (const double gap : {0.1, 1e-3, 1e-6, 0.0, -1e-3}) {
    SCOPED_TRACE(gap);
    EXPECT_NEAR(stacked(torus(5, 0.7, 0.7), torus(5, 0.7, 0.7), 1.4, gap), gap, 1e-14);
    EXPECT_NEAR(stacked(torus(5, 0.7, 0.5), torus(5, 0.7, 0.5), 1.0, gap), gap, 1e-14);
    EXPECT_NEAR(stacked(torus(5, 0.7, 0.7), torus(5, 0.7, 0.5), 1.2, gap), gap, 1e-14);
    for (const int dimension : {1, 2}) {
      const Body solid = body_of(torus_solid(5.0, 0.7, dimension));
      EXPECT_NEAR(stacked(solid, solid, 1.4, gap), gap, 1e-13);
    }
  }
}

/// The energy of closest points is that of one place, however many panels have found one.
TEST(FlatContact, CountsOnceInTheEnergy)
{
  constexpr double gap = 0.05, g_hat = 0.2;
  const Body oval = torus(5, 0.7, 0.5);
  const Pose above{Vec3(0.0, 0.0, 1.0 + gap), Mat3::Identity()};
  const PairFrame frame(oval, {Vec3::Zero(), Mat3::Identity()}, oval, above);
  ContactSettings settings;
  settings.formulation = Formulation::nearest;
  settings.g_hat = g_hat;
  SideTerms terms;
  add_nearest<2>(frame, settings, {}, {}, terms);
  EXPECT_NEAR(terms.energy, barrier<0>(gap, g_hat).b, 1e-12);
  EXPECT_NEAR(terms.min_gap, gap, 1e-14);
}

TEST(FlatContact, OfFacesIsFound)
{
  const Body wire = flat_wire();
  for (const double gap : {1e-3, -0.05}) {
    SCOPED_TRACE(gap);
    EXPECT_NEAR(stacked(wire, wire, 0.4, gap), gap, 1e-13);
    // Moved aside the faces still lie upon each other where the rings cross.
    EXPECT_NEAR(nearest(wire, wire, {Vec3(0.7, 0.2, 0.4 + gap), Mat3::Identity()}), gap, 1e-13);
  }
  // Beyond the middle of the wire the deepest places are on a ridge of the distance.
  EXPECT_LT(nearest(wire, wire, {Vec3(0.7, 0.2, 0.4 - 0.25), Mat3::Identity()}), -0.19);
}

}  // namespace
}  // namespace hauberk::test
