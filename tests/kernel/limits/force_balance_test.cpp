/// Forces whose gaps are so small that rounding shows.

#include "limits/force_balance.hpp"
#include "equilibrium/locking.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
  std::optional<Vector> missing() const
  {
    return rounding_of_forces(model, locked.state, pull, contacts.points, locked.stage.mu);
  }
};

TEST(RoundingOfForces, IsTheLeastThatBalances)
{
  PulledSheet sheet;
  ASSERT_EQ(sheet.locked.status, LockStatus::locked) << sheet.locked.message;
  ASSERT_GE(sheet.contacts.points.size(), 4U);
  double tightest = 1.0;
  for (const ContactEnergy::Point& p : sheet.contacts.points) tightest = std::min(tightest, p.contact.gap);
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> wrong(-0.02, 0.02);
  double size = 0.0;  // of the errors, each by how exact it is
  for (ContactEnergy::Point& p : sheet.contacts.points) {
    const double error = wrong(rng);
    size += error * error;
    p.contact.force *= 1.0 + error * tightest / p.contact.gap;
  }
  const double before = sheet.imbalance();
  EXPECT_GT(before, 1e-3);
  const std::optional<Vector> parts = sheet.missing();
  ASSERT_TRUE(parts);
  double found = 0.0;
  for (std::size_t k = 0; k < sheet.contacts.points.size(); ++k) {
    const double part =
        (*parts)[static_cast<Eigen::Index>(k)] * sheet.contacts.points[k].contact.gap / tightest;
    found += part * part;
  }
  change_forces(sheet.contacts, sheet.model, sheet.locked.state, *parts);
  EXPECT_LT(sheet.imbalance(), 1e-7);
  // Undoing the errors is one way to balance the forces, but for what they were off by themselves.
  EXPECT_LT(std::sqrt(found), 1.01 * std::sqrt(size));
}

TEST(RoundingOfForces, IsNoneOfForcesThatAreWrong)
{
  PulledSheet sheet;
  ASSERT_TRUE(sheet.missing());
  for (ContactEnergy::Point& p : sheet.contacts.points) p.contact.force *= 1.25;
  EXPECT_FALSE(sheet.missing());
}

TEST(RoundingOfForces, ChangesDerivativesAsForces)
{
  PulledSheet sheet;
  const ContactEnergy before = sheet.contacts;
  const double part = 0.25;
  change_forces(sheet.contacts, sheet.model, sheet.locked.state,
                Vector::Constant(static_cast<Eigen::Index>(before.points.size()), part));
  EXPECT_NEAR(sheet.contacts.d_clearance, (1.0 + part) * before.d_clearance, 1e-12 * before.d_clearance);
  const double size = before.parameters.cwiseAbs().maxCoeff();
  EXPECT_LT((sheet.contacts.parameters - (1.0 + part) * before.parameters).cwiseAbs().maxCoeff(),
            1e-7 * size);
}

}  // namespace
}  // namespace hauberk::test
