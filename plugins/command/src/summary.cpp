#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk::command {
namespace {

bool answered(const LimitResult& limit) { return is_answer(limit.status); }

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.6f}", *value) : "-"; }

/// Stretched fabrics are taut: one search is enough for them. Of others it is said that it was only one.
std::string mark(const LimitResult& l)
{
  if (l.confidence.word == "contradicted") return "!";
  if (l.confidence.word == "single" && l.sense == "compress") return "?";
  return l.better_state ? "*" : "";
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

std::string limits_table(const Loaded& loaded, const RunResult& run)
{
  const auto names = loaded.experiment.load_case->sense_names();
  const bool strain = loaded.experiment.load_case->value_length_power() == 0;
  std::string text = fmt::format("{:>10} {:>15} {:>15}", "direction", names.first, names.second);
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
  if (marked("?")) text += "? one search alone ended there; more starts tell more\n";
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
std::string boundary_table(const Loaded& loaded, const RunResult& run)
{
  constexpr std::size_t most_listed = 24;
  std::string text, names;
  for (const MacroInfo& m : loaded.experiment.load_case->macros())
    names += (names.empty() ? "" : ", ") + m.name;
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
    const auto text_of = [&run](int k) { return run.limits[static_cast<std::size_t>(k)].direction.text(); };
    text += fmt::format("{}: not the furthest, the state of {} is further by {:.3g}\n", text_of(s.limit),
                        text_of(s.state), s.by);
  }
  return text;
}

std::string design_table(const DesignResult& d, int starts)
{
  std::string text = fmt::format("Design of {}: {}", d.quantity, d.status);
  if (!d.message.empty()) text += " (" + d.message + ")";
  text += fmt::format("\nobjective {:.4e} -> {:.4e}, {} iterations, {:.1f} s, start {} of {}\n",
                      d.objective_initial, d.objective, d.iterations, d.seconds, d.start + 1, starts);
  text += fmt::format("{:>10} {:>10} {:>10} {:>12} {:>11}  {}\n", "direction", "target", "initial",
                      "provisional", "recomputed", "met");
  std::size_t met = 0;
  for (const DesignTargetResult& t : d.targets) {
    const std::string verdict = t.met ? "yes" : "no";
    text += fmt::format("{:>10g} {:>10.6g} {:>10} {:>12} {:>11}  {}\n", t.direction_deg, t.target,
                        cell(t.initial), cell(t.provisional), cell(t.recomputed), verdict);
    met += t.met ? 1 : 0;
  }
  text += fmt::format("{} of {} targets met\n", met, d.targets.size());
  return text;
}

/// What was designed, and which bounds hold it.
std::string variables_table(const DesignResult& d, const std::string& unit)
{
  constexpr double at_bound = 1e-6;  // of the width of the bounds
  std::size_t width = 8;
  for (const DesignVariableResult& v : d.variables) width = std::max(width, v.name.size());
  std::string text = fmt::format("{:<{}} {:>12} {:>12}  {}\n", "variable", width, "initial", "final", unit);
  for (const DesignVariableResult& v : d.variables) {
    const double room = at_bound * (v.upper - v.lower);
    const char* bound = v.final <= v.lower + room   ? "  at its lower bound"
                        : v.final >= v.upper - room ? "  at its upper bound"
                                                    : "";
    text += fmt::format("{:<{}} {:>12.6g} {:>12.6g}{}\n", v.name, width, v.initial, v.final, bound);
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

std::string summary(const Loaded& loaded, const RunResult& run)
{
  std::string text = loaded.experiment.name + "\n\n";
  if (loaded.start)
    text +=
        "The rest state touches itself in a cell without room: limits start from a slightly strained "
        "state.\n\n";
  else if (loaded.moved > 0.0)
    text +=
        fmt::format("The rest state touches itself and was relaxed: elements moved by up to {:.3g} {}.\n\n",
                    loaded.moved, loaded.experiment.length_unit);
  if (run.design) {
    text += design_table(*run.design, loaded.design->starts) + "\n";
    text += variables_table(*run.design, loaded.experiment.length_unit) + "\n";
  }
  if (run.boundary) text += boundary_table(loaded, run);
  if (!run.profiles.empty()) text += limits_table(loaded, run);
  return text + remarks(run);
}

bool any_failed(const RunResult& run)
{
  const bool design =
      run.design && (run.design->status == "failed" || run.design->status == "interrupted" ||
                     run.design->status == "infeasible" ||
                     std::any_of(run.design->initial_limits.begin(), run.design->initial_limits.end(),
                                 [](const LimitResult& l) { return !answered(l); }));
  return design || !std::all_of(run.limits.begin(), run.limits.end(), answered);
}

}  // namespace hauberk::command
