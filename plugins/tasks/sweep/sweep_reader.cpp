#include "document/check.hpp"
#include "document/json_writer.hpp"
#include "document/jsonc.hpp"
#include "document/node_access.hpp"
#include "tasks/sweep/sweep_section.hpp"
#include "tasks/variants/variants.hpp"

#include <hauberk/load_case.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {

namespace {

constexpr double most_rows = 10000;  ///< more is a slip of the keyboard

std::vector<SweepPlace> read_places(const Node& entry)
{
  std::vector<SweepPlace> out;
  const Node* list = find_typed(entry, "pointers", Node::Type::array);
  if (list == nullptr) return out;
  for (const Node& item : list->items) {
    if (item.is(Node::Type::string))
      out.push_back({item.string});
    else
      out.push_back(
          {string_or(item, "pointer", ""), number_or(item, "factor", 1.0), number_or(item, "offset", 0.0)});
  }
  return out;
}

/// Both ends as given; in between by interpolation of the values or of their logarithms.
std::vector<Node> spread(const Node& range, Problems& problems)
{
  const double from = number_or(range, "from", 0.0), to = number_or(range, "to", 0.0);
  const int count = int_or(range, "count", 2);
  const bool log = string_or(range, "scale", "linear") == "log";
  std::vector<Node> out;
  if (count > most_rows) {
    problems.add(range, "expected at most " + format_number(most_rows) + " values, found " +
                            format_number(static_cast<double>(count)));
    return out;
  }
  if (log && !(from > 0.0 && to > 0.0)) {
    problems.add(range, "a logarithmic scale needs positive ends, found " + format_number(from) + " and " +
                            format_number(to));
    return out;
  }
  out.reserve(count);
  for (int k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) / (count - 1);
    double x = log ? from * std::pow(to / from, t) : from + (to - from) * t;
    if (k == 0) x = from;
    if (k == count - 1) x = to;
    Node value = number_node(x);
    relocate(value, range.pointer, range.line);
    out.push_back(std::move(value));
  }
  return out;
}

SweepAxis read_axis(const Node& entry, Problems& problems)
{
  SweepAxis axis{string_or(entry, "name", ""), read_places(entry), {}, false};
  const Node* values = find_typed(entry, "values", Node::Type::array);
  const Node* range = find_typed(entry, "range", Node::Type::object);
  if ((values != nullptr) == (range != nullptr)) {
    problems.add(entry, "expected either values or range");
    return axis;
  }
  if (range != nullptr) {
    axis.values = spread(*range, problems);
    axis.logarithmic = string_or(*range, "scale", "linear") == "log";
  } else {
    axis.values = values->items;
  }
  for (const SweepPlace& place : axis.places) {
    if (place.factor == 1.0 && place.offset == 0.0) continue;
    for (const Node& value : axis.values) {
      if (!value.is(Node::Type::number))
        problems.add(value, "a factor or an offset needs numbers, found " + describe_found(value));
    }
  }
  return axis;
}

/// One of them is the other or holds it.
bool overlap(const std::string& a, const std::string& b)
{
  return pointer_within(a, b) || pointer_within(b, a);
}

bool varies(const ExperimentSweep& sweep, const std::string& pointer)
{
  return std::any_of(sweep.axes.begin(), sweep.axes.end(), [&](const SweepAxis& axis) {
    return std::any_of(axis.places.begin(), axis.places.end(),
                       [&](const SweepPlace& place) { return overlap(place.pointer, pointer); });
  });
}

/// "stretch 30" where all rows have these directions and senses. Directions that vary are told by their place
/// in the file; where senses vary, or the load case that names them, a row's limits have nothing in common
/// but their order.
std::vector<SweepMeasure> all_limits(const ExperimentSweep& sweep, const Experiment& experiment)
{
  const bool fixed = !varies(sweep, "/load_case/directions_deg");
  const bool same_senses = !varies(sweep, "/load_case/senses") && !varies(sweep, "/load_case/plugin");
  std::vector<SweepMeasure> out;
  if (!experiment.load_case) return out;
  const auto names = experiment.load_case->sense_names();
  for (std::size_t d = 0; d < experiment.directions_deg.size(); ++d) {
    for (const Sense sense : experiment.senses) {
      std::string name = sense == Sense::positive ? names.first : names.second;
      name += fixed ? " " + format_number(experiment.directions_deg[d])
                    : " in direction " + std::to_string(d + 1);
      if (!same_senses) name = "limit " + std::to_string(out.size() + 1);
      out.push_back({std::move(name), "/limits/" + std::to_string(out.size()) + "/value"});
    }
  }
  for (std::size_t d = 0; d < experiment.directions.size(); ++d) {
    const bool same = !varies(sweep, "/load_case/directions") && !varies(sweep, "/load_case/plugin");
    out.push_back({same ? "along " + experiment.directions[d].text() : "limit " + std::to_string(d + 1),
                   "/limits/" + std::to_string(d) + "/value"});
  }
  return out;
}

bool leads_somewhere(const Node& root, const std::string& pointer)
{
  const Node* node = &root;
  std::size_t start = 1;
  while (node != nullptr && start <= pointer.size()) {
    const std::size_t stop = std::min(pointer.find('/', start), pointer.size());
    const std::string key = pointer_key(std::string_view(pointer).substr(start, stop - start));
    start = stop + 1;
    if (!node->is(Node::Type::array)) {
      node = node->find(key);
      continue;
    }
    const auto at = std::find_if(node->items.begin(), node->items.end(), [&](const Node& item) {
      return std::to_string(&item - node->items.data()) == key;
    });
    node = at == node->items.end() ? nullptr : &*at;
  }
  return node != nullptr;
}

/// A parameter of a weave need not be written to be one; whether it is one the rows tell, which may have
/// other weaves.
bool is_weave_parameter(const Node& root, const std::string& pointer)
{
  const std::string parameters = "/cell/weave/parameters/";
  return pointer.starts_with(parameters) && pointer.find('/', parameters.size()) == std::string::npos &&
         leads_somewhere(root, "/cell/weave");
}

/// What is wrong with a pointer by itself; empty when nothing is.
std::string pointer_problem(const ExperimentSweep& sweep, const Node& resolved, const std::string& pointer)
{
  if (!pointer.starts_with('/'))
    return "expected a JSON pointer such as /solver/clearance, found " + quote_json(pointer);
  if (std::string problem = place_without_effect(sweep.base.formats, pointer, "rows", "vary");
      !problem.empty())
    return problem;
  if (!leads_somewhere(sweep.base.file, pointer) && !leads_somewhere(resolved, pointer) &&
      !is_weave_parameter(sweep.base.file, pointer))
    return "there is nothing at " + quote_json(pointer) + " of this experiment";
  return "";
}

}  // namespace

std::size_t ExperimentSweep::row_count() const
{
  std::size_t rows = 1;
  for (const SweepAxis& axis : axes) rows *= axis.values.size();
  return rows;
}

std::vector<std::size_t> ExperimentSweep::indices(std::size_t row) const
{
  std::vector<std::size_t> out(axes.size());
  for (std::size_t k = axes.size(); k-- > 0;) {
    out[k] = row % axes[k].values.size();
    row /= axes[k].values.size();
  }
  return out;
}

std::shared_ptr<const TaskSection> read_sweep(Node& section, SectionContext& context)
{
  Problems& problems = context.problems;
  auto sweep = std::make_shared<ExperimentSweep>();
  ExperimentSweep& out = *sweep;
  out.base = context.base;
  const Node* vary = find_typed(section, "vary", Node::Type::array);
  if (vary == nullptr) return sweep;
  double rows = 1.0;
  for (const Node& entry : vary->items) {
    out.axes.push_back(read_axis(entry, problems));
    rows *= static_cast<double>(out.axes.back().values.size());
  }
  check_names(*vary, out.axes, "the name", problems);
  if (rows > most_rows)
    problems.add(*vary,
                 "expected at most " + format_number(most_rows) + " rows, found " + format_number(rows));
  if (const Node* measure = find_typed(section, "measure", Node::Type::array)) {
    for (const Node& item : measure->items) {
      out.measure.push_back({string_or(item, "name", ""), string_or(item, "pointer", "")});
      if (!out.measure.back().pointer.starts_with('/'))
        problems.add(item, "expected a JSON pointer such as /limits/0/value, found " +
                               quote_json(out.measure.back().pointer));
      else if (out.measure.back().pointer.ends_with("/seconds"))
        problems.add(item, "times differ from run to run and are no measure of a row; timings.json has them");
    }
    check_names(*measure, out.measure, "the name", problems);
  } else {
    out.measure = all_limits(out, context.experiment);
  }
  return sweep;
}

void check_sweep(const TaskSection& section, const Node& resolved, Problems& problems)
{
  const auto& sweep = dynamic_cast<const ExperimentSweep&>(section);
  std::vector<std::pair<std::string, std::string>> before;  // pointer, name of its axis
  for (std::size_t k = 0; k < sweep.axes.size(); ++k) {
    const Node& list = resolved.at("sweep").at("vary").items[k].at("pointers");
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      const std::string& pointer = sweep.axes[k].places[i].pointer;
      if (const std::string problem = pointer_problem(sweep, resolved, pointer); !problem.empty()) {
        problems.add(list.items[i], problem);
        continue;
      }
      for (const auto& [other, axis] : before) {
        if (overlap(pointer, other))
          problems.add(list.items[i], quote_json(pointer) + " is varied already, by " + quote_json(other) +
                                          " of '" + axis + "'; remove one of the two");
      }
      before.emplace_back(pointer, sweep.axes[k].name);
    }
  }
}

VariantReading read_sweep_row(const ExperimentSweep& sweep, std::size_t row, const std::string& name,
                              const PluginLookup& lookup, Diagnostics& diagnostics)
{
  std::vector<Assignment> values;
  const std::vector<std::size_t> at = sweep.indices(row);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Node& value = sweep.axes[k].values[at[k]];
    for (const SweepPlace& place : sweep.axes[k].places) {
      Node put = value;
      if (put.is(Node::Type::number)) put.number = place.factor * put.number + place.offset;
      values.push_back({place.pointer, std::move(put)});
    }
  }
  const std::string number = std::to_string(row);
  return read_variant(sweep.base, values, name + ", row " + number, "row " + number + ": ", lookup,
                      diagnostics);
}

}  // namespace hauberk
