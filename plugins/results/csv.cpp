#include "results/csv.hpp"

#include "results/csv_cells.hpp"

#include <algorithm>
#include <optional>

namespace hauberk {
namespace {

using detail::csv_line;
using detail::number_cell;
using detail::text_cell;
using Named = std::vector<std::pair<std::string, double>>;

std::string named_cell(const Named& values, const std::string& name)
{
  for (const auto& [key, value] : values)
    if (key == name) return number_cell(value);
  return {};
}

void collect(const Named& values, std::vector<std::string>& names)
{
  for (const auto& [name, value] : values)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

}  // namespace

std::string limits_csv(std::span<const LimitResult> limits, const std::vector<std::string>& macro_names)
{
  std::vector<std::string> companions, macros = macro_names;
  for (const LimitResult& limit : limits) {
    collect(limit.companions, companions);
    collect(limit.macro, macros);
  }
  const bool components =
      std::any_of(limits.begin(), limits.end(), [](const LimitResult& l) { return !l.direction.is_angle(); });
  std::vector<std::string> header{"load_case", "direction_deg"};
  if (components) {
    for (const std::string& name : macro_names) header.push_back(text_cell("direction_" + name));
  }
  header.insert(header.end(), {"sense", "measure", "value"});
  for (const auto* names : {&companions, &macros})
    for (const std::string& name : *names) header.push_back(text_cell(name));
  for (const char* name : {"status", "iterations", "evaluations", "min_gap", "error_estimate", "links_kept",
                           "z_range", "better_state", "confidence", "force_balance", "starts", "contacts"})
    header.emplace_back(name);

  std::string out = csv_line(header);
  for (const LimitResult& limit : limits) {
    std::vector<std::string> row{text_cell(limit.load_case),
                                 limit.direction.is_angle() ? number_cell(limit.direction.degrees()) : ""};
    for (std::size_t k = 0; components && k < macro_names.size(); ++k) {
      const std::span<const double> d = limit.direction.components();
      row.push_back(k < d.size() ? number_cell(d[k]) : "");
    }
    row.insert(row.end(), {text_cell(limit.sense), text_cell(limit.measure), number_cell(limit.value)});
    for (const std::string& name : companions) row.push_back(named_cell(limit.companions, name));
    for (const std::string& name : macros) row.push_back(named_cell(limit.macro, name));
    row.insert(row.end(), {to_string(limit.status), std::to_string(limit.iterations),
                           std::to_string(limit.evaluations), number_cell(limit.min_gap),
                           number_cell(limit.error_estimate), limit.links_kept ? "true" : "false",
                           number_cell(limit.z_range), limit.better_state ? "true" : "false",
                           text_cell(limit.confidence.word), number_cell(limit.force_balance),
                           std::to_string(limit.starts.size()), std::to_string(limit.contacts.size())});
    out += csv_line(row);
  }
  return out;
}

}  // namespace hauberk
