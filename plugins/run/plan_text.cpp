#include "run/plan_text.hpp"

#include "results/direction_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/json/array.hpp>
#include <boost/json/value_from.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace hauberk {
namespace {

namespace json = boost::json;

std::string sense_name(const Prepared& prepared, const LimitTask& task)
{
  return prepared.experiment.load_case->sense_name(task.direction, task.sense);
}

/// "4 each", or "0: 4, 1: 2, ...".
std::string links_text(const std::vector<int>& links)
{
  bool equal = true;
  for (const int n : links) equal = equal && n == links.front();
  if (equal && !links.empty()) return fmt::format("{} each", links.front());
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < links.size(); ++k) parts.push_back(fmt::format("{}: {}", k, links[k]));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// "0, 30 degrees"; "(1, 0, 0), (0, 1, 0)", or how many there are.
std::string directions_text(const std::vector<Direction>& directions)
{
  constexpr std::size_t most_listed = 12;
  std::vector<std::string> parts;
  parts.reserve(directions.size());
  for (const Direction& d : directions)
    parts.push_back(d.is_angle() ? fmt::format("{}", d.degrees()) : d.text());
  const bool angles = directions.front().is_angle();
  if (!angles && parts.size() > most_listed) return fmt::format("{} directions", parts.size());
  return fmt::format("{}{}", fmt::join(parts, ", "), angles ? " degrees" : "");
}

std::string words(Reduction reduction)
{
  switch (reduction) {
    case Reduction::meshes:
      return "meshes: points and triangles, edges and edges, nearest points in closed form";
    case Reduction::two_curves:
      return "distance of two curves minus radii: both coordinates searched";
    case Reduction::curve_and_torus:
      return "one coordinate of the curve searched, the distance to the torus in closed form or by one angle";
    case Reduction::two_circles:
      return "distance of two circles minus radii: one angle searched, the other in closed form";
    case Reduction::circle_and_surface:
      return "distance of a circle to a revolved ellipse: one angle searched, point-ellipse in the meridian "
             "plane";
    case Reduction::solids:
      return "the probe of one searched in the distance field of the other; a solid's are its plugin's";
    case Reduction::two_surfaces:
      break;
  }
  return "two angles searched on one surface, point-ellipse in the meridian plane of the other";
}

std::string kinds_of(const PairPlan& pair)
{
  return fmt::format("{} / {}", name_of(pair.kinds[0]), name_of(pair.kinds[1]));
}

std::string linear_solver(const Plan& p)
{
  return p.sparse ? "sparse L D L^T (multifrontal, ordered by CHOLMOD)" : "dense Cholesky";
}

std::string mesh_words(const MeshPlan& mesh)
{
  const std::string triangles =
      mesh.least_triangles == mesh.most_triangles
          ? fmt::format("{} triangles and {} edges", mesh.most_triangles, mesh.most_edges)
          : fmt::format("{} to {} triangles", mesh.least_triangles, mesh.most_triangles);
  return fmt::format("contact: of meshes in every stage, {} a primitive; values are those of the meshes",
                     triangles);
}

std::string contact_words(const Plan& p)
{
  switch (p.contact) {
    case ContactChoice::automatic:
      break;
    case ContactChoice::nearest:
      return "contact: nearest in every stage";
    case ContactChoice::arc:
      return "contact: arc in every stage";
    case ContactChoice::published:
      return "contact: published in every stage (squared distances of charts, faded by an eigenvalue)";
    case ContactChoice::mesh:
      return mesh_words(*p.mesh);
    case ContactChoice::constrained:
      return fmt::format(
          "contact: gaps of at least {:g} L as constraints of quadratic programs, no energy; "
          "nothing is certified on the way",
          constrained_margin(p.schedule));
  }
  if (!p.stages.empty() && is_wide(p.stages.front().g_hat, p.schedule) &&
      p.stages.front().formulation == Formulation::nearest)
    return "contact: nearest, as all are solids that are probed over their surface; arc where contacts "
           "merge, and from where nearest stalls";
  return fmt::format(
      "contact: arc down to an activation distance of {:g} L, nearest below; arc again where "
      "contacts merge, and from where nearest stalls",
      p.schedule.change);
}

/// What was left out or chosen, and why, in sentences.
std::vector<std::string> decisions(const Plan& p)
{
  std::vector<std::string> out;
  if (p.inert > 0) {
    out.push_back(
        fmt::format("{} elements are surfaces of revolution about one axis: their spin is inert and "
                    "carries only the regularisation of null directions",
                    p.inert));
  }
  if (p.height_fixed) out.emplace_back("z is fixed: one unknown less per element");
  if (p.circles_only)
    out.emplace_back("every cross-section is a circle: no surface is searched in two angles");
  out.push_back(contact_words(p));
  if (p.schedule.search == MinimaSearch::sampled)
    out.emplace_back("closest points: Newton's method from samples, a minimum may be missed");
  if (p.schedule.ccd == CollisionCheck::sampled)
    out.emplace_back("collisions: sought from samples along each step, one may be missed");
  if (std::isfinite(p.schedule.target)) {
    out.push_back(
        fmt::format("objective: squared distance of the macroscopic unknowns to {:g} times the load; "
                    "it holds back what carries no load",
                    p.schedule.target));
  }
  if (!p.stages.empty()) {
    out.push_back(fmt::format("stages: {}, activation distances {:g} L to {:g} L", p.stages.size(),
                              p.stages.front().g_hat, p.stages.back().g_hat));
  }
  if (p.company > 0)
    out.push_back(fmt::format("search: limits learn from {} others that are not reported", p.company));
  return out;
}

/// Directions by sense and by what the links say about them.
std::string bounded_text(const Prepared& prepared, const Plan& plan)
{
  std::map<std::pair<std::string, std::string>, std::vector<Direction>> groups;
  for (const auto& [task, what] : plan.bounded)
    groups[{sense_name(prepared, task), to_string(what)}].push_back(task.direction);
  std::string text;
  for (const auto& [key, directions] : groups)
    text += fmt::format("  {} {}: {}\n", key.first, key.second, directions_text(directions));
  return text;
}

}  // namespace

std::string to_string(Boundedness bounded)
{
  switch (bounded) {
    case Boundedness::attained:
      return "attained";
    case Boundedness::unbounded:
      return "unbounded";
    case Boundedness::not_attained:
      break;
  }
  return "not attained";
}

json::object plan_json(const Prepared& prepared, const Plan& plan)
{
  const Plan& p = plan;
  json::object out;
  out["length"] = p.length;
  out["elements"] = p.elements;
  out["primitives"] = p.primitives;
  out["unknowns"] = p.unknowns;
  out["inert"] = p.inert;
  out["linear_solver"] = linear_solver(p);
  json::array& pairs = out["pairs"].emplace_array();
  for (const PairPlan& k : p.pairs)
    pairs.push_back({{"kinds", kinds_of(k)}, {"distance", words(k.reduction)}, {"pairs", k.pairs}});
  out["image_pairs"] = p.image_pairs;
  out["farthest_image"] = boost::json::value_from(shown(p.farthest_image));
  out["links_per_element"] = json::array(p.links_per_element.begin(), p.links_per_element.end());
  json::array& stages = out["stages"].emplace_array();
  for (const PlannedStage& stage : p.stages)
    stages.push_back({{"g_hat", stage.g_hat}, {"contact", name_of(stage.formulation)}});
  json::array& chosen = out["decisions"].emplace_array();
  for (const std::string& d : decisions(p)) chosen.push_back(json::string(d));
  json::array& bounded = out["bounded"].emplace_array();
  for (const auto& [task, what] : p.bounded) {
    json::object entry;
    enter_direction(entry, task.direction);
    entry["sense"] = sense_name(prepared, task);
    entry["bounded"] = to_string(what);
    bounded.push_back(std::move(entry));
  }
  out["rest_moved"] = prepared.moved;
  return out;
}

json::array tightest_json(const std::vector<TightPair>& pairs)
{
  json::array out;
  for (const TightPair& t : pairs)
    out.push_back({{"elements", {t.elements[0], t.elements[1]}},
                   {"primitives", {t.primitives[0], t.primitives[1]}},
                   {"image", boost::json::value_from(shown(t.image))},
                   {"distance", t.distance},
                   {"linked", t.linked}});
  return out;
}

namespace {

/// A key as people read it.
std::string words(std::string_view key)
{
  std::string text(key);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string value_text(const json::value& value)
{
  if (const json::string* text = value.if_string()) return std::string(*text);
  if (value.is_double()) return fmt::format("{:g}", value.as_double());
  if (value.is_number()) return fmt::format("{}", value.to_number<std::int64_t>());
  std::vector<std::string> parts;
  if (const json::array* list = value.if_array()) {
    for (const json::value& item : *list) parts.push_back(value_text(item));
    return fmt::format("{}", fmt::join(parts, ", "));
  }
  for (const auto& [key, item] : value.as_object()) {
    const std::string text = value_text(item);
    parts.push_back(key == "name" ? text : fmt::format("{} {}", words(key), text));
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

/// A line per entry; of lists of objects a line per object.
std::string task_text(const std::string& task, const json::object& entries)
{
  if (entries.empty()) return {};
  std::string text = fmt::format("\nTask {}\n", task);
  for (const auto& [key, value] : entries) {
    const std::string name = words(key);
    const json::array* list = value.if_array();
    if (list == nullptr || list->empty() || !list->front().is_object()) {
      text += fmt::format("  {}: {}\n", name, value_text(value));
      continue;
    }
    text += fmt::format("  {}:\n", name);
    for (const json::value& item : *list) text += fmt::format("    {}\n", value_text(item));
  }
  return text;
}

}  // namespace

std::string plan_text(const Prepared& prepared, const Plan& plan, const json::object& task,
                      const std::vector<TightPair>& tightest)
{
  const Plan& p = plan;
  const std::string& unit = prepared.experiment.length_unit;
  std::string text = fmt::format("{}\n\nModel\n", prepared.experiment.name);
  text += fmt::format("  {} elements of {} primitives in the cell; characteristic length L = {:.6g} {}\n",
                      p.elements, p.primitives, p.length, unit);
  text += fmt::format("  {} unknowns; {} of them inert; linear solver: {}\n", p.unknowns, p.inert,
                      linear_solver(p));
  text += fmt::format("  {} pairs of elements within reach at rest; farthest image [{}]\n", p.image_pairs,
                      fmt::join(shown(p.farthest_image), ", "));
  for (const PairPlan& k : p.pairs)
    text += fmt::format("  {} pairs {}: {}\n", k.pairs, kinds_of(k), words(k.reduction));
  for (const std::string& d : decisions(p)) text += fmt::format("  {}\n", d);
  text += task_text(prepared.experiment.task, task);
  text += "\nLimits, as far as links decide\n" + bounded_text(prepared, plan);

  text += "\nRest state\n";
  text += prepared.moved > 0.0
              ? fmt::format("  relaxed: elements moved by up to {:.3g} {}\n", prepared.moved, unit)
              : "  as given: nothing touches\n";
  text += fmt::format("  links per element: {}\n", links_text(p.links_per_element));
  if (!tightest.empty()) text += "  tightest pairs (element.primitive):\n";
  for (const TightPair& t : tightest)
    text += fmt::format("    {}.{} - {}.{} of image [{}]: {:.6g} {}{}\n", t.elements[0], t.primitives[0],
                        t.elements[1], t.primitives[1], fmt::join(shown(t.image), ", "), t.distance, unit,
                        t.linked ? ", linked" : "");
  return text;
}

}  // namespace hauberk
