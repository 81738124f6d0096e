#include "tasks/limits/kept_limits.hpp"

#include "document/json_values.hpp"
#include "results/direction_json.hpp"
#include "results/document.hpp"

#include <boost/json/array.hpp>

namespace hauberk {
namespace {

namespace json = boost::json;

Confidence read_confidence(const json::value& entry)
{
  Confidence c;
  c.word = text_of(entry.at("word"));
  c.searches = entry.at("searches").to_number<int>();
  c.ended_here = entry.at("ended_here").to_number<int>();
  c.distinct = entry.at("distinct").to_number<int>();
  c.seen_once = entry.at("seen_once").to_number<int>();
  for (const json::value& by : entry.at("confirmed_by").as_array()) c.confirmed_by.push_back(text_of(by));
  for (const json::value& by : entry.at("contradicted_by").as_array())
    c.contradicted_by.push_back(text_of(by));
  for (const json::value& search : entry.at("failed_searches").as_array())
    c.failed_searches.push_back({text_of(search.at("origin")), search.at("seed").to_number<std::uint64_t>(),
                                 text_of(search.at("status")), number_or_none(search.at("reached"))});
  return c;
}

/// What tables, plots and profiles need; poses and forces stay in the entry, which is kept as it is.
std::optional<LimitResult> read_limit(const json::object& entry, const std::vector<std::string>& companions)
{
  LimitResult r;
  const auto status = limit_status(text_of(entry.at("status")));
  if (!status || *status == LimitStatus::interrupted) return std::nullopt;
  r.resumed = true;
  r.status = *status;
  r.load_case = text_of(entry.at("load_case"));
  r.direction = entered_direction(entry);
  r.sense = text_of(entry.at("sense"));
  r.measure = text_of(entry.at("measure"));
  r.message = text_of(entry.at("message"));
  r.value = number_or_none(entry.at("value"));
  for (const std::string& name : companions) {
    if (entry.contains(name)) r.companions.emplace_back(name, number_or_zero(entry.at(name)));
  }
  if (const json::object* macro = entry.at("macro").if_object()) {
    for (const auto& [name, value] : *macro) r.macro.emplace_back(std::string(name), number_or_zero(value));
  }
  r.iterations = static_cast<int>(number_or_zero(entry.at("iterations")));
  r.evaluations = static_cast<long>(number_or_zero(entry.at("evaluations")));
  if (const json::value* seconds = entry.if_contains("seconds")) r.seconds = number_or_zero(*seconds);
  r.min_gap = number_or_none(entry.at("min_gap"));
  r.error_estimate = number_or_none(entry.at("error_estimate"));
  r.links_kept = entry.at("links_kept").as_bool();
  r.z_range = number_or_zero(entry.at("z_range"));
  r.better_state = entry.at("better_state").as_bool();
  r.confidence = read_confidence(entry.at("confidence"));
  r.force_balance = number_or_none(entry.at("force_balance"));
  // Where states came from: what was learnt from other limits is learnt again.
  for (const json::value& start : entry.at("starts").as_array()) {
    r.starts.emplace_back();
    r.starts.back().origin = text_of(start.at("origin"));
    r.starts.back().value = number_or_zero(start.at("value"));
    r.starts.back().seed = start.at("seed").to_number<std::uint64_t>();
  }
  r.contacts.resize(entry.at("contacts").as_array().size());
  return r;
}

}  // namespace

KeptLimits kept_limits(const json::value& results, const Experiment& experiment,
                       const std::vector<LimitTask>& tasks)
{
  const LoadCase& load = *experiment.load_case;
  const std::vector<double> rest(load.macro_count(), 0.0);
  std::vector<std::string> companions;
  for (const auto& [name, value] : load.companions(Direction(), rest)) companions.push_back(name);
  KeptLimits out;
  for (const LimitTask& task : tasks) {
    out.limits.emplace_back();
    out.entries.emplace_back(nullptr);
    for (const json::value& entry : results.at("limits").as_array()) {
      const json::object& o = entry.as_object();
      const std::string sense = load.sense_name(task.direction, task.sense);
      if (entered_direction(o) != task.direction || text_of(o.at("sense")) != sense) continue;
      out.limits.back() = read_limit(o, companions);
      if (out.limits.back()) out.entries.back() = entry;
    }
    out.complete = out.complete && out.limits.back() && out.limits.back()->confidence.is_final();
  }
  return out;
}

}  // namespace hauberk
