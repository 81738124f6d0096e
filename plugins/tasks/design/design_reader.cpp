#include "document/json_writer.hpp"
#include "document/node_access.hpp"
#include "limits/limits.hpp"
#include "tasks/design/design_section.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {

namespace {

/// Reports a quantity that the load case cannot give.
void check_quantity(const Node& section, const LoadCase& load_case, Problems& problems)
{
  const Node* quantity = section.find("quantity");
  if (quantity == nullptr) return;
  const auto [positive, negative] = load_case.sense_names();
  const bool strain = load_case.value_length_power() == 0;
  const std::string& name = quantity->string;
  const bool given = name == "curvature" ? load_case.value_length_power() == -1
                                         : strain && positive == "stretch" && negative == "compress";
  if (given) return;
  problems.add(*quantity, "'" + name + "' needs a load case " +
                              (name == "curvature" ? "that bends" : "that stretches and compresses") +
                              "; this one reports '" + load_case.measure() + "' in the senses " + positive +
                              " and " + negative);
}

void check_target_value(const Node& value, const std::string& quantity, Problems& problems)
{
  const double v = value.number;
  if ((quantity == "eta" || quantity == "stretch") && v < 0.0) {
    problems.add(value, "expected a number >= 0 for " + quantity + ", found " + format_number(v));
  } else if (quantity == "compress" && !(v <= 0.0 && v > -1.0)) {
    problems.add(value, "expected a number <= 0 and > -1 for compress, found " + format_number(v));
  }
}

/// A bound of zero could not be told from one that is missed by a share of it.
Aim read_aim(const Node& item, Problems& problems)
{
  const Aim aim = aim_named(string_or(item, "aim", "")).value_or(Aim::reach);  // the fields tell of others
  const Node* value = item.find("value");
  if (aim != Aim::reach && value != nullptr && value->number == 0.0)
    problems.add(*value, "expected a bound other than 0 for aim " + to_string(aim) + "; aim reach takes 0");
  return aim;
}

/// Whether `target` is the other end of a band whose one end is among `targets`: no_nearer than one value and
/// no_further than another. A band that is empty is a problem of `value`.
bool closes_band(const ExperimentTarget& target, const std::vector<ExperimentTarget>& targets,
                 const Node& value, Problems& problems)
{
  const auto there = [&target](const ExperimentTarget& t) {
    return on_one_line(t.direction_deg, target.direction_deg);
  };
  if (std::ranges::count_if(targets, there) != 1) return false;
  const auto other = std::ranges::find_if(targets, there);
  if (other->aim == target.aim || other->aim == Aim::reach || target.aim == Aim::reach) return false;
  const bool is_outer = target.aim == Aim::no_further;
  const double outer = is_outer ? target.value : other->value, inner = is_outer ? other->value : target.value;
  if (!(std::abs(inner) < std::abs(outer)))
    problems.add(value, "nothing is between the bounds of this direction: no_nearer than " +
                            format_number(inner) + " and no_further than " + format_number(outer));
  return true;
}

std::vector<ExperimentTarget> read_targets(const Node& section, const Experiment& experiment,
                                           Problems& problems)
{
  std::vector<ExperimentTarget> targets;
  const Node* list = find_typed(section, "targets", Node::Type::array);
  if (list == nullptr) return targets;
  std::vector<std::pair<const Node*, double>> directions;
  for (const Node& item : list->items) {
    const Node* direction = item.find("direction_deg");
    const Node* value = item.find("value");
    if (value != nullptr) check_target_value(*value, string_or(section, "quantity", ""), problems);
    if (direction == nullptr) continue;
    if (value == nullptr) {
      directions.emplace_back(direction, direction->number);
      continue;
    }
    const ExperimentTarget target{direction->number, value->number, number_or(item, "weight", 1.0),
                                  read_aim(item, problems)};
    if (!closes_band(target, targets, *value, problems))
      directions.emplace_back(direction, direction->number);
    targets.push_back(target);
  }
  check_directions(directions, experiment, problems);
  return targets;
}

/// A clearance of the design: not below the clearance at which surfaces touch, which is also its default.
double read_clearance(Node& section, const std::string& key, double least, Problems& problems)
{
  set_default(section, key, number_node(least));
  const Node& value = section.at(key);
  if (value.number < least) {
    problems.add(value, "expected at least solver.clearance, which is " + format_number(least) + ", found " +
                            format_number(value.number));
  }
  return value.number;
}

/// A range that a publication reports has both ends, in order.
void check_published(const Node& section, Problems& problems)
{
  const Node* published = find_typed(section, "published", Node::Type::object);
  if (published == nullptr) return;
  const std::optional<double> lowest = optional_number(*published, "lowest");
  const std::optional<double> highest = optional_number(*published, "highest");
  if (lowest.has_value() != highest.has_value()) {
    problems.add(*published, std::string("'lowest' and 'highest' belong together; '") +
                                 (lowest ? "highest" : "lowest") + "' is missing");
  } else if (lowest && *lowest > *highest) {
    problems.add(published->at("highest"), "expected at least 'lowest', which is " + format_number(*lowest) +
                                               ", found " + format_number(*highest));
  }
  const Node* measured = find_typed(*published, "measured", Node::Type::array);
  if (measured == nullptr) return;
  for (const Node& range : measured->items) {
    if (range.items.size() != 3) continue;  // told by the fields
    if (range.items[1].number > range.items[2].number)
      problems.add(range, "expected direction, smallest and largest value, in this order");
  }
}

}  // namespace

std::vector<double> ExperimentDesign::own_directions() const
{
  std::vector<double> out;
  for (const ExperimentTarget& target : targets) {
    const bool known = std::ranges::any_of(
        out, [&target](double angle) { return on_one_line(angle, target.direction_deg); });
    if (!known) out.push_back(target.direction_deg);
  }
  return out;
}

std::shared_ptr<const TaskSection> read_design(Node& section, SectionContext& context)
{
  const Experiment& experiment = context.experiment;
  Problems& problems = context.problems;
  auto read = std::make_shared<ExperimentDesign>();
  ExperimentDesign& design = *read;
  if (const Node* optimizer = section.find("optimizer")) {
    design.optimizer_plugin = string_or(*optimizer, "plugin", "");
    design.optimizer = context.plugins.optimizer(*optimizer, problems);
  }
  design.quantity = string_or(section, "quantity", "");
  if (experiment.load_case) check_quantity(section, *experiment.load_case, problems);
  if (const Node* variables = find_typed(section, "variables", Node::Type::array)) {
    design.variables = read_variables(*variables, context);
  }
  design.targets = read_targets(section, experiment, problems);
  check_published(section, problems);
  design.hole_clearance = read_clearance(section, "hole_clearance", experiment.solver.clearance, problems);
  design.rest_clearance = read_clearance(section, "rest_clearance", experiment.solver.clearance, problems);
  design.plain_value = string_or(section, "value", "") == "plain";
  design.starts = int_or(section, "starts", 1);
  design.perturbation = number_or(section, "perturbation", 0.0);
  design.max_iterations = optional_int(section, "max_iterations");
  design.tolerance = optional_number(section, "tolerance");
  return read;
}

}  // namespace hauberk
