#include "checks.hpp"
#include "read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <set>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// A target counts as met within this share of it.
constexpr double met_share = 0.05;

/// What a profile may rest on: only a locked state is a limit.
std::optional<double> value_of(const std::vector<Limit>& limits, double direction_deg,
                               const std::string& sense)
{
  const Limit* limit = find_limit(limits, direction_deg, sense);
  return limit && limit->status == "locked" ? limit->value : std::nullopt;
}

/// Names of the senses, positive first.
std::pair<std::string, std::string> senses(Load load)
{
  if (load != Load::paraboloid) return {"stretch", "compress"};
  return {"up", "down"};
}

/// The designed quantity in a direction.
std::optional<double> quantity(const std::string& name, const std::vector<Limit>& limits,
                               double direction_deg)
{
  if (name == "eta")
    return eta(value_of(limits, direction_deg, "stretch"), value_of(limits, direction_deg, "compress"));
  if (name == "curvature") return value_of(limits, direction_deg, "up");
  if (name != "stretch" && name != "compress")
    throw Malformed("/design/quantity: \"" + name + "\" is not known here");
  return value_of(limits, direction_deg, name);
}

/// sum of 1/2 weight (value - target)^2; nothing when a value is absent.
struct Objective {
  std::optional<double> sum = 0.0;
  void add(const std::optional<double>& value, double target, double weight)
  {
    if (value && sum)
      *sum += 0.5 * weight * (*value - target) * (*value - target);
    else
      sum.reset();
  }
};

bool flag(const json::value& object, const char* key, const std::string& where)
{
  const json::value& v = member(object, key, where);
  if (!v.is_bool()) throw Malformed(where + "/" + key + ": true or false expected");
  return v.get_bool();
}

void check_targets(const json::value& design, const std::vector<Limit>& initial,
                   const std::vector<Limit>& final, double tolerance, Sentences& problems)
{
  const std::string name = text(member(design, "quantity", "/design"), "/design/quantity");
  Objective before, after;
  std::size_t i = 0;
  for (const json::value& t : array(member(design, "targets", "/design"), "/design/targets")) {
    const std::string at = fmt::format("/design/targets/{}", i++);
    const double direction = number(member(t, "direction_deg", at), at),
                 target = number(member(t, "target", at), at);
    const double weight = number(member(t, "weight", at), at);
    const auto first = optional_number(t, "initial", at), last = optional_number(t, "recomputed", at);
    for (const auto& [what, reported, limits] :
         {std::tuple("initial", first, &initial), std::tuple("recomputed", last, &final)}) {
      const auto found = quantity(name, *limits, direction);
      if (!equal(reported, found, tolerance))
        problems.push_back(
            fmt::format("{}: {} {} reported, {} from the limits", at, what, show(reported), show(found)));
    }
    const bool met = last && std::abs(*last - target) <= met_share * std::abs(target);
    if (flag(t, "met", at) != met) problems.push_back(fmt::format("{}: met should be {}", at, met));
    before.add(first, target, weight);
    after.add(last, target, weight);
  }
  for (const auto& [key, objective] :
       {std::pair("objective_initial", before.sum), std::pair("objective", after.sum)}) {
    const auto reported = optional_number(design, key, "/design");
    if (objective && !equal(reported, objective, tolerance))
      problems.push_back(
          fmt::format("/design/{}: {} reported, {} from the targets", key, show(reported), show(objective)));
  }
}

/// The variable "scope/parameter", and its elements where the scope is a place (of every tile).
struct Variable {
  std::string name;
  std::set<std::size_t> places;
  /// True when it names a parameter of element k of type `type`.
  bool names_element(const std::string& scope, std::size_t k, const std::string& type) const
  {
    return scope == "*" || scope == type || (is_number(scope) && places.contains(k));
  }
  static bool is_number(const std::string& scope)
  {
    return !scope.empty() && scope.find_first_not_of("0123456789") == std::string::npos;
  }
};

void check_parameters(const json::value& scene, const std::string& where, const Variable& of, double expected,
                      double tolerance, Sentences& problems)
{
  const std::string& variable = of.name;
  const auto slash = variable.find('/');
  if (slash == std::string::npos) return;
  const std::string scope = variable.substr(0, slash), parameter = variable.substr(slash + 1);
  std::size_t k = 0;
  for (const json::value& element : array(member(scene, "elements", where), where)) {
    const std::string at = fmt::format("{}/elements/{}", where, k);
    const auto found =
        optional_number(member(element, "parameters", at), parameter.c_str(), at + "/parameters");
    const bool named = of.names_element(scope, k, text(member(element, "type", at), at + "/type"));
    if (named && found && !equal(*found, expected, tolerance))
      problems.push_back(fmt::format("{}: {} is {:.10g}, the variable {} is {:.10g}", at, parameter, *found,
                                     variable, expected));
    ++k;
  }
}

void check_variables(const json::value& results, const json::value& design, double tolerance,
                     Sentences& problems)
{
  const json::value& initial_scene = member(member(design, "initial", "/design"), "scene", "/design/initial");
  const auto count = static_cast<double>(
      array(member(member(results, "scene", ""), "elements", "/scene"), "/scene/elements").size());
  std::size_t i = 0;
  for (const json::value& v : array(member(design, "variables", "/design"), "/design/variables")) {
    const std::string at = fmt::format("/design/variables/{}", i++);
    Variable name{text(member(v, "name", at), at), {}};
    for (const json::value& k : array(member(v, "elements", at), at + "/elements")) {
      const double element = number(k, at + "/elements");
      if (!(element >= 0.0 && element < count))
        throw Malformed(at + "/elements: expected numbers of elements of the scene");
      name.places.insert(static_cast<std::size_t>(element));
    }
    const double lower = number(member(v, "lower", at), at), upper = number(member(v, "upper", at), at);
    const double first = number(member(v, "initial", at), at), last = number(member(v, "final", at), at);
    for (const double x : {first, last})
      if (x < lower - tolerance * (1.0 + std::abs(lower)) || x > upper + tolerance * (1.0 + std::abs(upper)))
        problems.push_back(fmt::format("{}: {:.10g} is outside [{:.10g}, {:.10g}]", at, x, lower, upper));
    check_parameters(initial_scene, "/design/initial/scene", name, first, tolerance, problems);
    check_parameters(member(results, "scene", ""), "/scene", name, last, tolerance, problems);
  }
}

VerifyLine line(const std::string& what, const Sentences& problems, const std::string& found)
{
  return {problems.empty(),
          what + ": " + (problems.empty() ? found : fmt::format("{}", fmt::join(problems, "; ")))};
}

}  // namespace

const Limit* find_limit(const std::vector<Limit>& limits, double direction_deg, const std::string& sense)
{
  for (const Limit& limit : limits)
    if (limit.sense == sense && std::abs(std::remainder(limit.direction_deg - direction_deg, 180.0)) < 1e-9)
      return &limit;
  return nullptr;
}

std::optional<double> eta(const std::optional<double>& e_s, const std::optional<double>& e_c)
{
  if (!e_s || !e_c || !(1.0 + *e_c > 0.0)) return std::nullopt;
  return (*e_s - *e_c) / (1.0 + *e_c);
}

VerifyLine check_profiles(const json::value& results, Load load, const std::vector<Limit>& limits,
                          const VerifyTolerances& tolerances)
{
  const auto [positive, negative] = senses(load);
  Sentences problems;
  std::size_t i = 0;
  for (const json::value& p : array(member(results, "profiles", ""), "/profiles")) {
    const std::string at = fmt::format("/profiles/{}", i++);
    const double direction = number(member(p, "direction_deg", at), at);
    const auto e_s = value_of(limits, direction, positive), e_c = value_of(limits, direction, negative);
    const auto joined = load != Load::paraboloid ? eta(e_s, e_c) : std::nullopt;
    for (const auto& [key, expected] :
         {std::pair("e_s", e_s), std::pair("e_c", e_c), std::pair("eta", joined)}) {
      const auto reported = optional_number(p, key, at);
      if (!equal(reported, expected, tolerances.value))
        problems.push_back(
            fmt::format("{}/{}: {} reported, {} from the limits", at, key, show(reported), show(expected)));
    }
  }
  return line("profiles", problems, fmt::format("{} directions agree with the limits", i));
}

VerifyLine check_design(const json::value& results, const std::vector<Limit>& initial,
                        const std::vector<Limit>& final, const VerifyTolerances& tolerances)
{
  const json::value& design = member(results, "design", "");
  Sentences problems;
  check_targets(design, initial, final, tolerances.value, problems);
  check_variables(results, design, tolerances.value, problems);
  return line("design", problems, "targets, objectives and variables agree with limits and scenes");
}

}  // namespace hauberk::verification
