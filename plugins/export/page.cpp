#include "export/page.hpp"

#include "document/json_place.hpp"
#include "document/markup.hpp"
#include "document/plain_text.hpp"
#include "document/read_file.hpp"
#include "export/formats.hpp"
#include "results/aim_json.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>
#include <boost/json/serialize.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

namespace hauberk::exporting {
namespace {

namespace json = boost::json;
using detail::JsonPlace;

/// The bytes of numbers, least first, in base64.
template <class Number>
std::string packed(const std::vector<Number>& numbers)
{
  return base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

json::object mesh_json(const Assembly& assembly, std::size_t k)
{
  std::vector<float> points;
  for (const Vec3& x : assembly.meshes[k].points)
    for (const double component : x) points.push_back(static_cast<float>(component));
  std::vector<std::uint32_t> corners;
  for (const auto& t : assembly.meshes[k].triangles)
    for (const int corner : t) corners.push_back(static_cast<std::uint32_t>(corner));
  return {{"name", assembly.mesh_names[k]}, {"points", packed(points)}, {"triangles", packed(corners)}};
}

json::array pose_json(const Pose& pose)
{
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.rotation).normalized();
  const Vec3& x = pose.position;
  return {x.x(), x.y(), x.z(), q.w(), q.x(), q.y(), q.z()};
}

/// Where an image of the cell lies.
Vec3 shift_of(const std::vector<Vec3>& lattice, const std::array<int, 3>& image)
{
  Vec3 shift = Vec3::Zero();
  for (std::size_t v = 0; v < lattice.size(); ++v) shift += image[v] * lattice[v];
  return shift;
}

/// All copies as the elements of a state of the same fabric have them.
json::array poses_json(const Assembly& rest, const Fabric& state)
{
  json::array out;
  for (const Assembly::Copy& copy : rest.copies) {
    Pose pose = state.elements[static_cast<std::size_t>(copy.element)].pose;
    pose.position += shift_of(state.lattice, copy.image);
    out.push_back(pose_json(pose));
  }
  return out;
}

/// Contact forces of a limit, as they push the first element of each pair, in the first cell that is shown.
json::array forces_json(const JsonPlace& limit, const Fabric& fabric)
{
  const auto name = [&](int element) {
    const auto at = static_cast<std::size_t>(element);
    return element >= 0 && at < fabric.elements.size() ? fmt::format("{} {}", fabric.elements[at].type, at)
                                                       : "wall";
  };
  const auto vector = [](const Vec3& x) { return json::array{x.x(), x.y(), x.z()}; };
  json::array out;
  for (const ShownContact& contact : contacts_of(limit)) {
    const double size = contact.force.norm();
    if (!(size > 0.0)) continue;
    out.push_back(json::object{{"at", vector(contact.at[0])},
                               {"normal", vector(-contact.force / size)},
                               {"size", size},
                               {"pair", name(contact.elements[0]) + " on " + name(contact.elements[1])}});
  }
  return out;
}

/// "stretch at 30 degrees".
std::string label_of(const JsonPlace& limit, std::size_t number)
{
  const auto direction = limit.find("direction_deg");
  const std::string sense = limit.at("sense").text();
  return direction ? fmt::format("{} at {:g}\u00b0", sense, direction->number())
                   : fmt::format("{}, limit {}", sense, number);
}

/// The limits of `from`, a document or the initial design in it, as rows of the table; those that have poses
/// become states of the fabric, which is `moved` there.
template <class Moved>
void enter_limits(const JsonPlace& from, const Assembly& rest, const Moved& moved, json::object& fabric)
{
  const auto limits = from.find("limits");
  if (!limits) return;
  json::array& states = fabric["states"].as_array();
  json::array& table = fabric["limits"].as_array();
  std::size_t number = 0;
  for (const JsonPlace& limit : limits->items()) {
    const std::string sense = limit.at("sense").text(), status = limit.at("status").text();
    const auto direction = limit.find("direction_deg");
    const auto value = limit.find("value"), confidence = limit.find("confidence");
    const auto poses = limit.find("poses");
    json::object row{{"label", label_of(limit, number)},
                     {"direction", direction ? json::value(direction->number()) : json::value(nullptr)},
                     {"further", sense == "stretch" || sense == "up"},
                     {"value", value ? json::value(value->number()) : json::value(nullptr)},
                     {"status", status},
                     {"confidence", confidence ? confidence->at("word").text() : ""},
                     {"state", 0}};
    if (value && poses && !poses->items().empty()) {
      const Fabric there = moved(limit);
      row["state"] = states.size();
      states.push_back(json::object{{"label", row["label"]},
                                    {"value", row["value"]},
                                    {"poses", poses_json(rest, there)},
                                    {"forces", forces_json(limit, there)}});
    }
    table.push_back(std::move(row));
    ++number;
  }
}

/// What stands below the table.
json::array facts_of(const JsonPlace& document, const std::string& unit)
{
  json::array facts{json::array{"unit", unit}};
  const JsonPlace experiment = document.at("experiment");
  facts.push_back(json::array{"load case", experiment.at("load_case").at("plugin").text()});
  if (const auto solver = experiment.find("solver")) {
    // A named value stays its name where rows vary it.
    if (const auto clearance = solver->find("clearance"); clearance && clearance->value().is_number())
      facts.push_back(json::array{"clearance", fmt::format("{:g} {}", clearance->number(), unit)});
    if (const auto preset = solver->find("preset")) facts.push_back(json::array{"preset", preset->text()});
  }
  facts.push_back(json::array{"computed by", "Hauberk " + document.at("provenance").at("version").text()});
  return facts;
}

/// A sixteenth of the thinnest wire's radius.
double default_chord(const Fabric& fabric)
{
  double thin = std::numeric_limits<double>::infinity();
  for (const Fabric::Element& element : fabric.elements)
    thin = std::min(thin, wire_radius(element.primitives));
  return thin / 16.0;
}

Assembly assembled(const Fabric& fabric, const PageView& view)
{
  return assemble(fabric, view.repeat.value_or(shown_cells(fabric)), view.outline,
                  view.chord > 0.0 ? view.chord : default_chord(fabric));
}

/// Surfaces, copies, and the state at rest.
json::object fabric_json(const Assembly& rest, const std::string& label)
{
  json::object out{{"label", label}};
  json::array& meshes = out["meshes"].emplace_array();
  for (std::size_t k = 0; k < rest.meshes.size(); ++k) meshes.push_back(mesh_json(rest, k));
  double size = 0.0;
  for (const Mesh& mesh : rest.meshes)
    for (const Vec3& x : mesh.points) size = std::max(size, x.norm());
  out["size"] = size;
  json::array& copies = out["copies"].emplace_array();
  json::array at_rest;
  for (const Assembly::Copy& copy : rest.copies) {
    copies.push_back(json::object{{"mesh", copy.mesh}, {"element", copy.element}, {"name", copy.name}});
    at_rest.push_back(pose_json(copy.rest));
  }
  out["states"] = json::array{json::object{
      {"label", "at rest"}, {"value", nullptr}, {"poses", std::move(at_rest)}, {"forces", json::array{}}}};
  out["limits"].emplace_array();
  return out;
}

json::object blank_entry(const std::string& name, const std::string& unit, const PageView& view)
{
  json::object out{{"name", name},
                   {"unit", unit},
                   {"bends", false},
                   {"words", json::array{"stretch", "compression"}},
                   {"targets", json::array{}},
                   {"facts", json::array{json::array{"unit", unit}}}};
  json::array& figures = out["figures"].emplace_array();
  for (const Figure& figure : view.figures)
    figures.push_back(json::object{{"name", figure.name}, {"svg", base64(figure.svg)}});
  out["fabrics"].emplace_array();
  return out;
}

/// Names what limits are of a load case that bends.
void name_senses(json::object& entry)
{
  for (const json::value& fabric : entry["fabrics"].as_array()) {
    for (const json::value& limit : fabric.at("limits").as_array()) {
      const std::string label = limit.at("label").as_string().c_str();
      if (!label.starts_with("up") && !label.starts_with("down")) continue;
      entry["bends"] = true;
      entry["words"] = json::array{"up", "down"};
    }
  }
}

/// An iterate with the same shapes would be the same picture again.
constexpr std::size_t most_iterates = 40;

/// Initial fabric, iterates in its places, and what the design is aimed at.
void enter_design(const JsonPlace& design, const json::value& results, const std::string& file,
                  const SceneSpec& scene, const PageView& view, json::object& entry)
{
  json::array& fabrics = entry["fabrics"].as_array();
  const JsonPlace initial = design.at("initial");
  const Fabric begin = fabric_in_results(results, file, scene, "initial");
  const Assembly rest = assembled(begin, view);
  json::object first = fabric_json(rest, "initial");
  enter_limits(
      initial, rest, [&](const JsonPlace& limit) { return at_limit(begin, limit); }, first);
  fabrics.push_back(std::move(first));
  const auto iterates = design.at("history").items();
  PageView rough = view;  // each is seen for a moment
  if (rough.chord == 0.0) rough.chord = 4.0 * default_chord(begin);
  const std::size_t stride = iterates.size() / most_iterates + 1;
  for (std::size_t k = stride; k + 1 < iterates.size(); k += stride) {
    const auto variables = iterates[k].find("variables");
    if (!variables) break;
    try {  // an iterate that cannot be drawn is left out
      const Fabric there = with_design_values(begin, design.at("variables"), *variables, scene);
      fabrics.push_back(fabric_json(assembled(there, rough),
                                    fmt::format("iterate {}", iterates[k].at("iteration").integer())));
    } catch (const InputError&) {
      continue;
    }
  }
  json::array& targets = entry["targets"].as_array();
  const std::string quantity = design.at("quantity").text();
  if (quantity == "eta") return;  // no limit has that value
  for (const JsonPlace& target : design.at("targets").items()) {
    const auto direction = target.find("direction_deg");
    if (direction)
      targets.push_back(json::object{{"direction", direction->number()},
                                     {"value", target.at("target").number()},
                                     {"aim", to_string(read_aim(target))}});
  }
}

/// Names come from files that anybody may have written, and must not turn the direction of what is read.
void make_plain(json::value& value)
{
  if (json::string* text = value.if_string()) {
    *text = plain_text(*text);
  } else if (json::array* entries = value.if_array()) {
    for (json::value& entry : *entries) make_plain(entry);
  } else if (json::object* members = value.if_object()) {
    for (auto& [key, member] : *members) make_plain(member);
  }
}

std::string replaced(std::string text, const std::string& mark, const std::string& by)
{
  const std::size_t at = text.find(mark);
  if (at == std::string::npos)
    throw ComputationError("page.html has no place " + mark + "; install it again");
  return text.replace(at, mark.size(), by);
}

}  // namespace

std::array<int, 3> shown_cells(const Fabric& fabric)
{
  constexpr double elements = 24.0;
  const std::size_t vectors = fabric.lattice.size();
  if (vectors != 1 && vectors != 2) return {1, 1, 1};
  const double cells = elements / static_cast<double>(fabric.elements.size());
  const int along = std::max(1, static_cast<int>(std::lround(vectors == 1 ? cells : std::sqrt(cells))));
  return {along, vectors == 1 ? 1 : along, 1};
}

PageParts read_page_parts(const std::string& folder)
{
  const std::filesystem::path place = folder, viewer = place / "viewer.js";
  std::error_code unknown;
  if (!std::filesystem::exists(viewer, unknown))
    throw InputError(fmt::format(
        "the viewer of pages was not built: there is no {}; `share/setup.sh --viewer` builds it, with node and npm",
        viewer.string()));
  return {read_whole_file((place / "page.html").string(), largest_text),
          read_whole_file(viewer.string(), largest_text)};
}

json::object page_entry(const Fabric& rest, const PageView& view)
{
  json::object out = blank_entry(rest.name, rest.unit, view);
  out["fabrics"].as_array().push_back(fabric_json(assembled(rest, view), ""));
  return out;
}

json::object page_entry(const json::value& results, const std::string& file, const SceneSpec& scene,
                        const PageView& view)
{
  const JsonPlace document(results, file);
  const Fabric fabric = fabric_in_results(results, file, scene, "rest");
  json::object out = blank_entry(fabric.name, fabric.unit, view);
  if (const auto design = document.find("design")) enter_design(*design, results, file, scene, view, out);
  const bool designed = !out["fabrics"].as_array().empty();
  const Assembly rest = assembled(fabric, view);
  json::object last = fabric_json(rest, designed ? "designed" : "");
  enter_limits(
      document, rest, [&](const JsonPlace& limit) { return at_limit(fabric, limit); }, last);
  out["fabrics"].as_array().push_back(std::move(last));
  name_senses(out);
  out["facts"] = facts_of(document, fabric.unit);
  return out;
}

std::string page(std::vector<json::object> entries, const PageParts& parts)
{
  json::object out;
  json::array& colours = out["colours"].emplace_array();
  constexpr int shades = 8;
  for (int k = 0; k < shades; ++k) {
    const auto c = colour_of(k);
    colours.push_back(json::array{c[0], c[1], c[2]});
  }
  json::array& results = out["results"].emplace_array();
  for (json::object& entry : entries) make_plain(results.emplace_back(std::move(entry)));
  // A name that ends the script would end it: "<" is written so that it stays within the text.
  std::string data;
  for (const char c : json::serialize(out)) {
    if (c == '<')
      data += "\\u003c";
    else
      data += c;
  }
  return replaced(replaced(parts.html, "@VIEWER@", parts.viewer), "@FABRIC@", data);
}

}  // namespace hauberk::exporting
