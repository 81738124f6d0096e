#include "checks.hpp"
#include "layout.hpp"
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

/// What is asked of a value in one direction.
struct Target {
  double value = 0.0, weight = 1.0;
  std::string aim;  ///< "reach", or a bound: "no_further", "no_nearer", further being away from zero

  /// value - target, and zero where a bound is kept.
  double miss(double found) const
  {
    const double difference = found - value, beyond = value < 0.0 ? -difference : difference;
    if (aim == "no_further") return beyond > 0.0 ? difference : 0.0;
    if (aim == "no_nearer") return beyond < 0.0 ? difference : 0.0;
    return difference;
  }
  /// A value is met within 5 % of it, a bound within a thousandth.
  bool met(double found) const
  {
    return std::abs(miss(found)) <= (aim == "reach" ? 0.05 : 1e-3) * std::abs(value);
  }
};

/// What a target aims at; absent: to reach its value.
std::string aim_of(const json::value& target, const std::string& at)
{
  const json::object* members = target.if_object();
  const json::value* aim = members != nullptr ? members->if_contains("aim") : nullptr;
  return aim != nullptr ? text(*aim, at + "/aim") : "reach";
}

Target target_at(const json::value& t, const std::string& at)
{
  Target out{number(member(t, "target", at), at), number(member(t, "weight", at), at), aim_of(t, at)};
  if (out.aim != "reach" && out.aim != "no_further" && out.aim != "no_nearer")
    throw Malformed(at + "/aim: \"" + out.aim + "\" is not known here");
  return out;
}

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
  if (!is_bent(load)) return {"stretch", "compress"};
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

/// sum of 1/2 weight miss^2; nothing when a value is absent.
struct Objective {
  std::optional<double> sum = 0.0;
  void add(const std::optional<double>& value, const Target& target)
  {
    if (value && sum)
      *sum += 0.5 * target.weight * target.miss(*value) * target.miss(*value);
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
    const double direction = number(member(t, "direction_deg", at), at);
    const Target target = target_at(t, at);
    const auto first = optional_number(t, "initial", at), last = optional_number(t, "recomputed", at);
    for (const auto& [what, reported, limits] :
         {std::tuple("initial", first, &initial), std::tuple("recomputed", last, &final)}) {
      const auto found = quantity(name, *limits, direction);
      if (!equal(reported, found, tolerance))
        problems.push_back(
            fmt::format("{}: {} {} reported, {} from the limits", at, what, show(reported), show(found)));
    }
    const bool met = last && target.met(*last);
    if (flag(t, "met", at) != met) problems.push_back(fmt::format("{}: met should be {}", at, met));
    before.add(first, target);
    after.add(last, target);
  }
  for (const auto& [key, objective] :
       {std::pair("objective_initial", before.sum), std::pair("objective", after.sum)}) {
    const auto reported = optional_number(design, key, "/design");
    if (objective && !equal(reported, objective, tolerance))
      problems.push_back(
          fmt::format("/design/{}: {} reported, {} from the targets", key, show(reported), show(objective)));
  }
}

/// What is designed is what the experiment asks for.
void check_question(const json::value& asked, const json::value& design, double tolerance,
                    Sentences& problems)
{
  const std::string where = "/experiment/design";
  if (member(design, "quantity", "/design") != member(asked, "quantity", where))
    problems.emplace_back("/design/quantity: not the experiment's");
  const json::array& given = array(member(asked, "targets", where), where + "/targets");
  const json::array& found = array(member(design, "targets", "/design"), "/design/targets");
  if (given.size() != found.size())
    return problems.push_back(
        fmt::format("/design/targets: {} expected, found {}", given.size(), found.size()));
  for (std::size_t k = 0; k < given.size(); ++k) {
    const std::string at = fmt::format("/design/targets/{}", k), of = fmt::format("{}/targets/{}", where, k);
    const double weight = optional_number(given[k], "weight", of).value_or(1.0);
    const bool same = equal(number(member(found[k], "direction_deg", at), at),
                            number(member(given[k], "direction_deg", of), of), tolerance) &&
                      equal(number(member(found[k], "target", at), at),
                            number(member(given[k], "value", of), of), tolerance) &&
                      equal(number(member(found[k], "weight", at), at), weight, tolerance) &&
                      aim_of(found[k], at) == aim_of(given[k], of);
    if (!same) problems.push_back(at + ": not the experiment's");
  }
}

/// Names, bounds and elements are as asked for; their values are those that the scenes must have.
void check_variables(const json::value& experiment, const json::value& design, DesignedScenes& designed,
                     double tolerance, Sentences& problems)
{
  const json::array& found = array(member(design, "variables", "/design"), "/design/variables");
  const auto laid = laid_out(experiment);
  if (!laid) throw Malformed("/experiment/cell/place: missing, so that variables cannot be told");
  const std::vector<AskedVariable> asked =
      asked_variables(member(experiment, "design", "/experiment"), *laid);
  if (asked.size() != found.size())
    return problems.push_back(
        fmt::format("/design/variables: {} expected, found {}", asked.size(), found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::string at = fmt::format("/design/variables/{}", i);
    const json::value& v = found[i];
    if (const std::string name = text(member(v, "name", at), at + "/name"); name != asked[i].name)
      problems.push_back(fmt::format("{}: {} expected, found {}", at, asked[i].name, name));
    std::set<double> expected, elements;
    for (const auto& [k, parameter] : asked[i].parameters) expected.insert(static_cast<double>(k));
    for (const json::value& k : array(member(v, "elements", at), at + "/elements"))
      elements.insert(number(k, at + "/elements"));
    if (elements != expected) problems.push_back(at + "/elements: not those that the variable is of");
    const double lower = number(member(v, "lower", at), at), upper = number(member(v, "upper", at), at);
    if (!equal(lower, asked[i].lower, tolerance) || !equal(upper, asked[i].upper, tolerance))
      problems.push_back(at + ": bounds are not the experiment's");
    const double first = number(member(v, "initial", at), at), last = number(member(v, "final", at), at);
    for (const double x : {first, last})
      if (x < lower - tolerance * (1.0 + std::abs(lower)) || x > upper + tolerance * (1.0 + std::abs(upper)))
        problems.push_back(fmt::format("{}: {:.10g} is outside [{:.10g}, {:.10g}]", at, x, lower, upper));
    designed.initial.push_back({asked[i].parameters, first});
    designed.final.push_back({asked[i].parameters, last});
  }
}

/// Objectives of iterates follow from their values.
void check_history(const json::value& design, double tolerance, Sentences& problems)
{
  const json::array& targets = array(member(design, "targets", "/design"), "/design/targets");
  std::size_t i = 0;
  for (const json::value& h : array(member(design, "history", "/design"), "/design/history")) {
    const std::string at = fmt::format("/design/history/{}", i);
    const json::array& values = array(member(h, "values", at), at + "/values");
    if (values.size() != targets.size()) throw Malformed(at + "/values: a value for each target expected");
    Objective objective;
    for (std::size_t k = 0; k < values.size(); ++k)
      objective.add(values[k].is_null() ? std::nullopt : std::optional(number(values[k], at + "/values")),
                    target_at(targets[k], at));
    const auto reported = optional_number(h, "objective", at);
    if (objective.sum && !equal(reported, objective.sum, tolerance))
      problems.push_back(fmt::format("{}/objective: {} reported, {} from its values", at, show(reported),
                                     show(objective.sum)));
    if (number(member(h, "iteration", at), at) != static_cast<double>(i))
      problems.push_back(fmt::format("{}/iteration: {} expected", at, i));
    ++i;
  }
}

void check_start(const json::value& design, Sentences& problems)
{
  const json::value& start = member(design, "start", "/design");
  bool there = false;
  for (const json::value& s : array(member(design, "starts", "/design"), "/design/starts"))
    there = there || member(s, "start", "/design/starts") == start;
  if (!there) problems.emplace_back("/design/start: not one of the starts");
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
    if (find_limit(limits, direction, positive) == nullptr &&
        find_limit(limits, direction, negative) == nullptr)
      problems.push_back(fmt::format("{}/direction_deg: no limit has it", at));
    const auto e_s = value_of(limits, direction, positive), e_c = value_of(limits, direction, negative);
    const auto joined = !is_bent(load) ? eta(e_s, e_c) : std::nullopt;
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
                        const std::vector<Limit>& final, DesignedScenes& designed,
                        const VerifyTolerances& tolerances, Record& record)
{
  const json::value& design = member(results, "design", "");
  Sentences problems;
  check_targets(design, initial, final, tolerances.value, problems);
  const json::value& experiment = member(results, "experiment", "");
  check_question(member(experiment, "design", "/experiment"), design, tolerances.value, problems);
  check_variables(experiment, design, designed, tolerances.value, problems);
  check_history(design, tolerances.value, problems);
  check_start(design, problems);
  record.done(VerifyPart::design, "/design", problems.empty());
  record.done(VerifyPart::design, "/experiment/design", problems.empty());
  record.done(VerifyPart::design, "/experiment/cell/patch/tile", problems.empty());
  return line("design", problems, "targets, objectives and variables agree with limits and scenes");
}

}  // namespace hauberk::verification
