#include "export/fabric.hpp"

#include "geometry/body.hpp"
#include "geometry/separation.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <span>

namespace hauberk::exporting {
namespace {

using detail::JsonPlace;

constexpr std::size_t most_copies = 100000;
/// Gaps are known to this part of them.
constexpr double certain = 1.0 - 1e-6;

Pose pose_at(const JsonPlace& place)
{
  const auto position = place.at("position").items(), q = place.at("quaternion").items();
  if (position.size() != 3 || q.size() != 4) place.fail("expected 3 numbers in position and 4 in quaternion");
  Pose pose;
  for (int k = 0; k < 3; ++k) pose.position[k] = position[k].number();
  const Eigen::Quaterniond turn(q[0].number(), q[1].number(), q[2].number(), q[3].number());
  if (!(turn.norm() > 0.5)) place.fail("expected a unit quaternion");
  pose.rotation = turn.normalized().toRotationMatrix();
  return pose;
}

Vec3 vector_at(const JsonPlace& place)
{
  Vec3 x = Vec3::Zero();
  const auto entries = place.items();
  for (std::size_t k = 0; k < std::min<std::size_t>(3, entries.size()); ++k) x[k] = entries[k].number();
  return x;
}

std::vector<Vec3> vectors_at(const JsonPlace& place)
{
  std::vector<Vec3> out;
  for (const JsonPlace& vector : place.items()) out.push_back(vector_at(vector));
  return out;
}

/// F of the strain of a limit; components that it does not name are nought.
Mat3 deformation(const JsonPlace& macro)
{
  const auto component = [&](const char* name) { return macro.optional_number(name).value_or(0.0); };
  Mat3 F = Mat3::Identity();
  F(0, 0) += component("exx");
  F(1, 1) += component("eyy");
  F(2, 2) += component("ezz");
  F(0, 1) = F(1, 0) = component("exy");
  F(0, 2) = F(2, 0) = component("exz");
  F(1, 2) = F(2, 1) = component("eyz");
  return F;
}

std::vector<ElementType>::const_iterator type_of(const Fabric::Element& element, const SceneSpec& scene)
{
  return std::find_if(scene.types.begin(), scene.types.end(),
                      [&](const ElementType& type) { return type.name == element.type; });
}

Fabric::Element element_at(const JsonPlace& place, const SceneSpec& scene)
{
  Fabric::Element element;
  element.type = place.at("type").text();
  const auto type = type_of(element, scene);
  if (type == scene.types.end()) place.at("type").fail("the experiment in the results has no such element");
  for (const ParameterInfo& info : type->shape->parameters())
    element.parameters.push_back(place.at("parameters").at(info.name.c_str()).number());
  element.primitives = type->shape->primitives(element.parameters);
  element.rest = element.pose = pose_at(place.at("rest"));
  return element;
}

/// The scene that a document or its design has, at rest.
void read_scene(const JsonPlace& place, const SceneSpec& shapes, Fabric& fabric)
{
  for (const JsonPlace& element : place.at("elements").items())
    fabric.elements.push_back(element_at(element, shapes));
  fabric.lattice = fabric.rest_lattice = vectors_at(place.at("cell_vectors"));
}

void move_to_limit(const JsonPlace& limit, Fabric& fabric)
{
  const auto poses = limit.at("poses").items();
  if (poses.size() != fabric.elements.size())
    limit.at("poses").fail(fmt::format("expected {} poses, found {}", fabric.elements.size(), poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) fabric.elements[k].pose = pose_at(poses[k]);
  const Mat3 F = deformation(limit.at("macro"));
  for (Vec3& v : fabric.lattice) v = (F * v).eval();
  const auto direction = limit.find("direction_deg");
  fabric.state += fmt::format(": {}{}", limit.at("sense").text(),
                              direction ? fmt::format(" at {:g} degrees", direction->number()) : "");
}

/// Names of limits at angles: "stretch:0, compress:0".
std::string names_of(const std::vector<JsonPlace>& limits)
{
  std::vector<std::string> names;
  for (const JsonPlace& limit : limits)
    if (const auto degrees = limit.optional_number("direction_deg"))
      names.push_back(fmt::format("{}:{:g}", limit.at("sense").text(), *degrees));
  constexpr std::size_t most = 12;
  const std::size_t more = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(", and {} more", more) : "");
}

/// The limit that "limit:K" or "SENSE:DEGREES" speaks of.
JsonPlace limit_of(const JsonPlace& document, const std::string& file, const std::string& state)
{
  const auto limits = document.find("limits");
  const std::vector<JsonPlace> all = limits ? limits->items() : std::vector<JsonPlace>{};
  const std::size_t colon = state.find(':');
  const std::string kind = state.substr(0, colon), text = state.substr(colon + 1);
  double number = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number =
      read.ec == std::errc{} && read.ptr == text.data() + text.size() && std::isfinite(number);
  if (kind == "limit") {
    if (is_number && number >= 0.0 && number < static_cast<double>(all.size()) &&
        number == std::floor(number))
      return all[number];
    throw InputError(fmt::format("--state {}: {} has {} limits{}", state, file, all.size(),
                                 all.empty() ? "" : fmt::format(", limit:0 to limit:{}", all.size() - 1)));
  }
  constexpr double same_direction = 1e-6;  // degrees; directions and their opposites are one
  for (const JsonPlace& limit : all) {
    const auto degrees = limit.optional_number("direction_deg");
    if (is_number && degrees && limit.at("sense").text() == kind &&
        std::abs(std::remainder(*degrees - number, 180.0)) < same_direction)
      return limit;
  }
  const std::string there = names_of(all);
  throw InputError(fmt::format("--state {}: {} has no such limit{}", state, file,
                               there.empty() ? "; give limit:K" : ", it has " + there));
}

/// What tells primitives apart: numbers that make the same surface are equal.
std::vector<double> signature(const Fabric::Element& element)
{
  std::vector<double> out;
  for (const Primitive& p : element.primitives) {
    for (const double x : p.position) out.push_back(x);
    for (const double x : p.rotation.reshaped()) out.push_back(x);
    for (const double x : p.size) out.push_back(x);
    for (const Harmonic& h : p.curve)
      for (int k = 0; k < 3; ++k) out.insert(out.end(), {h.c[k], h.s[k]});
    if (p.solid) out.insert(out.end(), p.solid->sizes().begin(), p.solid->sizes().end());
  }
  return out;
}

bool within(const Outline& outline, const Vec3& x)
{
  if (outline.radius > 0.0) return std::hypot(x.x(), x.y()) <= outline.radius;
  return std::abs(x.x()) <= outline.half_sides[0] && std::abs(x.y()) <= outline.half_sides[1];
}

/// At rest, so that all states show the same piece.
Vec3 middle_of(const std::vector<Assembly::Copy>& copies)
{
  Vec3 sum = Vec3::Zero();
  for (const auto& copy : copies) sum += copy.rest.position;
  return copies.empty() ? sum : Vec3(sum / static_cast<double>(copies.size()));
}

void keep_within(Assembly& assembly, const Outline& outline)
{
  const Vec3 middle = middle_of(assembly.copies);
  std::erase_if(assembly.copies,
                [&](const Assembly::Copy& c) { return !within(outline, c.rest.position - middle); });
  if (assembly.copies.empty())
    throw InputError("--outline: no element's middle lies within; give a larger one, or --repeat more cells");
}

/// Copies of one cell, `shift` cells along the vectors.
void add_cell(const Fabric& fabric, const std::vector<int>& mesh_of, const std::array<int, 3>& shift,
              bool named, Assembly& assembly)
{
  Vec3 moved = Vec3::Zero(), rest = Vec3::Zero();
  for (std::size_t v = 0; v < fabric.lattice.size(); ++v) {
    moved += shift[v] * fabric.lattice[v];
    rest += shift[v] * fabric.rest_lattice[v];
  }
  for (std::size_t k = 0; k < fabric.elements.size(); ++k) {
    const Fabric::Element& element = fabric.elements[k];
    Assembly::Copy copy{mesh_of[k],   static_cast<int>(k), shift, fmt::format("{} {}", element.type, k),
                        element.pose, element.rest};
    if (named) {
      const auto indices = std::span(shift).first(std::max<std::size_t>(fabric.lattice.size(), 1));
      copy.name += fmt::format(" [{}]", fmt::join(indices, ", "));
    }
    copy.pose.position += moved;
    copy.rest.position += rest;
    assembly.copies.push_back(std::move(copy));
  }
}

/// The meshes of a fabric's elements, each surface once, and which of them each element has.
std::vector<int> add_meshes(const Fabric& fabric, double chord, Assembly& assembly)
{
  std::map<std::pair<std::string, std::vector<double>>, int> known;
  std::map<std::string, int> of_type;
  std::vector<int> mesh_of;
  for (const Fabric::Element& element : fabric.elements) {
    const auto [entry, is_new] =
        known.try_emplace({element.type, signature(element)}, static_cast<int>(assembly.meshes.size()));
    mesh_of.push_back(entry->second);
    if (!is_new) continue;
    const double fine = chord > 0.0 ? chord : wire_radius(element.primitives) / 40.0;
    assembly.meshes.push_back(element_mesh(element.primitives, fine));
    assembly.primitives.push_back(element.primitives);
    const int number = of_type[element.type]++;
    assembly.mesh_names.push_back(number == 0 ? element.type
                                              : fmt::format("{} {}", element.type, number + 1));
  }
  return mesh_of;
}

}  // namespace

Fabric fabric_of(const SceneSpec& scene, const std::string& name, const std::string& unit)
{
  Fabric fabric;
  fabric.name = name;
  fabric.unit = unit;
  fabric.state = "rest";
  fabric.lattice = fabric.rest_lattice = scene.lattice;
  for (const PlacedElement& element : scene.elements) {
    const ElementType& type = scene.types[static_cast<std::size_t>(element.type)];
    fabric.elements.push_back({type.name, element.parameters, type.shape->primitives(element.parameters),
                               element.rest, element.rest});
  }
  return fabric;
}

Fabric fabric_in_results(const boost::json::value& results, const std::string& file, const SceneSpec& scene,
                         const std::string& state)
{
  const JsonPlace document(results, file);
  const JsonPlace experiment = document.at("experiment");
  const auto design = document.find("design");
  Fabric fabric;
  fabric.name = experiment.at("name").text();
  fabric.unit = experiment.at("length_unit").text();
  fabric.state = state;
  const bool is_limit = state.find(':') != std::string::npos;
  if (state != "rest" && state != "initial" && state != "final" && !is_limit)
    throw InputError(fmt::format(
        "--state {}: expected rest, initial, final, limit:K or SENSE:DEGREES, as stretch:0", state));
  if ((state == "initial" || state == "final") && !design)
    throw InputError(fmt::format(
        "--state {}: {} holds no design; its states are rest, limit:K and SENSE:DEGREES", state, file));
  const JsonPlace place = state == "initial" ? design->at("initial").at("scene") : document.at("scene");
  read_scene(place, scene, fabric);
  if (is_limit) {
    const JsonPlace limit = limit_of(document, file, state);
    move_to_limit(limit, fabric);
  }
  return fabric;
}

Fabric at_limit(const Fabric& rest, const JsonPlace& limit)
{
  Fabric out = rest;
  move_to_limit(limit, out);
  return out;
}

std::vector<ShownContact> contacts_of(const JsonPlace& limit)
{
  std::vector<ShownContact> out;
  const auto contacts = limit.find("contacts");
  if (!contacts) return out;
  for (const JsonPlace& place : contacts->items()) {
    const auto elements = place.at("elements").items();
    const std::vector<Vec3> points = vectors_at(place.at("points"));
    if (elements.size() != 2 || points.size() != 2) place.fail("expected 2 elements and 2 points");
    const double size = place.at("force").number();
    out.push_back({{static_cast<int>(elements[0].integer()), static_cast<int>(elements[1].integer())},
                   {points[0], points[1]},
                   size * vector_at(place.at("normal")),
                   place.optional_number("gap").value_or(0.0)});
  }
  return out;
}

std::vector<ShownContact> contacts_in_results(const boost::json::value& results, const std::string& file,
                                              const std::string& state)
{
  if (state.find(':') == std::string::npos)
    throw InputError(
        fmt::format("--state {}: only a limit has contact forces; give limit:K or SENSE:DEGREES", state));
  return contacts_of(limit_of(JsonPlace(results, file), file, state));
}

Fabric with_design_values(const Fabric& initial, const JsonPlace& variables, const JsonPlace& values,
                          const SceneSpec& scene)
{
  Fabric out = initial;
  const auto named = variables.items(), numbers = values.items();
  if (named.size() != numbers.size())
    values.fail(fmt::format("expected {} numbers, found {}", named.size(), numbers.size()));
  for (std::size_t k = 0; k < named.size(); ++k) {
    // "3/ring.r0=ring.r1": two parameters that are one variable.
    const std::string name = named[k].at("name").text();
    std::vector<std::string> parameters{""};
    for (const char c : name.substr(name.rfind('/') + 1)) {
      if (c == '=')
        parameters.emplace_back();
      else
        parameters.back() += c;
    }
    for (const JsonPlace& number : named[k].at("elements").items()) {
      const auto at = static_cast<std::size_t>(number.integer());
      if (at >= out.elements.size()) number.fail("there is no such element");
      Fabric::Element& element = out.elements[at];
      const std::vector<ParameterInfo> infos = type_of(element, scene)->shape->parameters();
      for (const std::string& parameter : parameters) {
        const auto info = std::find_if(infos.begin(), infos.end(),
                                       [&](const ParameterInfo& one) { return one.name == parameter; });
        if (info == infos.end()) named[k].at("name").fail("its elements have no such parameter");
        element.parameters[static_cast<std::size_t>(info - infos.begin())] = numbers[k].number();
      }
    }
  }
  for (Fabric::Element& element : out.elements)
    element.primitives = type_of(element, scene)->shape->primitives(element.parameters);
  return out;
}

std::array<int, 3> cells_that_fill(const Fabric& fabric, const Outline& outline)
{
  std::array<int, 3> out{1, 1, 1};
  if (fabric.lattice.empty() || fabric.lattice.size() > 2) return out;
  const bool chain = fabric.lattice.size() == 1;
  for (std::size_t v = 0; v < fabric.lattice.size(); ++v) {
    // Rows of cells lie between lines along the other vector.
    const Vec3& along = fabric.rest_lattice[v];
    const Vec3 across = chain ? along : Vec3(fabric.rest_lattice[1 - v].cross(Vec3::UnitZ()));
    const Vec3 normal = across.normalized();
    const double half = outline.radius > 0.0 ? outline.radius
                                             : outline.half_sides[0] * std::abs(normal.x()) +
                                                   outline.half_sides[1] * std::abs(normal.y());
    constexpr double most = 1e6;  // `assemble` refuses fewer
    // Elements of one cell may lie apart.
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Fabric::Element& element : fabric.elements) {
      low = std::min(low, normal.dot(element.rest.position));
      high = std::max(high, normal.dot(element.rest.position));
    }
    const double rows = std::ceil((2.0 * half + std::max(0.0, high - low)) / std::abs(normal.dot(along)));
    out[v] = 2 + static_cast<int>(std::min(rows, most));
  }
  return out;
}

Assembly assemble(const Fabric& fabric, std::array<int, 3> repeat, const std::optional<Outline>& outline,
                  double chord)
{
  for (std::size_t v = fabric.lattice.size(); v < 3; ++v) {
    if (repeat[v] != 1)
      throw InputError(fabric.lattice.empty()
                           ? std::string("--repeat: a patch is no cell, and has no copies")
                           : fmt::format("--repeat: the cell has {} vector{}; give as many numbers",
                                         fabric.lattice.size(), fabric.lattice.size() == 1 ? "" : "s"));
  }
  double copies = static_cast<double>(fabric.elements.size());
  for (const int n : repeat) copies *= n;
  if (copies > static_cast<double>(most_copies))
    throw InputError(fmt::format("{:.3g} elements, more than {}; give a smaller --repeat or --outline",
                                 copies, most_copies));
  Assembly assembly;
  assembly.name = fabric.name;
  assembly.unit = fabric.unit;
  assembly.state = fabric.state;
  const std::vector<int> mesh_of = add_meshes(fabric, chord, assembly);
  const bool named = repeat[0] * repeat[1] * repeat[2] > 1;
  for (int k = 0; k < repeat[2]; ++k)
    for (int j = 0; j < repeat[1]; ++j)
      for (int i = 0; i < repeat[0]; ++i) add_cell(fabric, mesh_of, {i, j, k}, named, assembly);
  if (outline) keep_within(assembly, *outline);
  return assembly;
}

std::optional<Nearest> nearest_copies(const Assembly& assembly, double enough)
{
  std::vector<std::vector<Body>> bodies;
  std::vector<double> reach;
  for (const auto& primitives : assembly.primitives) {
    auto& of_mesh = bodies.emplace_back();
    double most = 0.0;
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      of_mesh.push_back(make_body(primitives[k], 0, static_cast<int>(k), 1.0));
      most = std::max(most, of_mesh.back().reach);
    }
    reach.push_back(most);
  }
  std::optional<Nearest> out;
  double least = enough;
  const auto look = [&](const Assembly::Copy& a, const Assembly::Copy& b) {
    for (const Body& A : bodies[a.mesh]) {
      for (const Body& B : bodies[b.mesh]) {
        if (A.surface || B.surface) continue;  // only their facets know how far apart they are
        if (ball_gap(A, a.pose, B, b.pose, 0.0) >= least) continue;
        // Rough first: for pairs that are farther apart than the nearest so far, and because a search that is
        // exact spends itself on the first panels unless it knows how near others come.
        const Separation rough = separation(A, a.pose, B, b.pose, 0.0, least, 0.9);
        if (rough.lower >= least) continue;
        const double most = std::min(least, rough.upper);
        const Separation s = separation(A, a.pose, B, b.pose, 0.0, most, certain);
        const double upper = std::min(s.upper, rough.upper), lower = std::max(s.lower, rough.lower);
        const double rounding = 1e-9 * std::min(A.bound, B.bound);
        const bool known = lower >= certain * upper - rounding || upper <= 0.0;
        const double distance = known ? upper : lower;
        if (distance >= least) continue;
        least = distance;
        out = Nearest{distance, {a.name, b.name}, known};
      }
    }
  };
  // Copies in the order of their places along x, so that only those within reach are compared.
  std::vector<const Assembly::Copy*> order;
  for (const auto& copy : assembly.copies) order.push_back(&copy);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) { return a->pose.position.x() < b->pose.position.x(); });
  const double widest = reach.empty() ? 0.0 : *std::max_element(reach.begin(), reach.end());
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const double apart = order[j]->pose.position.x() - order[i]->pose.position.x();
      if (apart > 2.0 * widest + std::max(least, 0.0)) break;
      look(*order[i], *order[j]);
    }
  }
  return out;
}

}  // namespace hauberk::exporting
