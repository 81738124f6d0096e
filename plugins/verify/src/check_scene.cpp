#include "checks.hpp"
#include "layout.hpp"
#include "links.hpp"
#include "neighbours.hpp"
#include "read.hpp"
#include "solid_samples.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// Of numbers that the program writes out as it reads them, or after a few operations; times L for lengths.
constexpr double rounding = 1e-12;
/// Of entries of rotations that are made from degrees.
constexpr double turn_rounding = 1e-12;

std::string at_element(std::size_t k) { return fmt::format("elements/{}", k); }

void compare_cell(const Layout& laid, const Scene& scene, Sentences& problems)
{
  bool same = laid.cell.size() == scene.cell.size();
  for (std::size_t k = 0; same && k < laid.cell.size(); ++k)
    same = (laid.cell[k] - scene.cell[k]).norm() <= rounding * laid.cell[k].norm();
  if (!same) problems.emplace_back("cell_vectors: not those of the experiment times repeat");
}

/// Types and parameters; where a variable was designed its value counts.
void compare_parameters(const Layout& laid, const json::value& scene, const std::string& where,
                        Sentences& problems)
{
  const json::array& elements = array(member(scene, "elements", where), where + "/elements");
  for (std::size_t k = 0; k < laid.elements.size(); ++k) {
    const std::string at = where + "/" + at_element(k);
    const LaidElement& element = laid.elements[k];
    if (const std::string type = text(member(elements[k], "type", at), at + "/type"); type != element.type)
      problems.push_back(fmt::format("{}: {} expected, found {}", at_element(k), element.type, type));
    const json::value& found = member(elements[k], "parameters", at);
    const json::object* parameters = found.if_object();
    if (parameters == nullptr) throw Malformed(at + "/parameters: an object expected");
    for (const auto& [name, value] : *parameters) {
      const double x = number(value, at + "/parameters/" + std::string(name));
      const auto expected = element.parameters.find(std::string(name));
      if (expected == element.parameters.end())
        problems.push_back(fmt::format("{}: the experiment has no {}", at_element(k), std::string(name)));
      else if (!equal(x, expected->second, rounding))
        problems.push_back(fmt::format("{}: {} is {:.10g}, expected {:.10g}", at_element(k),
                                       std::string(name), x, expected->second));
    }
  }
}

/// A solid may have sizes that are no lengths.
bool same_solid(const Primitive& made, const Primitive& found, double length)
{
  bool same = made.name == found.name && made.solid_kind == found.solid_kind &&
              made.sizes.size() == found.sizes.size() &&
              (made.place.position - found.place.position).norm() <= rounding * length &&
              (made.place.rotation - found.place.rotation).cwiseAbs().maxCoeff() <= turn_rounding;
  for (const auto& [name, size] : made.sizes) {
    const auto other = found.sizes.find(name);
    same = same && other != found.sizes.end() && equal(other->second, size, rounding);
  }
  return same;
}

/// Whether two primitives are one surface under one name. A torus may be turned about its axis, and over.
bool same_primitive(const Primitive& made, const Primitive& found, double length)
{
  if (made.solid || found.solid) return made.solid && found.solid && same_solid(made, found, length);
  const auto near = [&](double a, double b) { return std::abs(a - b) <= rounding * length; };
  bool same = made.name == found.name && near(made.R, found.R) && near(made.r0, found.r0) &&
              near(made.r1, found.r1) &&
              (made.place.position - found.place.position).norm() <= rounding * length;
  if (made.curve.empty()) {
    const double off = made.place.rotation.col(2).cross(found.place.rotation.col(2)).norm();
    return same && found.curve.empty() && off <= turn_rounding;
  }
  same = same && made.curve.size() == found.curve.size() &&
         (made.place.rotation - found.place.rotation).cwiseAbs().maxCoeff() <= turn_rounding;
  for (std::size_t k = 0; same && k < made.curve.size(); ++k)
    for (std::size_t i = 0; i < 2; ++i)
      same = same && (made.curve[k][i] - found.curve[k][i]).norm() <= rounding * length;
  return same;
}

/// Primitives are what the shape makes of the scene's parameters.
void compare_primitives(const json::value& experiment, const Layout& laid, const Scene& scene,
                        const std::string& where, const VerifyShapes& shapes, Sentences& problems,
                        Record& record)
{
  const json::value& types = member(experiment, "elements", "/experiment");
  for (std::size_t k = 0; k < laid.elements.size(); ++k) {
    const LaidElement& element = laid.elements[k];
    const std::string of = "/experiment/elements/" + element.type;
    const json::value& section = member(types, element.type.c_str(), "/experiment/elements");
    const auto made = primitives_of(element.type, section, element.parameters, of, shapes);
    if (!made) {
      const bool mesh = text(member(section, "shape", of), of + "/shape") == "mesh";
      if (!mesh)
        record.skip(where + "/" + at_element(k) + "/primitives",
                    "primitives of shapes that are not known here");
      continue;
    }
    const std::vector<Primitive>& found = scene.elements[k].tori;
    bool same = made->size() == found.size();
    for (std::size_t p = 0; same && p < made->size(); ++p)
      same = same_primitive((*made)[p], found[p], scene.length);
    if (!same)
      problems.push_back(
          fmt::format("{}: primitives are not what its shape makes of its parameters", at_element(k)));
  }
}

/// Solids agree with themselves; equal ones are looked at once.
void check_solids(const Scene& scene, const VerifyTolerances& tolerances, Sentences& problems)
{
  std::set<std::pair<std::string, std::map<std::string, double>>> known;
  for (std::size_t k = 0; k < scene.elements.size(); ++k)
    for (const Primitive& p : scene.elements[k].tori) {
      if (!p.solid || !known.emplace(p.solid_kind, p.sizes).second) continue;
      if (const std::string found = disagreement(*p.solid, tolerances.chart); !found.empty())
        problems.push_back(fmt::format("{}: the {} \"{}\" contradicts itself: {}", at_element(k),
                                       p.solid_kind, p.name, found));
    }
}

double off_place(const Scene& scene, const Layout& laid, std::size_t k)
{
  const Place &placed = laid.elements[k].rest, &rest = scene.elements[k].rest;
  const double turned = (placed.rotation - rest.rotation).cwiseAbs().maxCoeff();
  const double reach = placed.position.norm() / scene.length + 1.0;
  return std::max((placed.position - rest.position).norm() / (reach * scene.length), turned);
}

/// Rest is as placed; or, where it may have been relaxed, it is linked as placed, and nothing overlaps.
std::string compare_rest(const Scene& scene, const Layout& laid, const Setting& setting, bool relaxed,
                         const VerifyTolerances& tolerances, const std::string& experiment_where,
                         Sentences& problems, Record& record)
{
  double most = 0.0;
  std::size_t which = 0;
  for (std::size_t k = 0; k < laid.elements.size(); ++k) {
    const double off = off_place(scene, laid, k);
    if (off > most) which = k;
    most = std::max(most, off);
  }
  // Where rest may have been relaxed another place would have come to the same rest.
  for (std::size_t k = 0; relaxed && k < laid.elements.size(); ++k)
    for (const char* key : {"position", "rotation"})
      record.skip(fmt::format("{}/cell/place/{}/{}", experiment_where, laid.elements[k].place, key),
                  "places from which rest may have been relaxed");
  if (most <= turn_rounding) return "rest as placed";
  if (!relaxed) {
    problems.push_back(
        fmt::format("{}: rest is {:.3g} off its place (in L and radians), and nothing was relaxed",
                    at_element(which), most));
    return {};
  }
  std::vector<Place> placed, rest;
  for (std::size_t k = 0; k < laid.elements.size(); ++k) {
    placed.push_back(laid.elements[k].rest);
    rest.push_back(scene.elements[k].rest);
  }
  const std::string changed =
      difference(links(scene, placed, Mat3::Identity()), links(scene, rest, Mat3::Identity()));
  if (!changed.empty()) problems.push_back("relaxed from its places to rest, not to the limit: " + changed);
  const auto closest =
      closest_pair(scene, rest, Mat3::Identity(), setting.clearance, tolerances.enclosure * scene.length);
  if (closest && closest->distance < setting.clearance - tolerances.wrong_side * scene.length)
    problems.push_back(
        fmt::format("rest: surfaces of elements {} and {} are {:.3g} closer than the clearance",
                    closest->pair.first, closest->pair.second, setting.clearance - closest->distance));
  return fmt::format("rest relaxed by up to {:.2g} L or radians", most);
}

/// The design starts from the parameters that the experiment gives.
void compare_initial(const Layout& laid, const std::vector<DesignedValue>& designed, Sentences& problems)
{
  for (const DesignedValue& value : designed)
    for (const auto& [k, name] : value.parameters)
      if (const double given = laid.elements.at(k).parameters.at(name); !equal(value.value, given, rounding))
        problems.push_back(fmt::format("{}: {} starts from {:.10g}, the experiment has {:.10g}",
                                       at_element(k), name, value.value, given));
}

bool may_relax(const json::value& experiment)
{
  const json::value* relax = member(experiment, "cell", "/experiment").as_object().if_contains("relax");
  return relax != nullptr && relax->is_bool() && relax->get_bool();
}

}  // namespace

VerifyLine check_scene(const SceneCheck& check, const VerifyTolerances& tolerances, Record& record)
{
  const json::value& experiment = *check.experiment;
  const std::string where = check.where;
  std::optional<Layout> laid = laid_out(experiment);
  const std::string own_experiment = check.experiment_where;
  if (!laid) {
    const std::string why = "scenes whose cell the stored experiment does not list";
    for (const char* part : {"/cell_vectors", "/elements"}) record.skip(where + part, why);
    for (const char* part : {"/elements", "/cell"}) record.skip(own_experiment + part, why);
    return {true, where + ": the experiment does not list what is in the cell", false};
  }
  Sentences problems;
  std::string rest;
  if (laid->elements.size() != check.scene->elements.size()) {
    problems.push_back(fmt::format("{} elements, the experiment places {}", check.scene->elements.size(),
                                   laid->elements.size()));
  } else {
    if (check.initial) compare_initial(*laid, check.designed, problems);
    for (const DesignedValue& value : check.designed)
      for (const auto& [k, name] : value.parameters) laid->elements.at(k).parameters[name] = value.value;
    compare_cell(*laid, *check.scene, problems);
    compare_parameters(*laid, *check.json, where, problems);
    compare_primitives(experiment, *laid, *check.scene, where, *check.shapes, problems, record);
    check_solids(*check.scene, tolerances, problems);
    rest = compare_rest(*check.scene, *laid, check.setting, check.relaxed || may_relax(experiment),
                        tolerances, own_experiment, problems, record);
  }
  // A patch is laid out around its apex, wherever its one element stands in a place of it.
  const json::object& cell = member(experiment, "cell", own_experiment).as_object();
  if (cell.contains("patch") && array(member(cell, "place", own_experiment), own_experiment).size() == 1)
    record.skip(own_experiment + "/cell/place/0/position", "places that a patch does not depend on");
  record.done(VerifyPart::scene, where, problems.empty());
  record.done(VerifyPart::scene, own_experiment, problems.empty());
  return {problems.empty(),
          fmt::format("{}: {}", where,
                      problems.empty() ? fmt::format("{} elements as the experiment has them, {}",
                                                     laid->elements.size(), rest)
                                       : fmt::format("{}", fmt::join(problems, "; ")))};
}

}  // namespace hauberk::verification
