#include "resume.hpp"
#include "chart_run.hpp"
#include "machine.hpp"
#include "output.hpp"
#include "stability_run.hpp"
#include "sweep_run.hpp"

#include <hauberk/experiment/json_writer.hpp>
#include <hauberk/results/direction_json.hpp>
#include <hauberk/results/json_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hauberk::command {
namespace {

namespace json = boost::json;

double number(const json::value& v) { return v.is_null() ? 0.0 : v.to_number<double>(); }

std::optional<double> optional_number(const json::value& v)
{
  return v.is_null() ? std::nullopt : std::optional(v.to_number<double>());
}

std::string text(const json::value& v) { return std::string(v.as_string()); }

/// What tables, plots and profiles need; poses and forces stay in the entry, which is kept as it is.
std::optional<LimitResult> read_limit(const json::object& entry, const std::vector<std::string>& companions)
{
  LimitResult r;
  const auto status = limit_status(text(entry.at("status")));
  if (!status || *status == LimitStatus::interrupted) return std::nullopt;
  r.resumed = true;
  r.status = *status;
  r.load_case = text(entry.at("load_case"));
  r.direction = entered_direction(entry);
  r.sense = text(entry.at("sense"));
  r.measure = text(entry.at("measure"));
  r.message = text(entry.at("message"));
  r.value = optional_number(entry.at("value"));
  for (const std::string& name : companions) {
    if (entry.contains(name)) r.companions.emplace_back(name, number(entry.at(name)));
  }
  if (const json::object* macro = entry.at("macro").if_object()) {
    for (const auto& [name, value] : *macro) r.macro.emplace_back(std::string(name), number(value));
  }
  r.iterations = static_cast<int>(number(entry.at("iterations")));
  r.evaluations = static_cast<long>(number(entry.at("evaluations")));
  r.seconds = number(entry.at("seconds"));
  r.min_gap = optional_number(entry.at("min_gap"));
  r.error_estimate = optional_number(entry.at("error_estimate"));
  r.links_kept = entry.at("links_kept").as_bool();
  r.z_range = number(entry.at("z_range"));
  r.better_state = entry.at("better_state").as_bool();
  if (const json::value* confidence = entry.if_contains("confidence"))
    r.confidence.word = text(confidence->at("word"));
  r.force_balance = optional_number(entry.at("force_balance"));
  // Where states came from: what was learnt from other limits is learnt again.
  for (const json::value& start : entry.at("starts").as_array()) {
    r.starts.emplace_back();
    r.starts.back().origin = text(start.at("origin"));
    r.starts.back().value = number(start.at("value"));
  }
  r.contacts.resize(entry.at("contacts").as_array().size());
  return r;
}

void read_limits(const json::value& document, const Loaded& loaded, Resumed& out)
{
  const LoadCase& load = *loaded.experiment.load_case;
  const std::vector<double> rest(static_cast<std::size_t>(load.macro_count()), 0.0);
  std::vector<std::string> companions;
  for (const auto& [name, value] : load.companions(Direction(), rest)) companions.push_back(name);
  out.complete = true;
  for (const LimitTask& task : loaded.tasks) {
    out.limits.emplace_back();
    out.entries.emplace_back(nullptr);
    for (const json::value& entry : document.at("limits").as_array()) {
      const json::object& o = entry.as_object();
      const std::string sense = load.sense_name(task.direction, task.sense);
      if (entered_direction(o) != task.direction || text(o.at("sense")) != sense) continue;
      out.limits.back() = read_limit(o, companions);
      if (out.limits.back()) out.entries.back() = entry;
    }
    out.complete = out.complete && out.limits.back();
  }
}

/// A search is repeated, from the evaluations that were made (evaluation_log.hpp); here is only whether it is
/// done.
void read_design(const json::value& document, Resumed& out)
{
  const json::value& design = document.at("design");
  out.complete = out.complete && !design.is_null() && text(design.at("status")) != "interrupted";
}

bool same_case(const json::object& entry, const StabilityMap& map, const StabilityCase& c)
{
  return text(entry.at("family")) == map.families[c.family].name &&
         text(entry.at("member")) == map.families[c.family].labels[c.member] &&
         text(entry.at("method")) == map.methods[c.method] &&
         (c.sense.empty() ? entry.at("sense").is_null()
                          : text(entry.at("sense")) == c.sense && entered_direction(entry) == c.direction);
}

void take_case(const json::object& entry, StabilityCase& c)
{
  for (const Outcome outcome : outcomes) {
    if (to_string(outcome) == text(entry.at("outcome"))) c.outcome = outcome;
  }
  if (c.outcome == Outcome::interrupted) return;
  c.status = text(entry.at("status"));
  c.message = text(entry.at("message"));
  c.contact = text(entry.at("contact"));
  c.value = optional_number(entry.at("value"));
  c.slack = number(entry.at("slack"));
  c.checked = entry.at("checked").as_bool();
  c.check = text(entry.at("check"));
  c.min_gap = optional_number(entry.at("min_gap"));
  c.error_estimate = optional_number(entry.at("error_estimate"));
  c.force_balance = optional_number(entry.at("force_balance"));
  c.iterations = static_cast<int>(number(entry.at("iterations")));
  c.evaluations = static_cast<long>(number(entry.at("evaluations")));
  c.seconds = number(entry.at("seconds"));
}

/// The experiment is the same, so its cases are the same and in the same order.
void read_stability(const json::value& document, const Loaded& loaded, Resumed& out)
{
  out.stability = empty_map(loaded);
  const json::array& entries = document.at("stability").at("cases").as_array();
  if (entries.size() != out.stability->cases.size()) throw InputError("its cases are not complete");
  out.complete = true;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    StabilityCase& c = out.stability->cases[k];
    const json::object& entry = entries[k].as_object();
    if (!same_case(entry, *out.stability, c)) throw InputError("its cases are in another order");
    take_case(entry, c);
    out.complete = out.complete && c.outcome != Outcome::interrupted;
  }
}

/// Rows of the same experiment are the same and in the same order.
void read_sweep(const json::value& document, const Loaded& loaded, Resumed& out)
{
  out.sweep = empty_table(loaded);
  const json::array& entries = document.at("sweep").at("rows").as_array();
  if (entries.size() != out.sweep->rows.size()) throw InputError("its rows are not complete");
  out.complete = true;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    SweepRow& row = out.sweep->rows[k];
    if (!take_row(entries[k], *out.sweep, row)) throw InputError("its rows are in another order");
    out.complete = out.complete && row.status != RowStatus::interrupted;
  }
}

/// Times of two machines do not belong into one picture.
void check_machine(const json::value& then, const Machine& now)
{
  const std::string processor = text(then.at("processor"));
  const int processors = then.at("processors").to_number<int>();
  if (processor != now.processor || processors != now.processors)
    throw InputError(fmt::format(
        "it was timed on another machine ({} of '{}'), this has {} of '{}'; start anew with --force",
        processors, processor, now.processors, now.processor));
}

void read_chart(const json::value& document, const Loaded& loaded, Resumed& out)
{
  const json::value& machine = document.at("provenance").at("machine");
  check_machine(machine, this_machine());
  out.load_average = optional_number(machine.at("load_average"));
  out.chart = empty_chart(loaded);
  if (!take_chart(document.at("chart"), *out.chart)) throw InputError("its points are others");
  out.complete = std::none_of(out.chart->points.begin(), out.chart->points.end(),
                              [](const PrecisionPoint& p) { return p.status == RowStatus::interrupted; });
}

/// Quick enough to be computed anew unless it is complete.
void read_transition(const json::value& document, const Loaded& loaded, Resumed& out)
{
  const TransitionSpec& spec = loaded.transition->spec;
  const json::array& paths = document.at("transition").at("paths").as_array();
  out.complete = paths.size() == spec.paths.size();
  for (const json::value& path : paths)
    out.complete = out.complete && path.at("curves").as_array().size() == spec.contacts.size();
}

using Named = std::vector<std::pair<std::string, std::string>>;

/// Texts by name below a key of the provenance, which is left out where there are none.
bool same_texts(const json::object& provenance, const char* key, const Named& now)
{
  const json::value* then = provenance.if_contains(key);
  if (then == nullptr) return now.empty();
  const json::object& texts = then->as_object();
  return texts.size() == now.size() && std::all_of(now.begin(), now.end(), [&](const auto& named) {
           const json::value* text = texts.if_contains(named.first);
           return text != nullptr && text->as_string() == std::string_view(named.second);
         });
}

void check_origin(const json::value& document, const Loaded& loaded)
{
  const Provenance now = provenance(loaded, 1);
  const json::value experiment = parse_json(write_json(loaded.experiment.resolved), "experiment");
  if (document.at("experiment") != experiment)
    throw InputError(
        "it was computed from another experiment; give the same file and --set, or start anew with --force");
  const json::value& then = document.at("provenance");
  // Rows and members are made of weaves that the experiment only names, elements of files.
  if (!same_texts(then.as_object(), "files", now.files))
    throw InputError(
        "it was computed from another file of the same name, see /provenance/files; bring that back, or "
        "start anew with "
        "--force");
  if (!same_texts(then.as_object(), "weaves", now.weaves))
    throw InputError(
        "it was computed from another weave of this name; bring its file back (the results hold it, below "
        "/provenance/weaves), or start anew with --force");
  if (text(then.at("version")) != now.version || text(then.at("build").at("type")) != now.build_type)
    throw InputError(fmt::format(
        "it was computed by version {} ({}), this is {} ({}); start anew with --force",
        text(then.at("version")), text(then.at("build").at("type")), now.version, now.build_type));
}

}  // namespace

std::optional<Resumed> read_resumed(const std::filesystem::path& directory, const Loaded& loaded)
{
  const std::filesystem::path file = directory / results_file;
  if (!std::filesystem::exists(file)) return std::nullopt;
  Resumed out;
  try {
    json::value document = read_json_file(file.string());
    check_origin(document, loaded);
    if (const json::value* peak = document.at("provenance").as_object().if_contains("peak_memory_bytes"))
      out.peak_memory_bytes = peak->to_number<std::int64_t>();
    if (loaded.experiment.task == Task::stability)
      read_stability(document, loaded, out);
    else if (loaded.experiment.task == Task::sweep)
      read_sweep(document, loaded, out);
    else if (loaded.experiment.task == Task::chart)
      read_chart(document, loaded, out);
    else if (loaded.experiment.task == Task::transition)
      read_transition(document, loaded, out);
    else
      read_limits(document, loaded, out);
    if (loaded.design) read_design(document, out);
    if (out.complete) out.document = std::move(document);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: cannot be resumed: {}", file.string(), error.what()));
  } catch (const std::exception& error) {  // a key that is missing, a value of another type
    throw InputError(fmt::format("{}: cannot be resumed: not a results file of this program ({})",
                                 file.string(), error.what()));
  }
  return out;
}

}  // namespace hauberk::command
