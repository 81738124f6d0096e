/// Comparing results with what an experiment expects.

#include <hauberk/experiment/expect.hpp>

#include <gtest/gtest.h>
#include <boost/json/parse.hpp>

namespace hauberk {
namespace {

Expectation expectation(const std::string& pointer, std::optional<boost::json::value> value = {})
{
  Expectation e;
  e.pointer = pointer;
  e.value = std::move(value);
  return e;
}

/// The failure of one expectation against fixed results, "" when it is met.
std::string failure(const Expectation& expected)
{
  static const boost::json::value results = boost::json::parse(
      R"({ "limits": [ { "value": 0.4334, "status": "locked", "infimum": null, "iterations": 12, "poses": [1, 2] } ] })");
  const auto failures = evaluate_expectations({expected}, results);
  return failures.empty() ? "" : failures[0].text();
}

TEST(Expect, RelativeAndAbsoluteMargins)
{
  Expectation e = expectation("/limits/0/value", 0.4333);
  EXPECT_EQ(failure(e), "/limits/0/value: expected 0.4333, found 0.4334");
  e.rel = 1e-3;
  EXPECT_EQ(failure(e), "");
  e.rel = 1e-8;
  EXPECT_EQ(failure(e), "/limits/0/value: expected 0.4333 within 1e-08 relative, found 0.4334");
  e.abs = 1e-5;
  EXPECT_EQ(failure(e),
            "/limits/0/value: expected 0.4333 within 1e-08 relative or 1e-05 absolute, found 0.4334");
  e.abs = 2e-4;
  EXPECT_EQ(failure(e), "");
  e.rel.reset();
  e.abs = 1e-5;
  EXPECT_EQ(failure(e), "/limits/0/value: expected 0.4333 within 1e-05, found 0.4334");
}

TEST(Expect, Bounds)
{
  Expectation e = expectation("/limits/0/value");
  e.min = 0.4;
  EXPECT_EQ(failure(e), "");
  e.max = 0.42;
  EXPECT_EQ(failure(e), "/limits/0/value: expected >= 0.4 and <= 0.42, found 0.4334");
  e.min = 0.5;
  e.max.reset();
  EXPECT_EQ(failure(e), "/limits/0/value: expected >= 0.5, found 0.4334");
}

TEST(Expect, AnythingElseMustBeEqual)
{
  EXPECT_EQ(failure(expectation("/limits/0/status", "locked")), "");
  EXPECT_EQ(failure(expectation("/limits/0/status", "stalled")),
            "/limits/0/status: expected \"stalled\", found \"locked\"");
  EXPECT_EQ(failure(expectation("/limits/0/infimum", boost::json::value(nullptr))), "");
  EXPECT_EQ(failure(expectation("/limits/0/iterations", 12.0)), "");
  EXPECT_EQ(failure(expectation("/limits/0/poses", boost::json::array{1, 3})),
            "/limits/0/poses: expected [1,3], found [1,2]");
}

TEST(Expect, MissingAndNullAreFailures)
{
  EXPECT_EQ(failure(expectation("/limits/1/value", 1.0)), "/limits/1/value: expected 1, found nothing there");
  EXPECT_EQ(failure(expectation("/limits/0/infimum", 1.0)), "/limits/0/infimum: expected 1, found null");
  Expectation e = expectation("/limits/0/status");
  e.max = 1.0;
  EXPECT_EQ(failure(e), "/limits/0/status: expected <= 1, found \"locked\"");
}

TEST(Expect, ReportsEveryFailureInOrder)
{
  const boost::json::value results = {{"a", 1}, {"b", 2}};
  const auto failures =
      evaluate_expectations({expectation("/b", 3), expectation("/a", 1), expectation("/c", 0)}, results);
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_EQ(failures[0].pointer, "/b");
  EXPECT_EQ(failures[1].pointer, "/c");
}

}  // namespace
}  // namespace hauberk
