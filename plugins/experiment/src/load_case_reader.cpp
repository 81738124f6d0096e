#include "document/json_writer.hpp"
#include "document/node_access.hpp"
#include "limits/limits.hpp"
#include "sections.hpp"

#include <hauberk/suggestion.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {

namespace {

void read_senses(Node& section, const LoadCase& load_case, Problems& problems, std::vector<Sense>& senses)
{
  const auto [positive, negative] = load_case.sense_names();
  const Node* list = find_typed(section, "senses", Node::Type::array);
  if (list == nullptr) {
    senses = {Sense::positive, Sense::negative};
    Node both;
    both.type = Node::Type::array;
    both.items = {string_node(positive), string_node(negative)};
    set_default(section, "senses", std::move(both));
    return;
  }
  for (const Node& item : list->items) {
    if (item.string != positive && item.string != negative) {
      problems.add(
          item, fmt::format("expected one of {}, {}, found {}{}", positive, negative, quote_json(item.string),
                            did_you_mean(item.string, {positive, negative})));
      continue;
    }
    const Sense sense = item.string == positive ? Sense::positive : Sense::negative;
    if (std::find(senses.begin(), senses.end(), sense) != senses.end()) {
      problems.add(item, "sense '" + item.string + "' is given twice");
    }
    senses.push_back(sense);
  }
}

}  // namespace

namespace {

/// Angles at which the load is zero ask nothing: a strip cannot be rolled about the axis across it.
void check_loads(const std::vector<std::pair<const Node*, double>>& directions, const LoadCase& load_case,
                 const std::string& name, Problems& problems)
{
  constexpr double nothing = 1e-12;
  std::vector<double> load(static_cast<std::size_t>(load_case.macro_count()));
  for (const auto& [node, degrees] : directions) {
    load_case.load(Direction::at_degrees(degrees), load);
    if (std::all_of(load.begin(), load.end(), [](double t) { return std::abs(t) < nothing; }))
      problems.add(*node, fmt::format("'{}' has no load at {} degrees: give another direction", name,
                                      format_number(degrees)));
  }
}

}  // namespace

void check_directions(const std::vector<std::pair<const Node*, double>>& directions,
                      const Experiment& experiment, Problems& problems)
{
  if (experiment.load_case)
    check_loads(directions, *experiment.load_case, experiment.load_case_plugin, problems);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      if (!on_one_line(directions[k].second, directions[j].second)) continue;
      const bool equal = directions[k].second == directions[j].second;
      problems.add(*directions[k].first,
                   "direction " + format_number(directions[k].second) +
                       (equal ? " is given twice"
                              : " is the same as " + format_number(directions[j].second) +
                                    ": directions count modulo 180 degrees"));
      break;
    }
  }
}

namespace {

/// A load on a cell that repeats needs one, a load on a patch a patch.
void check_extent(const Node& root, const Node& section, const LoadCase& load_case, Problems& problems)
{
  const Node* cell = find_typed(root, "cell", Node::Type::object);
  const Node* plugin = section.find("plugin");
  if (cell == nullptr || plugin == nullptr) return;
  const bool patch = cell->find("patch") != nullptr;
  if (load_case.periodic() != patch) {
    const Node* vectors = find_typed(*cell, "vectors", Node::Type::array);
    const std::size_t needed = load_case.lattice_vectors();
    if (patch || vectors == nullptr) return;
    const std::size_t found = cell->find("strip") != nullptr ? 1 : vectors->items.size();
    if (found != needed) {
      problems.add(*vectors,
                   fmt::format("'{}' loads cells with {} vector{}, and there {} {}{}", plugin->string, needed,
                               needed == 1 ? "" : "s", found == 1 ? "is" : "are", found,
                               needed == 1 ? ": cut one with cell.strip" : ""));
    }
    return;
  }
  problems.add(*plugin, patch ? "'" + plugin->string +
                                    "' loads a cell that repeats, and cell.patch is finite: use "
                                    "cell.vectors and cell.repeat, or a load case for patches"
                              : "'" + plugin->string +
                                    "' loads a finite patch: use cell.patch instead of "
                                    "cell.vectors and cell.repeat");
}

}  // namespace

void read_load_case(Node& root, PluginResolver& plugins, bool angles_only, Problems& problems,
                    Experiment& experiment)
{
  Node* section = find_mutable(root, "load_case");
  if (section == nullptr) return;
  experiment.load_case_plugin = string_or(*section, "plugin", "");
  experiment.load_case = plugins.load_case(*section, experiment.scene.length, problems);
  if (experiment.load_case) {
    check_extent(root, *section, *experiment.load_case, problems);
    if (section->find("directions") == nullptr)
      read_senses(*section, *experiment.load_case, problems, experiment.senses);
  }
  read_directions(*section, angles_only, problems, experiment);

  if (const Node* list = find_typed(*section, "directions_deg", Node::Type::array)) {
    std::vector<std::pair<const Node*, double>> directions;
    for (const Node& item : list->items) directions.emplace_back(&item, item.number);
    check_directions(directions, experiment, problems);
    experiment.directions_deg = list->numbers();
  }
}

}  // namespace hauberk
