/// Outcomes of claims that are right, short, honest and wrong.

#include "tasks/stability/classify.hpp"

#include "tasks/stability/independent_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace hauberk {
namespace {

/// A checked locked state of scene 0.
StabilityCase locked(double value)
{
  StabilityCase c;
  c.sense = "stretch";
  c.status = "locked";
  c.value = value;
  c.checked = true;
  return c;
}

StabilityCase with_status(const char* status, const char* message)
{
  StabilityCase c = locked(0.0);
  c.status = status;
  c.message = message;
  c.value.reset();
  return c;
}

std::vector<StabilityCase> classified(std::vector<StabilityCase> cases)
{
  StabilityMap map;
  map.tolerance = 1e-6;
  map.methods = {"m"};
  map.families = {{"f", "", {"a"}, true}};
  map.cases = std::move(cases);
  classify(map);
  return map.cases;
}

StabilityCase only(const StabilityCase& c) { return classified({c}).front(); }

TEST(Classify, ALockedStateThatIsCheckedAndUnsurpassedIsVerified)
{
  const StabilityCase c = only(locked(0.4));
  EXPECT_EQ(c.outcome, Outcome::verified);
  EXPECT_EQ(c.reason, "");
  EXPECT_EQ(c.best_known, 0.4);
}

TEST(Classify, BelowTheBestKnownIsLocal)
{
  const auto cases = classified({locked(0.4), locked(0.4001), locked(0.4001 - 1.3e-6)});
  EXPECT_EQ(cases[0].outcome, Outcome::local);
  EXPECT_EQ(cases[0].reason, "0.4 falls short of the best known 0.4001 by 0.0001");
  EXPECT_EQ(cases[1].outcome, Outcome::verified);
  EXPECT_EQ(cases[2].outcome, Outcome::verified) << "within 1e-6 of 1 + value";
}

TEST(Classify, CompressionIsFurtherDownwards)
{
  StabilityCase less = locked(-0.1), more = locked(-0.2);
  less.sense = more.sense = "compress";
  less.upward = more.upward = false;
  const auto cases = classified({less, more});
  EXPECT_EQ(cases[0].outcome, Outcome::local);
  EXPECT_EQ(cases[1].outcome, Outcome::verified);
}

TEST(Classify, StatesOfOtherScenesDirectionsAndSensesDoNotCount)
{
  StabilityCase scene = locked(0.9), direction = locked(0.9), sense = locked(0.9);
  scene.scene = 1;
  direction.direction = Direction::at_degrees(30.0);
  sense.sense = "compress";
  EXPECT_EQ(classified({locked(0.4), scene, direction, sense})[0].outcome, Outcome::verified);
}

TEST(Classify, WrongStatesAreNotTheBestKnown)
{
  StabilityCase wrong = locked(0.9);
  wrong.checked = false;
  wrong.check = "surfaces are 0.1 closer than the clearance";
  const auto cases = classified({wrong, locked(0.4)});
  EXPECT_EQ(cases[0].outcome, Outcome::silent_wrong);
  EXPECT_EQ(cases[0].reason, "surfaces are 0.1 closer than the clearance");
  EXPECT_EQ(cases[1].outcome, Outcome::verified);
}

TEST(Classify, WhatClosingItsGapsWouldGainIsNotAnotherState)
{
  StabilityCase loose = locked(0.39), tight = locked(0.4);
  EXPECT_EQ(classified({loose, tight})[0].outcome, Outcome::local);
  loose.slack = 0.004;
  EXPECT_EQ(classified({loose, tight})[0].outcome, Outcome::verified);
  loose.slack = 0.003;
  EXPECT_EQ(classified({loose, tight})[0].outcome, Outcome::local);
}

TEST(Classify, ExactValuesJudgeBothWays)
{
  StabilityCase c = locked(0.4);
  c.exact = 0.5;
  EXPECT_EQ(only(c).outcome, Outcome::local);
  EXPECT_EQ(only(c).best_known, 0.5);
  c.exact = 0.4 + 1e-7;
  EXPECT_EQ(only(c).outcome, Outcome::verified);
  c.exact = 0.39;
  EXPECT_EQ(only(c).outcome, Outcome::silent_wrong);
  EXPECT_EQ(only(c).reason, "0.4 is further than the exact 0.39 by 0.01");
}

TEST(Classify, FailuresThatSaySoAreHonest)
{
  for (const char* status : {"refused", "stalled", "failed"}) {
    const StabilityCase c = only(with_status(status, "no room"));
    EXPECT_EQ(c.outcome, Outcome::honest_failure);
    EXPECT_EQ(c.reason, std::string(status) + ": no room");
  }
  EXPECT_EQ(only(with_status("interrupted", "")).outcome, Outcome::interrupted);
}

TEST(Classify, NoLimitIsRightOnlyWhereThereIsNone)
{
  for (const char* status : {"unbounded", "not_attained"}) {
    StabilityCase c = with_status(status, "");
    EXPECT_EQ(only(c).outcome, Outcome::silent_wrong);
    c.solvable = false;
    EXPECT_EQ(only(c).outcome, Outcome::verified);
  }
  StabilityCase invented = locked(0.3);
  invented.solvable = false;
  EXPECT_EQ(only(invented).outcome, Outcome::silent_wrong);
  EXPECT_EQ(only(invented).reason, "claims 0.3 where nothing holds");
}

TEST(Classify, ALockedStateNeedsAValue)
{
  StabilityCase c = locked(0.0);
  c.value.reset();
  EXPECT_EQ(only(c).outcome, Outcome::silent_wrong);
  c.value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(only(c).outcome, Outcome::silent_wrong);
}

TEST(Classify, OrderDoesNotMatter)
{
  std::vector<StabilityCase> cases{locked(0.4), locked(0.5), with_status("stalled", "x"), locked(0.45)};
  cases[1].checked = false;
  const auto forward = classified(cases);
  std::reverse(cases.begin(), cases.end());
  auto backward = classified(cases);
  std::reverse(backward.begin(), backward.end());
  for (std::size_t k = 0; k < cases.size(); ++k) {
    EXPECT_EQ(forward[k].outcome, backward[k].outcome);
    EXPECT_EQ(forward[k].reason, backward[k].reason);
    EXPECT_EQ(forward[k].best_known, backward[k].best_known);
  }
}

TEST(Claim, SlackIsTheSumOfForceTimesGap)
{
  LimitResult limit;
  limit.status = LimitStatus::locked;
  limit.value = 0.3;
  limit.contacts.resize(2);
  limit.contacts[0].force = 2.0;
  limit.contacts[0].gap = 1e-3;
  limit.contacts[1].force = 0.5;
  limit.contacts[1].gap = 4e-3;
  StabilityCase c;
  enter_claim(c, limit, {false, "what is wrong"});
  EXPECT_DOUBLE_EQ(c.slack, 4e-3);
  EXPECT_EQ(c.status, "locked");
  EXPECT_FALSE(c.checked);
  EXPECT_EQ(c.check, "what is wrong");
}

}  // namespace
}  // namespace hauberk
