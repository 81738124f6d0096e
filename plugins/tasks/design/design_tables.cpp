#include "tasks/design/design_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.6f}", *value) : "-"; }

/// An objective is not known where some limit is not.
std::string known(double objective)
{
  return std::isfinite(objective) ? fmt::format("{:.4e}", objective) : std::string("not known");
}

/// What stands behind the verdict on a target that is a bound.
const char* bound_text(Aim aim)
{
  switch (aim) {
    case Aim::no_further:
      return ", no further";
    case Aim::no_nearer:
      return ", no nearer";
    case Aim::reach:
      break;
  }
  return "";
}

std::string design_table(const DesignResult& d, int starts)
{
  std::string text = fmt::format("Design of {}: {}", d.quantity, d.status);
  if (!d.message.empty()) text += " (" + d.message + ")";
  text += fmt::format("\nobjective {} -> {}, {} iterations, {:.1f} s, start {} of {}\n",
                      known(d.objective_initial), known(d.objective), d.iterations, d.seconds, d.start + 1,
                      starts);
  text += fmt::format("{:>10} {:>10} {:>10} {:>12} {:>11}  {}\n", "direction", "target", "initial",
                      "provisional", "recomputed", "met");
  std::size_t met = 0;
  for (const DesignTargetResult& t : d.targets) {
    const std::string verdict = std::string(t.met ? "yes" : "no") + bound_text(t.aim);
    text += fmt::format("{:>10g} {:>10.6g} {:>10} {:>12} {:>11}  {}\n", t.direction_deg, t.target,
                        cell(t.initial), cell(t.provisional), cell(t.recomputed), verdict);
    met += t.met ? 1 : 0;
  }
  text += fmt::format("{} of {} targets met\n", met, d.targets.size());
  return text;
}

/// What was designed, and which bounds hold it. A unit that all have is in the head.
std::string variables_table(const DesignResult& d, const std::vector<std::string>& units)
{
  constexpr double at_bound = 1e-6;  // of the width of the bounds
  const bool one_unit = std::equal(units.begin() + 1, units.end(), units.begin());
  std::size_t width = 8;
  for (const DesignVariableResult& v : d.variables) width = std::max(width, v.name.size());
  std::string text = fmt::format("{:<{}} {:>12} {:>12}{}\n", "variable", width, "initial", "final",
                                 one_unit ? "  " + units.front() : "");
  for (std::size_t k = 0; k < d.variables.size(); ++k) {
    const DesignVariableResult& v = d.variables[k];
    const double room = at_bound * (v.upper - v.lower);
    const char* bound = v.final <= v.lower + room   ? "  at its lower bound"
                        : v.final >= v.upper - room ? "  at its upper bound"
                                                    : "";
    text += fmt::format("{:<{}} {:>12.6g} {:>12.6g}{}{}\n", v.name, width, v.initial, v.final,
                        one_unit || units[k].empty() ? "" : " " + units[k], bound);
  }
  return text;
}

}  // namespace

std::string design_tables(const DesignResult& design, int starts, const std::vector<std::string>& units)
{
  return design_table(design, starts) + "\n" + variables_table(design, units) + "\n";
}

}  // namespace hauberk
