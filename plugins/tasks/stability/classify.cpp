#include "tasks/stability/classify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace hauberk {
namespace {

constexpr double slack_factor = 3.0;

/// The same question: scene, direction, sense.
using Question = std::tuple<std::size_t, Direction, std::string>;

Question question(const StabilityCase& c) { return {c.scene, c.direction, c.sense}; }

/// Further is larger.
double further(const StabilityCase& c, double value) { return c.upward ? value : -value; }

bool claims_state(const StabilityCase& c)
{
  return c.status == "locked" && c.value && std::isfinite(*c.value);
}

std::map<Question, double> best_of(const std::vector<StabilityCase>& cases)
{
  std::map<Question, double> best;
  const auto enter = [&best](const StabilityCase& c, double value) {
    const auto [at, fresh] = best.emplace(question(c), value);
    if (!fresh && further(c, value) > further(c, at->second)) at->second = value;
  };
  for (const StabilityCase& c : cases) {
    if (c.solvable && claims_state(c) && c.checked) enter(c, *c.value);
  }
  // What is exact is not improved by a value that exceeds it by rounding, or wrongly.
  for (const StabilityCase& c : cases) {
    if (c.exact) best[question(c)] = *c.exact;
  }
  return best;
}

std::string with_message(const StabilityCase& c)
{
  return c.message.empty() ? c.status : c.status + ": " + c.message;
}

void judge_state(StabilityCase& c, double tolerance)
{
  const double allowed = tolerance * std::abs(1.0 + c.value.value_or(0.0));
  const auto conclude = [&c](Outcome outcome, std::string reason) {
    c.outcome = outcome;
    c.reason = std::move(reason);
  };
  if (!claims_state(c)) return conclude(Outcome::silent_wrong, "locked, but without a value");
  if (!c.solvable)
    return conclude(Outcome::silent_wrong, fmt::format("claims {:.8g} where nothing holds", *c.value));
  if (!c.checked) return conclude(Outcome::silent_wrong, c.check);
  const double beyond = c.best_known ? further(c, *c.value) - further(c, *c.best_known) : 0.0;
  if (c.exact && beyond > allowed)
    return conclude(Outcome::silent_wrong, fmt::format("{:.10g} is further than the exact {:.10g} by {:.3g}",
                                                       *c.value, *c.exact, beyond));
  if (-beyond > allowed + slack_factor * c.slack)
    return conclude(Outcome::local, fmt::format("{:.8g} falls short of the best known {:.8g} by {:.3g}",
                                                *c.value, *c.best_known, -beyond));
  conclude(Outcome::verified, "");
}

void judge(StabilityCase& c, double tolerance)
{
  if (c.status == "interrupted" || c.status.empty()) {
    c.outcome = Outcome::interrupted;
    c.reason.clear();
  } else if (c.status == "locked") {
    judge_state(c, tolerance);
  } else if (c.status == "unbounded" || c.status == "not_attained" || c.status == "not_a_sheet") {
    c.outcome = c.solvable ? Outcome::silent_wrong : Outcome::verified;
    c.reason = c.solvable ? "claims that there is no locked state (" + with_message(c) + ")" : "";
  } else {
    c.outcome = Outcome::honest_failure;
    c.reason = with_message(c);
  }
}

}  // namespace

void classify(StabilityMap& map)
{
  const std::map<Question, double> best = best_of(map.cases);
  for (StabilityCase& c : map.cases) {
    const auto known = best.find(question(c));
    c.best_known = known == best.end() ? std::nullopt : std::optional(known->second);
    judge(c, map.tolerance);
  }
}

}  // namespace hauberk
