#pragma once
/// Expected results, written in the experiment: an example is a test.

#include <boost/json/value.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// One entry of `expect`.
struct Expectation {
  std::string pointer;  ///< into results.json
  std::optional<boost::json::value> value;
  std::optional<double> rel, abs;  ///< allowed deviations from a number; the larger one counts
  std::optional<double> min, max;

  /// "0.43333333 within 1e-8 relative", ">= 0.1", "\"locked\"".
  std::string describe() const;
};

/// An expectation that the results do not meet.
struct ExpectationFailure {
  std::string pointer;
  std::string expected;
  std::string found;  ///< "0.44", "null", "nothing there"

  /// "/limits/0/value: expected 0.43333333 within 1e-8 relative, found 0.44".
  std::string text() const;
};

/// Those of `expectations` that `results` does not meet, in order. Thread safe.
std::vector<ExpectationFailure> evaluate_expectations(const std::vector<Expectation>& expectations,
                                                      const boost::json::value& results);

}  // namespace hauberk
