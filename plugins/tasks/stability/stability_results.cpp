#include "tasks/stability/stability_results.hpp"

#include "results/csv_cells.hpp"
#include "results/direction_json.hpp"
#include "results/json_parts.hpp"

#include <algorithm>

namespace hauberk {
namespace {

namespace json = boost::json;
using detail::number;

json::object counts_json(const OutcomeCounts& counts)
{
  json::object out;
  for (std::size_t k = 0; k < outcomes.size(); ++k) out[to_string(outcomes[k])] = counts[k];
  return out;
}

json::object case_json(const StabilityMap& map, const StabilityCase& c)
{
  const StabilityFamilyResult& family = map.families[c.family];
  json::object out;
  out["family"] = family.name;
  out["member"] = family.labels[c.member];
  out["method"] = map.methods[c.method];
  if (c.sense.empty())
    out["direction_deg"] = nullptr;
  else
    enter_direction(out, c.direction);
  out["sense"] = c.sense.empty() ? json::value(nullptr) : json::value(c.sense);
  out["outcome"] = to_string(c.outcome);
  out["reason"] = c.reason;
  out["status"] = c.status;
  out["message"] = c.message;
  out["value"] = number(c.value);
  out["best_known"] = number(c.best_known);
  out["exact"] = number(c.exact);
  out["slack"] = number(c.slack);
  out["checked"] = c.checked;
  out["check"] = c.check;
  out["contact"] = c.contact;
  out["min_gap"] = number(c.min_gap);
  out["error_estimate"] = number(c.error_estimate);
  out["force_balance"] = number(c.force_balance);
  out["iterations"] = c.iterations;
  out["evaluations"] = static_cast<std::int64_t>(c.evaluations);
  out["seconds"] = number(c.seconds);
  return out;
}

json::array methods_json(const StabilityMap& map, std::optional<std::size_t> family)
{
  json::array out;
  for (std::size_t m = 0; m < map.methods.size(); ++m)
    out.push_back({{"name", map.methods[m]}, {"counts", counts_json(count_outcomes(map, family, m))}});
  return out;
}

}  // namespace

std::string to_string(Outcome outcome)
{
  switch (outcome) {
    case Outcome::verified:
      return "verified";
    case Outcome::local:
      return "local";
    case Outcome::honest_failure:
      return "honest_failure";
    case Outcome::silent_wrong:
      return "silent_wrong";
    case Outcome::interrupted:
      return "interrupted";
  }
  return "interrupted";
}

OutcomeCounts count_outcomes(const StabilityMap& map, std::optional<std::size_t> family,
                             std::optional<std::size_t> method)
{
  OutcomeCounts out{};
  for (const StabilityCase& c : map.cases) {
    if ((family && c.family != *family) || (method && c.method != *method)) continue;
    ++out[static_cast<std::size_t>(c.outcome)];
  }
  return out;
}

Outcome worst_outcome(const StabilityMap& map, std::size_t family, std::size_t member, std::size_t method)
{
  std::optional<Outcome> worst;
  for (const StabilityCase& c : map.cases) {
    if (c.family == family && c.member == member && c.method == method)
      worst = worst ? std::max(*worst, c.outcome) : c.outcome;
  }
  return worst.value_or(Outcome::interrupted);
}

json::object stability_json(const StabilityMap& map)
{
  json::object out;
  out["tolerance"] = number(map.tolerance);
  out["counts"] = counts_json(count_outcomes(map, {}, {}));
  out["methods"] = methods_json(map, {});
  json::array& families = out["families"].emplace_array();
  for (std::size_t f = 0; f < map.families.size(); ++f) {
    const StabilityFamilyResult& family = map.families[f];
    json::array labels;
    for (const std::string& label : family.labels) labels.emplace_back(label);
    families.push_back({{"name", family.name},
                        {"why", family.why},
                        {"solvable", family.solvable},
                        {"members", std::move(labels)},
                        {"counts", counts_json(count_outcomes(map, f, {}))},
                        {"methods", methods_json(map, f)}});
  }
  json::array& cases = out["cases"].emplace_array();
  for (const StabilityCase& c : map.cases) cases.push_back(case_json(map, c));
  return out;
}

std::string stability_csv(const StabilityMap& map)
{
  using detail::number_cell;
  using detail::text_cell;
  std::string out =
      detail::csv_line({"family", "member", "method", "direction_deg", "sense", "outcome", "reason", "status",
                        "value", "best_known", "exact", "slack", "contact", "min_gap", "error_estimate",
                        "force_balance", "iterations", "evaluations"});
  for (const StabilityCase& c : map.cases) {
    const StabilityFamilyResult& family = map.families[c.family];
    out += detail::csv_line(
        {text_cell(family.name), text_cell(family.labels[c.member]), text_cell(map.methods[c.method]),
         c.sense.empty() ? "" : detail::direction_cell(c.direction), c.sense, to_string(c.outcome),
         text_cell(c.reason), c.status, number_cell(c.value), number_cell(c.best_known), number_cell(c.exact),
         number_cell(c.slack), c.contact, number_cell(c.min_gap), number_cell(c.error_estimate),
         number_cell(c.force_balance), std::to_string(c.iterations), std::to_string(c.evaluations)});
  }
  return out;
}

}  // namespace hauberk
