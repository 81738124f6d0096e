#pragma once
/// A chart that was run once, for the tests that look at it.

#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/value.hpp>

#include <memory>
#include <string>

namespace hauberk::test {

/// Of chart_text().
inline constexpr std::size_t point_count = 14;

inline const boost::json::value& point(const boost::json::value& results, std::size_t k)
{
  return results.at_pointer("/chart/points").as_array().at(k);
}

inline std::string text(const boost::json::value& v) { return std::string(v.as_string()); }

/// Is `part` in `whole`?
inline ::testing::AssertionResult holds(const std::string& whole, const std::string& part)
{
  if (whole.find(part) != std::string::npos) return testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << part << "' is not in\n" << whole;
}

/// Results of one run that tests look at.
class ChartFixture : public ::testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    folder_ = std::make_unique<WorkFolder>();
    outcome_ = run_program({"run", folder_->write("c.json", chart_text()), "-o", *folder_ / "out"});
    results_ = read_results(*folder_ / "out");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static inline std::unique_ptr<WorkFolder> folder_;
  static inline Outcome outcome_;
  static inline boost::json::value results_;
};

}  // namespace hauberk::test
