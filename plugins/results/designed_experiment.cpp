#include "results/designed_experiment.hpp"

#include "document/json_text.hpp"
#include "results/json_parts.hpp"

#include <hauberk/error.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {
namespace {

namespace json = boost::json;
using detail::number;

/// {"axis", "degrees"} of a rotation, as experiments write it.
json::object rotation_json(const Mat3& rotation)
{
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(rotation).normalized());
  json::object out;
  out["axis"] = detail::vector_json(turn.axis());
  out["degrees"] = number(turn.angle() / degree);
  return out;
}

/// The entry of `elements` for one placed element: its type's entry with all parameters as numbers.
json::value own_entry(const json::object& elements, const ElementType& type, const PlacedElement& element)
{
  json::value entry = elements.at(type.name);
  json::object& parameters = entry.as_object()["parameters"].emplace_object();
  const auto& infos = type.shape->parameters();
  for (std::size_t i = 0; i < infos.size() && i < element.parameters.size(); ++i)
    parameters[infos[i].name] = number(element.parameters[i]);
  return entry;
}

/// What equal elements have in common: type and parameters.
using Kind = std::pair<int, std::vector<double>>;

Kind kind_of(const PlacedElement& element) { return {element.type, element.parameters}; }

/// The type's name where all of its elements are equal, else with the index of the kind's first element.
std::map<Kind, std::string> names_of_kinds(const SceneSpec& scene)
{
  std::map<Kind, std::size_t> first;
  std::map<int, int> kinds;  // of each type
  for (std::size_t k = 0; k < scene.elements.size(); ++k)
    if (first.emplace(kind_of(scene.elements[k]), k).second) ++kinds[scene.elements[k].type];
  // Names that need no index are taken first, so that they stay.
  std::map<Kind, std::string> out;
  std::set<std::string> taken;
  for (const bool indexed : {false, true}) {
    for (const auto& [kind, k] : first) {
      if (indexed != (kinds.at(kind.first) > 1)) continue;
      std::string name = scene.types.at(static_cast<std::size_t>(kind.first)).name;
      if (indexed) name += "_" + std::to_string(k);
      while (!taken.insert(name).second) name += "_";
      out.emplace(kind, std::move(name));
    }
  }
  return out;
}

/// The experiment as one of limits, without sections of tasks and what they are expected to give, which
/// belong to the file as it was.
json::object scene_alone(json::object experiment)
{
  const json::value* name = experiment.if_contains("name");
  experiment["name"] =
      (name && name->is_string() ? std::string(name->get_string()) : std::string("scene")) + "_designed";
  experiment["task"] = "limits";
  constexpr std::array kept{"$schema", "name",     "description", "task",      "length_unit",
                            "seed",    "elements", "cell",        "load_case", "solver"};
  json::object out;
  for (json::key_value_pair& member : experiment) {
    if (std::find(kept.begin(), kept.end(), member.key()) != kept.end())
      out[member.key()] = std::move(member.value());
  }
  return out;
}

}  // namespace

json::object designed_experiment(const std::string& experiment_json, const SceneSpec& scene)
{
  json::object out = parse_json(experiment_json, "resolved experiment").as_object();
  const json::object old_elements = out.at("elements").as_object();
  const std::map<Kind, std::string> names = names_of_kinds(scene);
  json::object elements;
  json::array place;
  for (const PlacedElement& element : scene.elements) {
    const std::string& name = names.at(kind_of(element));
    if (!elements.contains(name))
      elements[name] =
          own_entry(old_elements, scene.types.at(static_cast<std::size_t>(element.type)), element);
    json::object entry;
    entry["element"] = name;
    entry["position"] = detail::vector_json(element.rest.position);
    entry["rotation"] = rotation_json(element.rest.rotation);
    place.push_back(std::move(entry));
  }
  out["elements"] = std::move(elements);

  json::object& cell = out.at("cell").as_object();
  if (scene.lattice.empty()) {  // a patch: one cell that holds every element
    json::object& patch = cell.at("patch").as_object();
    patch["outline"] = json::object{{"rectangle", {1, 1}}};
    patch["tile"] = {1, 1};
  } else {
    json::array vectors;
    for (const Vec3& v : scene.lattice)
      vectors.push_back(detail::lattice_vector_json(v, scene.lattice.size()));
    cell["vectors"] = std::move(vectors);
    cell.erase("strip");  // which is laid out
    cell["repeat"] = {1, 1};
  }
  cell["place"] = std::move(place);

  return scene_alone(std::move(out));
}

std::optional<json::object> designed_fabric(const std::string& experiment_json, const SceneSpec& scene)
{
  json::object out = parse_json(experiment_json, "resolved experiment").as_object();
  const std::map<Kind, std::string> names = names_of_kinds(scene);
  json::object& elements = out.at("elements").as_object();
  std::set<int> seen;
  for (const auto& [kind, name] : names)
    if (!seen.insert(kind.first).second) return std::nullopt;
  json::object& cell = out.at("cell").as_object();
  for (const json::value& place : cell.at("place").as_array())
    if (place.as_object().contains("parameters")) return std::nullopt;
  const json::object old_elements = elements;
  for (const PlacedElement& element : scene.elements) {
    const ElementType& type = scene.types.at(static_cast<std::size_t>(element.type));
    elements[type.name] = own_entry(old_elements, type, element);
  }
  cell["relax"] = true;
  return scene_alone(std::move(out));
}

}  // namespace hauberk
