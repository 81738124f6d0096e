#include "export/page.hpp"

#include "document/json_place.hpp"
#include "document/read_file.hpp"
#include "export/formats.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>
#include <boost/json/serialize.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>

namespace hauberk::exporting {
namespace {

namespace json = boost::json;
using detail::JsonPlace;

/// RFC 4648.
template <class Number>
std::string base64(const std::vector<Number>& numbers)
{
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes(numbers.size() * sizeof(Number));
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  std::string out;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 3; ++i) word = word << 8 | (i < left ? bytes[k + i] : 0U);
    for (std::size_t i = 0; i < 4; ++i) out += i <= left ? letters[word >> (18 - 6 * i) & 63U] : '=';
  }
  return out;
}

json::object mesh_json(const Assembly& assembly, std::size_t k)
{
  std::vector<float> points;
  for (const Vec3& x : assembly.meshes[k].points)
    for (const double component : x) points.push_back(static_cast<float>(component));
  std::vector<std::uint32_t> corners;
  for (const auto& t : assembly.meshes[k].triangles)
    for (const int corner : t) corners.push_back(static_cast<std::uint32_t>(corner));
  return {{"name", assembly.mesh_names[k]}, {"points", base64(points)}, {"triangles", base64(corners)}};
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

Vec3 vector_at(const JsonPlace& place)
{
  Vec3 x = Vec3::Zero();
  const auto entries = place.items();
  for (std::size_t k = 0; k < std::min<std::size_t>(3, entries.size()); ++k)
    x[static_cast<Eigen::Index>(k)] = entries[k].number();
  return x;
}

/// Contact forces of a limit, as they push the first element of each pair, in the first cell that is shown.
json::array forces_json(const JsonPlace& limit, const Fabric& fabric)
{
  json::array out;
  const auto contacts = limit.find("contacts");
  if (!contacts) return out;
  for (const JsonPlace& contact : contacts->items()) {
    const double size = contact.at("force").number();
    const auto elements = contact.at("elements").items(), points = contact.at("points").items();
    if (!(size > 0.0) || elements.size() != 2 || points.empty()) continue;
    const auto name = [&](std::size_t k) {
      const auto element = static_cast<std::size_t>(elements[k].integer());
      return element < fabric.elements.size() ? fmt::format("{} {}", fabric.elements[element].type, element)
                                              : "";
    };
    const auto vector = [](const Vec3& x) { return json::array{x.x(), x.y(), x.z()}; };
    out.push_back(json::object{{"at", vector(vector_at(points[0]))},
                               {"normal", vector(-vector_at(contact.at("normal")))},
                               {"size", size},
                               {"pair", name(0) + " on " + name(1)}});
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

/// Enters the limits of results, and those that have poses as states.
void enter_limits(const JsonPlace& document, const Assembly& rest, const std::string& file,
                  const SceneSpec& scene, json::object& out)
{
  const auto limits = document.find("limits");
  if (!limits) return;
  json::array& states = out["states"].as_array();
  json::array& table = out["limits"].as_array();
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
    if (sense == "up" || sense == "down") {
      out["bends"] = true;
      out["words"] = json::array{"up", "down"};
    }
    if (value && poses && poses->items().size() == scene.elements.size()) {
      const Fabric there = fabric_in_results(document.value(), file, scene, fmt::format("limit:{}", number));
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
json::array facts_of(const JsonPlace* document, const Assembly& rest)
{
  json::array facts{json::array{"elements shown", std::to_string(rest.copies.size())},
                    json::array{"unit", rest.unit}};
  if (document == nullptr) return facts;
  const JsonPlace experiment = document->at("experiment");
  facts.push_back(json::array{"load case", experiment.at("load_case").at("plugin").text()});
  if (const auto solver = experiment.find("solver")) {
    if (const auto clearance = solver->optional_number("clearance"))
      facts.push_back(json::array{"clearance", fmt::format("{:g} {}", *clearance, rest.unit)});
    if (const auto preset = solver->find("preset")) facts.push_back(json::array{"preset", preset->text()});
  }
  facts.push_back(json::array{"computed by", "Hauberk " + document->at("provenance").at("version").text()});
  return facts;
}

std::string replaced(std::string text, const std::string& mark, const std::string& by)
{
  const std::size_t at = text.find(mark);
  if (at == std::string::npos)
    throw ComputationError("page.html has no place " + mark + "; install it again");
  return text.replace(at, mark.size(), by);
}

}  // namespace

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

std::string page(const Assembly& rest, const json::value& results, const std::string& file,
                 const SceneSpec& scene, const PageParts& parts)
{
  json::object out{{"name", rest.name},
                   {"unit", rest.unit},
                   {"bends", false},
                   {"words", json::array{"stretch", "compression"}}};
  json::array& meshes = out["meshes"].emplace_array();
  for (std::size_t k = 0; k < rest.meshes.size(); ++k) meshes.push_back(mesh_json(rest, k));
  json::array& colours = out["colours"].emplace_array();
  constexpr int shades = 8;
  for (int k = 0; k < shades; ++k) {
    const auto c = colour_of(k);
    colours.push_back(json::array{c[0], c[1], c[2]});
  }
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
  const JsonPlace document(results, file);
  if (!results.is_null()) enter_limits(document, rest, file, scene, out);
  out["facts"] = facts_of(results.is_null() ? nullptr : &document, rest);
  // A name that ends the script would end it: "<" is written so that it stays within the text.
  std::string data;
  for (const char c : json::serialize(out)) {
    if (c == '<')
      data += "\\u003c";
    else
      data += c;
  }
  return replaced(replaced(parts.html, "@FABRIC@", data), "@VIEWER@", parts.viewer);
}

}  // namespace hauberk::exporting
