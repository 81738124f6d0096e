#include "tasks/design/design_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.6f}", *value) : "-"; }

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

}  // namespace

std::string design_tables(const DesignResult& design, int starts, const std::string& unit)
{
  return design_table(design, starts) + "\n" + variables_table(design, unit) + "\n";
}

}  // namespace hauberk
