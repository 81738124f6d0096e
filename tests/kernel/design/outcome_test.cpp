/// What a design reports once its limits are recomputed.

#include "design/design.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

struct Case {
  std::vector<double> recomputed;  ///< of targets of 0.1; not locked where it is 0
  const char* message;
};

class RecomputedTargets : public ::testing::TestWithParam<Case> {};

/// A search that met its targets by provisional limits says so only of those that are still met.
TEST_P(RecomputedTargets, SayWhatTheSearchMissed)
{
  DesignSpec design;
  design.quantity = DesignQuantity::positive;
  design.tolerance = 0.01;
  DesignResult result;
  result.status = "targets_met";
  std::vector<LimitResult> limits;
  for (const double value : GetParam().recomputed) {
    const double degrees = 30.0 * static_cast<double>(limits.size());
    design.targets.push_back({degrees, 0.1, 1.0});
    DesignTargetResult target;
    target.direction_deg = degrees;
    target.target = 0.1;
    result.targets.push_back(target);
    LimitResult limit;
    if (value != 0.0) {
      limit.status = LimitStatus::locked;
      limit.value = value;
    }
    limits.push_back(limit);
  }
  finish_design(result, design, limits, limits);
  EXPECT_EQ(result.message, GetParam().message);
  EXPECT_EQ(result.status, "targets_met") << "how the search ended";
}

INSTANTIATE_TEST_SUITE_P(Designs, RecomputedTargets,
                         ::testing::Values(Case{{0.1009, 0.0991},
                                                "every target is met to within design.tolerance"},
                                           Case{{0.1031, 0.1, 0.1},
                                                "the search met every target to within design.tolerance; "
                                                "recomputed, 1 of 3 is off by more, up to 3.1 %"},
                                           Case{{0.1031, 0.096},
                                                "the search met every target to within design.tolerance; "
                                                "recomputed, 2 of 2 are off by more, up to 4.0 %"},
                                           Case{{0.1, 0.0},
                                                "the search met every target to within design.tolerance; "
                                                "recomputed, 1 of 2 is off by more, up to no limit at all"}));

}  // namespace
}  // namespace hauberk::test
