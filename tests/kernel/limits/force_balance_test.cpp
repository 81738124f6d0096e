/// Forces whose gaps are so small that rounding shows.

#include "limits/force_balance.hpp"
#include "equilibrium/locking.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hauberk::test {
namespace {

/// A sheet of 4-in-1 pulled until it locks, and its contacts.
struct PulledSheet {
  Sheet load;
  Model model = make_model(chainmail(1, 1), load, 0.0);
  MacroLoad pull{load_vector(model, Direction(), Sense::positive)};
  Locked locked;
  ContactEnergy contacts;

  PulledSheet()
  {
    locked = lock(model, rest_state(model), pull, ContactChoice::automatic, Schedule(), [] { return true; });
    Request request;
    request.order = 1;
    request.parameters = request.points = true;
    contacts = contact_energy(model, locked.state, stage_pairs(model, locked.state, locked.stage),
                              locked.stage.contact, request);
  }

  double imbalance() const
  {
    return force_balance(model, locked.state, pull, contacts.points, locked.stage.mu).imbalance;
  }
  std::optional<Vector> parts() const
  {
    return balancing_parts(model, locked.state, pull, contacts.points, locked.stage.mu);
  }
  double rounding(std::size_t k) const { return rounding_of_x / contacts.points[k].contact.gap; }
};

TEST(BalancedForces, AreTheNearest)
{
  PulledSheet sheet;
  ASSERT_EQ(sheet.locked.status, LockStatus::locked) << sheet.locked.message;
  ASSERT_GE(sheet.contacts.points.size(), 4U);
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> wrong(-60.0, 60.0);
  double size = 0.0;  // of the errors, in roundings
  for (std::size_t k = 0; k < sheet.contacts.points.size(); ++k) {
    const double roundings = wrong(rng);
    size += roundings * roundings;
    sheet.contacts.points[k].contact.force *= 1.0 + roundings * sheet.rounding(k);
  }
  EXPECT_GT(sheet.imbalance(), 3e-5);
  const std::optional<Vector> parts = sheet.parts();
  ASSERT_TRUE(parts);
  double found = 0.0;
  for (std::size_t k = 0; k < sheet.contacts.points.size(); ++k) {
    const double roundings = (*parts)[k] / sheet.rounding(k);
    found += roundings * roundings;
  }
  ASSERT_TRUE(change_forces(sheet.contacts, sheet.model, sheet.locked.state, Formulation::nearest, *parts));
  EXPECT_LT(sheet.imbalance(), 1e-8);
  // Undoing the errors is one way to balance the forces, but for what they were off by themselves. Twelve
  // forces have fewer conditions to keep: what cancels in these is left.
  EXPECT_LT(std::sqrt(found), 0.98 * std::sqrt(size));
}

TEST(BalancedForces, AreNoneWhereRoundingExplainsNothing)
{
  PulledSheet sheet;
  ASSERT_TRUE(sheet.parts());
  for (std::size_t k = 0; k < sheet.contacts.points.size(); ++k)
    sheet.contacts.points[k].contact.force *= 1.0 + 400.0 * sheet.rounding(k);
  EXPECT_FALSE(sheet.parts());
}

TEST(BalancedForces, AreOfGapsThatTheStateHas)
{
  PulledSheet sheet;
  sheet.contacts.points[0].contact.normal = -sheet.contacts.points[0].contact.normal;
  const ContactEnergy before = sheet.contacts;
  const Vector parts = Vector::Constant(static_cast<Eigen::Index>(before.points.size()), 0.25);
  EXPECT_FALSE(change_forces(sheet.contacts, sheet.model, sheet.locked.state, Formulation::nearest, parts));
  EXPECT_EQ(sheet.contacts.points[1].contact.force, before.points[1].contact.force);
  EXPECT_EQ(sheet.contacts.d_clearance, before.d_clearance);
}

TEST(BalancedForces, TakeDerivativesAlong)
{
  PulledSheet sheet;
  const ContactEnergy before = sheet.contacts;
  const double part = 0.25;
  ASSERT_TRUE(change_forces(sheet.contacts, sheet.model, sheet.locked.state, Formulation::nearest,
                            Vector::Constant(static_cast<Eigen::Index>(before.points.size()), part)));
  EXPECT_NEAR(sheet.contacts.d_clearance, (1.0 + part) * before.d_clearance, 1e-12 * before.d_clearance);
  const double size = before.parameters.cwiseAbs().maxCoeff();
  EXPECT_LT((sheet.contacts.parameters - (1.0 + part) * before.parameters).cwiseAbs().maxCoeff(),
            1e-7 * size);
}

}  // namespace
}  // namespace hauberk::test
