// Limits do not depend on the unit of length, on the frame, or on the number of threads.

#include "limit_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hauberk::brute {
namespace {

std::vector<LimitTask> tasks(double turned_by)
{
  std::vector<LimitTask> list;
  for (const double direction : {0.0, 30.0, 60.0, 90.0}) {
    for (const Sense sense : {Sense::positive, Sense::negative})
      list.push_back({Direction::at_degrees(direction + turned_by), sense});
  }
  return list;
}

TEST(Invariance, UnitsAndTurnsLeaveTheStrains)
{
  const SceneSpec scene = test::chainmail(1, 1);
  const std::vector<LimitResult> base = limits(scene, tasks(0.0));
  double unit_worst = 0.0, turn_worst = 0.0;
  const auto compare = [&](const std::vector<LimitResult>& r, const std::string& what, double& worst) {
    for (std::size_t k = 0; k < base.size(); ++k) {
      ASSERT_EQ(base[k].status, LimitStatus::locked) << base[k].message;
      ASSERT_EQ(r[k].status, LimitStatus::locked) << what << ": " << r[k].message;
      worst = std::max(worst, std::abs(*r[k].value - *base[k].value));
      EXPECT_NEAR(*r[k].value, *base[k].value, 1e-9)
          << what << ", direction " << base[k].direction.text() << ' ' << base[k].sense;
    }
  };
  for (const double unit : {1e-3, 1e3}) {  // the scene is in mm: m, um
    compare(limits(test::scaled_and_turned(scene, unit, 0.0), tasks(0.0)), fmt::format("unit {}", unit),
            unit_worst);
  }
  for (const double angle : {17.0, 45.0, 101.3}) {
    compare(limits(test::scaled_and_turned(scene, 1.0, angle * degree), tasks(angle)),
            fmt::format("turned by {}", angle), turn_worst);
  }
  fmt::print("chainmail, 8 limits: largest difference between units {:.1e}, between frames {:.1e}\n",
             unit_worst, turn_worst);
}

TEST(Invariance, ThreadsChangeNoBit)
{
  const SceneSpec scene = test::chainmail(1, 1);
  LimitSettings settings;
  settings.starts = 2;
  const std::vector<LimitResult> one = limits(scene, tasks(0.0), settings, 0.0, 1);
  for (const unsigned threads : {2U, 5U}) {
    const std::vector<LimitResult> many = limits(scene, tasks(0.0), settings, 0.0, threads);
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(*many[k].value, *one[k].value);
      EXPECT_EQ(many[k].macro, one[k].macro);
      EXPECT_EQ(many[k].iterations, one[k].iterations);
      EXPECT_EQ(many[k].evaluations, one[k].evaluations);
      EXPECT_EQ(many[k].sensitivity_parameters, one[k].sensitivity_parameters);
      EXPECT_EQ(*many[k].force_balance, *one[k].force_balance);
      ASSERT_EQ(many[k].contacts.size(), one[k].contacts.size());
      for (std::size_t c = 0; c < one[k].contacts.size(); ++c) {
        EXPECT_EQ(many[k].contacts[c].gap, one[k].contacts[c].gap);
        EXPECT_EQ(many[k].contacts[c].force, one[k].contacts[c].force);
      }
      ASSERT_EQ(many[k].starts.size(), one[k].starts.size());
      for (std::size_t c = 0; c < one[k].starts.size(); ++c)
        EXPECT_EQ(many[k].starts[c].value, one[k].starts[c].value);
    }
  }
}

}  // namespace
}  // namespace hauberk::brute
