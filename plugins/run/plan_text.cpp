#include "run/plan_text.hpp"

#include "results/direction_json.hpp"

#include <boost/json/array.hpp>
#include <boost/json/value_from.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// Directions by sense and by what the links say about them.
std::string bounded_text(const Prepared& prepared, const Plan& plan)
{
  std::map<std::pair<std::string, std::string>, std::vector<Direction>> groups;
  for (const auto& [task, what] : plan.bounded)
    groups[{sense_name(prepared, task), what}].push_back(task.direction);
  std::string text;
  for (const auto& [key, directions] : groups)
    text += fmt::format("  {} {}: {}\n", key.first, key.second, directions_text(directions));
  return text;
}

}  // namespace

json::object plan_json(const Prepared& prepared, const Plan& plan)
{
  const Plan& p = plan;
  json::object out;
  out["length"] = p.length;
  out["elements"] = p.elements;
  out["primitives"] = p.primitives;
  out["unknowns"] = p.unknowns;
  out["inert"] = p.inert;
  out["linear_solver"] = p.linear_solver;
  json::array& pairs = out["pairs"].emplace_array();
  for (const PairPlan& k : p.pairs)
    pairs.push_back({{"kinds", k.kinds}, {"distance", k.distance}, {"pairs", k.pairs}});
  out["image_pairs"] = p.image_pairs;
  out["farthest_image"] = boost::json::value_from(shown(p.farthest_image));
  out["links_per_element"] = json::array(p.links_per_element.begin(), p.links_per_element.end());
  json::array& tightest = out["tightest"].emplace_array();
  for (const TightPair& t : p.tightest)
    tightest.push_back({{"elements", {t.elements[0], t.elements[1]}},
                        {"primitives", {t.primitives[0], t.primitives[1]}},
                        {"image", boost::json::value_from(shown(t.image))},
                        {"distance", t.distance},
                        {"linked", t.linked}});
  json::array& decisions = out["decisions"].emplace_array();
  for (const std::string& d : p.decisions) decisions.push_back(json::string(d));
  json::array& bounded = out["bounded"].emplace_array();
  for (const auto& [task, what] : p.bounded) {
    json::object entry;
    enter_direction(entry, task.direction);
    entry["sense"] = sense_name(prepared, task);
    entry["bounded"] = what;
    bounded.push_back(std::move(entry));
  }
  out["rest_moved"] = prepared.moved;
  return out;
}

std::string plan_text(const Prepared& prepared, const Plan& plan)
{
  const Plan& p = plan;
  const std::string& unit = prepared.experiment.length_unit;
  std::string text = fmt::format("{}\n\nModel\n", prepared.experiment.name);
  text += fmt::format("  {} elements of {} primitives in the cell; characteristic length L = {:.6g} {}\n",
                      p.elements, p.primitives, p.length, unit);
  text += fmt::format("  {} unknowns; {} of them inert; linear solver: {}\n", p.unknowns, p.inert,
                      p.linear_solver);
  text += fmt::format("  {} pairs of elements within reach at rest; farthest image [{}]\n", p.image_pairs,
                      fmt::join(shown(p.farthest_image), ", "));
  for (const PairPlan& k : p.pairs) text += fmt::format("  {} pairs {}: {}\n", k.pairs, k.kinds, k.distance);
  for (const std::string& d : p.decisions) text += fmt::format("  {}\n", d);
  text += "\nLimits, as far as links decide\n" + bounded_text(prepared, plan);

  text += "\nRest state\n";
  text += prepared.moved > 0.0
              ? fmt::format("  relaxed: elements moved by up to {:.3g} {}\n", prepared.moved, unit)
              : "  as given: nothing touches\n";
  text += fmt::format("  links per element: {}\n", links_text(p.links_per_element));
  if (!p.tightest.empty()) text += "  tightest pairs (element.primitive):\n";
  for (const TightPair& t : p.tightest)
    text += fmt::format("    {}.{} - {}.{} of image [{}]: {:.6g} {}{}\n", t.elements[0], t.primitives[0],
                        t.elements[1], t.primitives[1], fmt::join(shown(t.image), ", "), t.distance, unit,
                        t.linked ? ", linked" : "");
  return text;
}

}  // namespace hauberk
