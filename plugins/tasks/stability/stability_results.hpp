#pragma once
/// What a stability experiment found: families of scenes times methods, every case with its outcome.

#include <hauberk/direction.hpp>

#include <boost/json/object.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// In the order of concern.
enum class Outcome {
  verified,        ///< claims an answer, passes the independent check, nothing further is known
  local,           ///< passes the check, but a further locked state is known
  honest_failure,  ///< says that it has no answer
  silent_wrong,    ///< claims an answer that the check, or what is known exactly, contradicts
  interrupted      ///< not computed
};
inline constexpr std::array outcomes{Outcome::verified, Outcome::local, Outcome::honest_failure,
                                     Outcome::silent_wrong, Outcome::interrupted};
/// "verified", "local", "honest_failure", "silent_wrong", "interrupted".
std::string to_string(Outcome outcome);

/// One limit of one member by one method. An input that is refused is a case without direction and sense.
struct StabilityCase {
  std::size_t family = 0, member = 0, method = 0;
  Direction direction;
  std::string sense;
  bool upward = true;   ///< a larger value is further
  std::string status;   ///< of the limit, or "refused"
  std::string message;  ///< that came with it
  std::string contact;  ///< formulation that finished
  std::optional<double> value, min_gap, error_estimate, force_balance;
  double slack = 0.0;     ///< what closing the gaps that are left would gain: sum of force times gap
  bool checked = false;   ///< the independent check found nothing wrong
  std::string check;      ///< what it said
  std::size_t scene = 0;  ///< cases of the same scene and load have the same number
  bool solvable = true;   ///< there is a locked state to find
  std::optional<double> exact, best_known;
  Outcome outcome = Outcome::interrupted;
  std::string reason;  ///< why it is no `verified`
  int iterations = 0;
  long evaluations = 0;
  double seconds = 0.0;
};

struct StabilityFamilyResult {
  std::string name, why;
  std::vector<std::string> labels;  ///< of the members
  bool solvable = true;
};

struct StabilityMap {
  double tolerance = 0.0;
  std::vector<std::string> methods;
  std::vector<StabilityFamilyResult> families;
  std::vector<StabilityCase> cases;  ///< by family, member, method, limit
};

/// How often each outcome occurs, in the order of `outcomes`.
using OutcomeCounts = std::array<int, outcomes.size()>;
/// Over the cases of a family and a method; null: of all.
OutcomeCounts count_outcomes(const StabilityMap& map, std::optional<std::size_t> family,
                             std::optional<std::size_t> method);

/// The most worrying outcome among the cases of one member by one method; interrupted when there is none.
Outcome worst_outcome(const StabilityMap& map, std::size_t family, std::size_t member, std::size_t method);

/// The part `stability` of results.json; share/doc/results.md explains every field.
boost::json::object stability_json(const StabilityMap& map);

/// One row per case, a header first; as limits.csv.
std::string stability_csv(const StabilityMap& map);

/// One panel per family: methods against members, a square per member and method with the colour and the
/// initial of its worst outcome, so that it is readable in black and white. Same results, same bytes.
std::string stability_svg(const StabilityMap& map, const std::string& title);

}  // namespace hauberk
