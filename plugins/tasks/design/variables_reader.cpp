#include "document/json_writer.hpp"
#include "document/node_access.hpp"
#include "tasks/design/design_section.hpp"

#include <hauberk/suggestion.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace hauberk {

namespace {

class VariablesReader {
 public:
  VariablesReader(const SceneSpec& scene, const std::vector<int>& tile_of, bool scene_complete,
                  Problems& problems)
      : scene_(scene), tile_of_(tile_of), scene_complete_(scene_complete), problems_(problems)
  {
  }

  void read(const Node& entry)
  {
    Entry e;
    e.node = &entry;
    e.per = string_or(entry, "per", "element");
    e.lower = optional_number(entry, "lower");
    e.upper = optional_number(entry, "upper");
    if (e.lower && e.upper && *e.lower >= *e.upper) {
      problems_.add(entry, "expected lower < upper, found lower " + format_number(*e.lower) + " and upper " +
                               format_number(*e.upper));
      e.lower = e.upper = std::nullopt;  // nothing more can be said about the bounds
    }
    const Node* parameters = entry.find("parameters");
    if (parameters == nullptr) return;
    if (parameters->is(Node::Type::string)) {
      read_name(e, *parameters);
    } else {
      const std::size_t first = variables.size();
      for (const Node& name : parameters->items) read_name(e, name);
      const Node* tied = entry.find("tied");
      if (tied != nullptr && tied->boolean) tie(*parameters, first);
    }
  }

  std::vector<ExperimentVariable> variables;

 private:
  struct Entry {
    const Node* node = nullptr;
    std::string per;
    std::optional<double> lower, upper;
  };

  const SceneSpec& scene_;
  const std::vector<int>& tile_of_;
  bool scene_complete_;
  Problems& problems_;
  std::map<std::pair<int, int>, const Node*> owner_;  ///< (element, parameter) -> entry that varies it

  /// Joins the variables from `first` on that differ in the parameter's name alone: k/ring.r0=ring.r1.
  void tie(const Node& names, std::size_t first)
  {
    std::vector<ExperimentVariable> joined;
    for (std::size_t k = first; k < variables.size(); ++k) {
      const std::string group = variables[k].name.substr(0, variables[k].name.find('/') + 1);
      const auto same = std::find_if(joined.begin(), joined.end(), [&group](const ExperimentVariable& v) {
        return v.name.starts_with(group);
      });
      if (same == joined.end()) {
        joined.push_back(variables[k]);
        continue;
      }
      if (variables[k].initial != same->initial) {
        problems_.add(names, "tied parameters must start equal, but " + same->name + " is " +
                                 format_number(same->initial) + " and " + variables[k].name + " is " +
                                 format_number(variables[k].initial));
        return;
      }
      same->name += "=" + variables[k].name.substr(group.size());
      same->parameters.insert(same->parameters.end(), variables[k].parameters.begin(),
                              variables[k].parameters.end());
    }
    variables.resize(first);
    variables.insert(variables.end(), joined.begin(), joined.end());
  }

  void read_name(const Entry& entry, const Node& name)
  {
    if (!check_known(name)) return;
    std::map<std::string, ExperimentVariable> groups;
    std::vector<std::string> order;
    for (std::size_t k = 0; k < scene_.elements.size(); ++k) {
      const ElementType& type = scene_.types[scene_.elements[k].type];
      const int parameter = type.shape ? parameter_index(*type.shape, name.string) : -1;
      if (parameter < 0) continue;
      const std::string group = entry.per == "all"    ? "*"
                                : entry.per == "type" ? type.name
                                                      : std::to_string(tile_of_[k]);
      if (!groups.contains(group)) order.push_back(group);
      ExperimentVariable& variable = groups[group];
      variable.name = group + "/" + name.string;
      variable.parameters.push_back({static_cast<int>(k), parameter});
    }
    if (order.empty() && scene_complete_) {
      problems_.add(name, "no placed element has the parameter '" + name.string + "'");
    }
    if (!claim(entry, name, groups, order)) return;
    check_shape_bounds(entry, name);
    std::vector<std::string> outside;
    for (const std::string& group : order) finish(entry, name, std::move(groups[group]), outside);
    report_outside(entry, name, outside);
  }

  bool check_known(const Node& name)
  {
    std::vector<std::string> known;
    bool all_shapes = true;
    for (const ElementType& type : scene_.types) {
      all_shapes &= type.shape != nullptr;
      if (!type.shape) continue;
      const std::vector<std::string> names = parameter_names(*type.shape);
      known.insert(known.end(), names.begin(), names.end());
    }
    if (std::find(known.begin(), known.end(), name.string) != known.end()) return true;
    // A shape that could not be made may be the one that has it.
    if (all_shapes) {
      problems_.add(name,
                    "no element has a parameter '" + name.string + "'" + suggestion(name.string, known));
    }
    return false;
  }

  /// Notes who varies what; reports the first overlap.
  bool claim(const Entry& entry, const Node& name, const std::map<std::string, ExperimentVariable>& groups,
             const std::vector<std::string>& order)
  {
    for (const std::string& group : order) {
      for (const ParameterRef& ref : groups.at(group).parameters) {
        const auto [place, fresh] = owner_.emplace(std::make_pair(ref.element, ref.parameter), entry.node);
        if (fresh) continue;
        problems_.add(name,
                      "parameter '" + name.string + "' of placed element " + std::to_string(ref.element) +
                          (place->second == entry.node ? " is listed twice"
                                                       : " is already varied by " + place->second->pointer));
        return false;
      }
    }
    return true;
  }

  /// The bounds must lie within what the shapes allow, and the parameter must be one that can be designed.
  void check_shape_bounds(const Entry& entry, const Node& name)
  {
    for (const ElementType& type : scene_.types) {
      const int index = type.shape ? parameter_index(*type.shape, name.string) : -1;
      if (index < 0) continue;
      const ParameterInfo& info = type.shape->parameters()[index];
      if (!info.smooth) {
        problems_.add(name, "parameter '" + name.string + "' of element '" + type.name +
                                "' cannot be designed: the shape does not depend on it smoothly");
        return;
      }
      const bool low = entry.lower && *entry.lower < info.lower;
      const bool high = entry.upper && *entry.upper > info.upper;
      if (low) {
        problems_.add(entry.node->at("lower"), "expected at least " + format_number(info.lower) +
                                                   ", the least '" + name.string + "' may be, found " +
                                                   format_number(*entry.lower));
      }
      if (high) {
        problems_.add(entry.node->at("upper"), "expected at most " + format_number(info.upper) +
                                                   ", the most '" + name.string + "' may be, found " +
                                                   format_number(*entry.upper));
      }
      if (low || high) return;
    }
  }

  double value_of(const ParameterRef& ref) const
  {
    return scene_.elements[ref.element].parameters[ref.parameter];
  }

  void finish(const Entry& entry, const Node& name, ExperimentVariable variable,
              std::vector<std::string>& outside)
  {
    variable.initial = value_of(variable.parameters.front());
    variable.lower = entry.lower.value_or(0.0);
    variable.upper = entry.upper.value_or(0.0);
    for (const ParameterRef& ref : variable.parameters) {
      if (value_of(ref) == variable.initial || std::isnan(value_of(ref))) continue;
      problems_.add(name, "'" + variable.name +
                              "' varies elements whose values differ: " + format_number(variable.initial) +
                              " (placed element " + std::to_string(variable.parameters.front().element) +
                              ") and " + format_number(value_of(ref)) + " (" + std::to_string(ref.element) +
                              "); give them one value, or use per element");
      return;
    }
    if (entry.lower && entry.upper && (variable.initial < *entry.lower || variable.initial > *entry.upper)) {
      outside.push_back(format_number(variable.initial) + " of '" + variable.name + "'");
    }
    variables.push_back(std::move(variable));
  }

  void report_outside(const Entry& entry, const Node& name, const std::vector<std::string>& outside)
  {
    if (outside.empty()) return;
    std::string message = "the initial value " + outside.front() + " is outside [" +
                          format_number(*entry.lower) + ", " + format_number(*entry.upper) + "]";
    if (outside.size() > 1) message += ", and so are " + std::to_string(outside.size() - 1) + " more";
    problems_.add(name, message);
  }
};

}  // namespace

std::vector<ExperimentVariable> read_variables(const Node& list, const SectionContext& context)
{
  VariablesReader reader(context.experiment.scene, context.tile_of, context.scene_complete, context.problems);
  for (const Node& entry : list.items) reader.read(entry);
  return std::move(reader.variables);
}

}  // namespace hauberk
