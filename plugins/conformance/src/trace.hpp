#pragma once
/// Everything that an object answers, as one list of numbers.

#include "trial.hpp"

#include <string>
#include <vector>

namespace hauberk::conformance {

/// Arguments for every method of an object; the same for the same seed.
class Exercise {
 public:
  Exercise(const Object& object, Trial& trial);
  /// Calls every method with these arguments and lists what came back. Thread safe where the object is.
  std::vector<double> operator()(const Object& object) const;
  /// The same list, asked for from the last arguments to the first.
  std::vector<double> backwards(const Object& object) const;

 private:
  std::vector<double> all(const Object& object, bool reversed) const;

  std::vector<Point> points_;  ///< of shapes
  struct State {
    std::vector<double> macro, step, e, de;
    Vec3 X, T;
    double theta;
  };
  static void trace_state(const LoadCase& load_case, const State& s, const std::vector<Vec3>& cycles,
                          std::vector<double>& out);
  std::vector<State> states_;  ///< of load cases
};

/// Whether two lists agree to the bit; not-a-numbers of the same bits are equal.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b);
/// "answer 3 of 12 is 1 and then 2": the first difference.
std::string first_difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace hauberk::conformance
