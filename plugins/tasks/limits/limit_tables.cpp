#include "tasks/limits/limit_tables.hpp"

#include "run/confidence_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk {
namespace {

bool answered(const LimitResult& limit) { return is_answer(limit.status); }

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.6f}", *value) : "-"; }

/// Stretched fabrics are taut: one search is enough for them. Of others it is said that it was only one.
std::string mark(const LimitResult& l)
{
  const std::string by_confidence = confidence_mark(l.confidence.word);
  return by_confidence.empty() && l.better_state ? "*" : by_confidence;
}

/// The value, or why there is none; what is not an answer is marked.
std::string limit_cell(const std::vector<LimitResult>& limits, double direction, const std::string& sense)
{
  for (const LimitResult& l : limits) {
    if (!l.direction.is_angle() || l.direction.degrees() != direction || l.sense != sense) continue;
    if (l.status == LimitStatus::locked && l.value) return fmt::format("{:.8f}", *l.value) + mark(l);
    return to_string(l.status);
  }
  return "-";
}

std::string limits_table(const Experiment& experiment, const RunResult& run)
{
  const auto names = experiment.load_case->sense_names();
  const bool strain = experiment.load_case->value_length_power() == 0;
  // Only curvatures have a unit beside strains.
  const std::string unit = strain ? "" : fmt::format(", 1/{}", experiment.length_unit);
  std::string text =
      fmt::format("{:>10} {:>15} {:>15}", "direction", names.first + unit, names.second + unit);
  text += strain ? fmt::format(" {:>10}\n", "eta") : "\n";
  for (const ProfilePoint& p : run.profiles) {
    text += fmt::format("{:>10g} {:>15} {:>15}", p.direction_deg,
                        limit_cell(run.limits, p.direction_deg, names.first),
                        limit_cell(run.limits, p.direction_deg, names.second));
    text += strain ? fmt::format(" {:>10}\n", cell(p.eta)) : "\n";
  }
  const auto marked = [&run](const char* which) {
    return std::any_of(run.limits.begin(), run.limits.end(),
                       [which](const LimitResult& l) { return l.value && mark(l) == which; });
  };
  if (marked("*")) text += "* further than where the first start from rest led\n";
  text += explained_marks((marked("?") ? std::string("?") : "") + (marked("~") ? "~" : ""));
  if (marked("!")) {
    text += "! contradicted:\n";
    for (const LimitResult& l : run.limits) {
      for (const std::string& by : l.confidence.contradicted_by)
        text += fmt::format("  {}: {}\n", limit_name(l.sense, l.direction), by);
    }
  }
  return text;
}

/// Limits along components: all of a few, the extremes of many, and what shows that some are not the
/// furthest.
std::string boundary_table(const Experiment& experiment, const RunResult& run)
{
  constexpr std::size_t most_listed = 24;
  std::string text, names;
  for (const MacroInfo& m : experiment.load_case->macros()) names += (names.empty() ? "" : ", ") + m.name;
  if (run.limits.size() <= most_listed) {
    text += fmt::format("{:>34} {:>15}\n", "direction (" + names + ")", "along");
    for (const LimitResult& l : run.limits) {
      const bool locked = l.status == LimitStatus::locked && l.value;
      text += fmt::format("{:>34} {:>15}\n", l.direction.text(),
                          locked ? fmt::format("{:.8f}", *l.value) : to_string(l.status));
    }
  } else {
    std::size_t locked = 0;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (const LimitResult& l : run.limits) {
      if (l.status != LimitStatus::locked || !l.value) continue;
      ++locked;
      least = std::min(least, *l.value);
      most = std::max(most, *l.value);
    }
    text += fmt::format("{} directions of ({}), {} locked", run.limits.size(), names, locked);
    text += locked > 0 ? fmt::format(", from {:.8f} to {:.8f}\n", least, most) : "\n";
  }
  for (const BoundarySurface::Shortfall& s : run.boundary->shortfalls) {
    const auto text_of = [&run](int k) { return run.limits[k].direction.text(); };
    text += fmt::format("{}: not the furthest, the state of {} is further by {:.3g}\n", text_of(s.limit),
                        text_of(s.state), s.by);
  }
  return text;
}

/// A line for each limit that is not an answer, that has a reservation, or whose state tells why there is
/// none.
std::string remarks(const RunResult& run)
{
  std::string text;
  for (const LimitResult& l : run.limits) {
    const bool plain = l.status == LimitStatus::unbounded || l.status == LimitStatus::not_attained;
    if (plain || (l.status == LimitStatus::locked && l.message.empty())) continue;
    text += fmt::format("{}: {}{}{}\n", limit_name(l.sense, l.direction), to_string(l.status),
                        l.message.empty() ? "" : ": ", l.message);
  }
  return text;
}

}  // namespace

std::string rest_remark(const Prepared& prepared)
{
  if (prepared.settings.start)
    return "The rest state touches itself in a cell without room: limits start from a slightly strained "
           "state.\n\n";
  if (prepared.moved > 0.0)
    return fmt::format(
        "The rest state touches itself and was relaxed: elements moved by up to {:.3g} {}.\n\n",
        prepared.moved, prepared.experiment.length_unit);
  return "";
}

std::string limit_tables(const Experiment& experiment, const RunResult& run)
{
  std::string text;
  if (run.boundary) text += boundary_table(experiment, run);
  if (!run.profiles.empty()) text += limits_table(experiment, run);
  return text + remarks(run);
}

bool all_answered(const std::vector<LimitResult>& limits)
{
  return std::all_of(limits.begin(), limits.end(), answered);
}

}  // namespace hauberk
