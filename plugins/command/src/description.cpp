#include "description.hpp"

#include "tasks/table.hpp"

#include <hauberk/experiment/fields.hpp>

namespace hauberk::command {
namespace {

/// What --set may begin with: "/solver/preset=accurate" of a choice, "/solver/starts=" of a number.
void add_places(const Field& field, const std::string& place, std::vector<std::string>& places)
{
  switch (field.kind) {
    case Field::Kind::object:
      for (const Field& child : field.children) add_places(child, place + "/" + child.name, places);
      return;
    case Field::Kind::choice:
      for (const std::string& choice : field.choices) places.push_back(place + "=" + choice);
      return;
    case Field::Kind::boolean:
      places.push_back(place + "=true");
      places.push_back(place + "=false");
      return;
    case Field::Kind::number:
    case Field::Kind::integer:
    case Field::Kind::string:
      places.push_back(place + "=");
      return;
    default:  // lists, and what has names of its own
      return;
  }
}

/// The same for every command, and made once.
const std::vector<std::string>& places_to_set()
{
  static const std::vector<std::string> all = [] {
    std::vector<std::string> places;
    for (const Field& section : experiment_fields(task_formats()).children)
      if (!section.name.starts_with('$')) add_places(section, "/" + section.name, places);  // not for editors
    return places;
  }();
  return all;
}

}  // namespace

Option help_option() { return {.name = "help", .letter = 'h', .help = "show this and exit"}; }

Option json_option() { return {.name = "json", .help = "as JSON, for programs"}; }

Option plugin_path_option()
{
  return {.name = "plugin-path",
          .takes = Takes::texts,
          .value = "DIR",
          .help = "folder that is searched for plugins first; may be repeated",
          .offer = Offer::folders};
}

std::vector<Option> experiment_options()
{
  return {{.name = "set",
           .takes = Takes::texts,
           .value = "path=value",
           .help = "replace a value of the file, e.g. /solver/tolerance=1e-3; may be repeated",
           .offer = Offer::words,
           .choices = places_to_set()},
          plugin_path_option()};
}

Argument experiment_argument() { return {.name = "EXPERIMENT.json", .offer = Offer::experiments}; }

std::vector<Option> joined(std::vector<Option> own, const std::vector<Option>& shared)
{
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

}  // namespace hauberk::command
