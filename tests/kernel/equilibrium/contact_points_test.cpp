/// What `arc` lists as contacts: resultants of zones, which must be on both surfaces and must stand for the
/// gradient of the energy, also where a zone of contact bends around a tube.

#include "equilibrium/contact_energy.hpp"
#include "model/near_pairs.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace hauberk::test {
namespace {

/// A ring (R 5, r 0.7) and a bead threaded on it, its hole `room` wider than the tube; the bead is a little
/// off the middle, so that it touches all around, with more force on one side.
SceneSpec bead(double room)
{
  SceneSpec s;
  s.types.push_back({"ring", std::make_shared<Rings>()});
  const double quarter = 0.5 * std::numbers::pi;
  s.elements.push_back({0, {5.0, 0.7, 0.7}, {Vec3::Zero(), Mat3::Identity()}});
  s.elements.push_back({0,
                        {1.1 + room, 0.4, 0.4},
                        {Vec3(0.0, 5.0 + 0.3 * room, 0.2 * room), rotation_exp(Vec3(0.0, quarter, 0.0))}});
  s.lattice = {Vec3(100.0, 0, 0), Vec3(0, 100.0, 0)};
  s.length = 5.0;
  return s;
}

/// Signed distance to the surface of a round tube, file units.
double distance(const PlacedElement& ring, const Vec3& point)
{
  const Vec3 x = ring.rest.rotation.transpose() * (point - ring.rest.position);
  return std::hypot(std::hypot(x.x(), x.y()) - ring.parameters[0], x.z()) - ring.parameters[1];
}

TEST(ContactPoints, ResultantsOfABentZoneLieOnBothSurfacesAndBalanceTheGradient)
{
  const Sheet load(3);
  for (const double room : {0.02, 0.005, 0.001}) {
    const SceneSpec spec = bead(room);
    const Model m = make_model(spec, load, 0.0);
    const State s = rest_state(m);
    const ContactSettings settings{Formulation::arc, 2.0 * room / m.length, 0.0};
    Request request;
    request.order = 1;
    request.points = true;
    const ContactEnergy e = contact_energy(m, s, near_pairs(m, s, 0.1), settings, request);
    ASSERT_GT(e.energy, 0.0);
    // Zones are as wide as sqrt(r g): around the tube there is room for many.
    EXPECT_GT(e.points.size(), 8U) << room;
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    double total = 0.0;
    for (const ContactEnergy::Point& p : e.points) {
      ASSERT_EQ(p.a, 0);
      ASSERT_EQ(p.b, 1);
      EXPECT_LT(std::abs(distance(spec.elements[0], p.contact.on_p * m.length)), room) << room;
      EXPECT_LT(std::abs(distance(spec.elements[1], p.contact.on_f * m.length)), room) << room;
      const Vec3 f = p.contact.force * p.contact.normal;
      force += f;
      torque += (p.contact.on_f - m.rest[1].position).cross(f);
      total += p.contact.force;
    }
    // The second element is pushed by +f n: dE/dy = -f dg/dy.
    const Vec3 du = e.gradient.segment<3>(m.offset(1)), dw = e.gradient.segment<3>(m.offset(1) + 3);
    EXPECT_GT(du.norm(), 1e-2 * total) << "the bead is pushed to the middle";
    EXPECT_LT((du + force).norm(), 1e-3 * total) << room;
    EXPECT_LT((dw + torque).norm(), 1e-3 * total) << room;
  }
}

}  // namespace
}  // namespace hauberk::test
