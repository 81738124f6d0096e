// Limits with the published contact: the exact chains, and a fabric whose contacts merge.

#include "limit_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hauberk::brute {
namespace {

using Size = std::array<double, 3>;

LimitSettings published_settings()
{
  LimitSettings s;
  s.contact = ContactChoice::published;
  return s;
}

TEST(PublishedLimits, StagedChainsLockAtTheExactPeriod)
{
  struct Chain {
    Size a, b;
    double last;
  };
  for (const auto& [a, b, last] : std::vector<Chain>{{{5, 0.7, 0.7}, {5, 0.7, 0.7}, 2e-9},
                                                     {{5, 0.7, 0.7}, {4, 0.5, 0.5}, 2e-9},
                                                     {{5, 0.7, 0.9}, {5, 0.7, 0.9}, 1e-5}}) {
    const SceneSpec scene = slack_chain(a, b);
    const double exact = 2.0 * (a[0] + b[0] - a[1] - b[1]) / scene.lattice[0].x();
    LimitSettings settings = published_settings();
    settings.schedule.last = last;
    settings.starts = 8;  // the fade holds up to four of sixteen starts before they balance
    const LimitResult r = limit(scene, 0.0, Sense::positive, settings);
    ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
    EXPECT_EQ(r.contact, "published");
    const double error = (1.0 + *r.value) / exact - 1.0;
    fmt::print("published chain ({}, {}, {}): relative error {:.1e}, {} steps, {:.3f} s\n", a[0], a[1], a[2],
               error, r.iterations, r.seconds);
    EXPECT_NEAR(error, 0.0, last);
    EXPECT_LT(error, 0.0);
    EXPECT_LT(*r.force_balance, 1e-4);
  }
}

/// Contacts of a 4-in-1 chainmail merge on the way: the fade carries the steps through, and the locked states
/// are those of the other formulations but for the gaps at the last activation distance.
TEST(PublishedLimits, ChainmailLocksWhereTheOtherFormulationsDo)
{
  for (const double theta : {0.0, 30.0, 90.0}) {
    for (const Sense sense : {Sense::positive, Sense::negative}) {
      LimitSettings settings = published_settings();
      settings.schedule.first = 1e-2;  // from 0.03 L one of the six stalls in the valleys of the fade
      settings.schedule.last = 1e-4;
      const LimitResult published = limit(test::chainmail(1, 1), theta, sense, settings);
      settings.contact = ContactChoice::automatic;
      const LimitResult other = limit(test::chainmail(1, 1), theta, sense, settings);
      ASSERT_EQ(published.status, LimitStatus::locked) << published.message;
      ASSERT_EQ(other.status, LimitStatus::locked) << other.message;
      EXPECT_NEAR(*published.value, *other.value, 3.0 * settings.schedule.last) << theta;
    }
  }
}

/// Equation (12): the finite target holds back strains that carry no load, so the value can only be smaller;
/// it tends to that of the load alone as the target grows.
TEST(PublishedLimits, AFiniteTargetHoldsBackFreeStrains)
{
  LimitSettings settings;
  settings.contact = ContactChoice::arc;  // nearest leaves other gaps, and which of the two ends may vary
  settings.schedule.last = 1e-4;
  const SceneSpec scene = test::chainmail(1, 1);
  const LimitResult free = limit(scene, 90.0, Sense::positive, settings);
  ASSERT_EQ(free.status, LimitStatus::locked) << free.message;
  EXPECT_FALSE(free.finite_target.has_value());
  const auto norm = [](const LimitResult& r) {
    double n = 0.0;
    for (const auto& [name, x] : r.macro) n += x * x;
    return std::sqrt(n);
  };
  double before = 0.0;
  for (const double target : {0.2, 1.0, 1e4}) {
    settings.schedule.target = target;
    const LimitResult held = limit(scene, 90.0, Sense::positive, settings);
    ASSERT_EQ(held.status, LimitStatus::locked) << held.message;
    EXPECT_EQ(held.finite_target, target);
    EXPECT_LT(*held.force_balance, 1e-4);  // of the load less macro/target
    fmt::print("target {:g}: value {:.6f}, strain {:.6f}; load alone {:.6f}, {:.6f}\n", target, *held.value,
               norm(held), *free.value, norm(free));
    EXPECT_GT(*held.value, before);
    EXPECT_LT(*held.value, *free.value + 1e-9);
    EXPECT_LT(norm(held), norm(free) + 1e-6);
    before = *held.value;
  }
  EXPECT_NEAR(before, *free.value, 1e-6);

  // Within reach it is no limit, and that is said.
  settings.schedule.target = 0.05;
  const LimitResult reached = limit(scene, 90.0, Sense::positive, settings);
  EXPECT_EQ(reached.status, LimitStatus::failed);
  EXPECT_NE(reached.message.find("finite target 0.05 is reached"), std::string::npos) << reached.message;
}

/// With the paper's own searches: same chain, same period; the links are checked at the end.
TEST(PublishedLimits, SampledSearchesLockTheChain)
{
  const SceneSpec scene = slack_chain({5, 0.7, 0.7}, {4, 0.5, 0.6});
  LimitSettings settings = published_settings();
  settings.schedule.last = 1e-4;
  const LimitResult certified = limit(scene, 0.0, Sense::positive, settings);
  settings.schedule.search = MinimaSearch::sampled;
  settings.schedule.ccd = CollisionCheck::sampled;
  const LimitResult sampled = limit(scene, 0.0, Sense::positive, settings);
  ASSERT_EQ(certified.status, LimitStatus::locked) << certified.message;
  ASSERT_EQ(sampled.status, LimitStatus::locked) << sampled.message;
  EXPECT_TRUE(sampled.links_kept);
  EXPECT_NEAR(*sampled.value, *certified.value, 1e-9);
  EXPECT_EQ(certified.certificate.find("nothing certified"), std::string::npos);
  EXPECT_NE(sampled.certificate.find("nothing certified"), std::string::npos);
  fmt::print("sampled searches: {} steps, {:.3f} s; certified: {} steps, {:.3f} s\n", sampled.iterations,
             sampled.seconds, certified.iterations, certified.seconds);
}

}  // namespace
}  // namespace hauberk::brute
