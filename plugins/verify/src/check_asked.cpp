#include "balance.hpp"
#include "checks.hpp"
#include "read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

constexpr double same_angle = 1e-9;  ///< degrees
constexpr double rounding = 1e-12;

struct Asked {
  double direction_deg = 0.0;
  std::vector<double> components;
  std::string sense;
};

std::vector<std::string> asked_senses(const json::value& load, const std::string& where)
{
  std::vector<std::string> out;
  for (const json::value& sense : array(member(load, "senses", where), where + "/senses"))
    out.push_back(text(sense, where + "/senses"));
  return out;
}

/// Angles are the load case's, or else those of a design's targets.
std::vector<double> asked_angles(const json::value& experiment, const json::value& load,
                                 const std::string& where)
{
  std::vector<double> out;
  if (const json::value* list = load.as_object().if_contains("directions_deg")) {
    for (const json::value& x : array(*list, where + "/directions_deg")) out.push_back(number(x, where));
    return out;
  }
  const json::value* design = experiment.as_object().if_contains("design");
  if (design == nullptr || design->is_null()) throw Malformed(where + "/directions_deg: missing");
  for (const json::value& target :
       array(member(*design, "targets", "/experiment/design"), "/experiment/design"))
    out.push_back(number(member(target, "direction_deg", "/experiment/design/targets"), where));
  return out;
}

std::vector<Asked> asked_list(const json::value& list, const std::string& where)
{
  std::vector<Asked> out;
  for (const json::value& item : array(list, where)) {
    Asked asked;
    for (const json::value& x : array(item, where)) asked.components.push_back(number(x, where));
    asked.sense = "along";
    out.push_back(std::move(asked));
  }
  return out;
}

bool is_asked(const Asked& asked, const Limit& limit)
{
  if (limit.sense != asked.sense || limit.direction.has_value() == asked.components.empty()) return false;
  if (!limit.direction)
    return std::abs(std::remainder(limit.direction_deg - asked.direction_deg, 180.0)) < same_angle;
  bool same = static_cast<std::size_t>(limit.direction->size()) == asked.components.size();
  for (std::size_t k = 0; same && k < asked.components.size(); ++k)
    same = equal((*limit.direction)[k], asked.components[k], rounding);
  return same;
}

/// Directions over a sphere: as many as an icosahedron so divided has corners, of unit length, no two alike.
void check_sphere(double parts, const std::vector<Limit>& limits, Sentences& problems)
{
  const double expected = 10.0 * parts * parts + 2.0;
  if (static_cast<double>(limits.size()) != expected)
    problems.push_back(
        fmt::format("{} limits, a sphere of {:g} parts has {:g} directions", limits.size(), parts, expected));
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (!limits[i].direction || limits[i].sense != "along") {
      problems.push_back(fmt::format("limit {}: not one along components", i));
      continue;
    }
    const Macros& d = *limits[i].direction;
    if (!(std::abs(metric_norm(limits[i].load, d) - 1.0) <= rounding))
      problems.push_back(fmt::format("limit {}: its direction is not of unit length", i));
    for (std::size_t j = 0; j < i; ++j)
      if (limits[j].direction && (*limits[j].direction - d).cwiseAbs().maxCoeff() < same_angle)
        problems.push_back(fmt::format("limits {} and {} have one direction", j, i));
  }
}

void check_listed(const std::vector<Asked>& asked, const std::vector<Limit>& limits, Sentences& problems)
{
  if (asked.size() != limits.size())
    problems.push_back(fmt::format("{} limits, {} asked for", limits.size(), asked.size()));
  for (const Limit& limit : limits) {
    const auto same = std::count_if(limits.begin(), limits.end(), [&](const Limit& other) {
      return other.sense == limit.sense && other.direction.has_value() == limit.direction.has_value() &&
             (limit.direction
                  ? other.direction->size() == limit.direction->size() && *other.direction == *limit.direction
                  : std::abs(std::remainder(other.direction_deg - limit.direction_deg, 180.0)) < same_angle);
    });
    if (std::none_of(asked.begin(), asked.end(), [&](const Asked& a) { return is_asked(a, limit); }))
      problems.push_back(limit.label + ": not asked for");
    else if (same > 1)
      problems.push_back(limit.label + ": there are two of it");
  }
}

/// What a limit says about how it was asked.
void check_terms(const json::value& experiment, const json::value& load, const Limit& limit,
                 Sentences& problems)
{
  const json::value* plugin = load.as_object().if_contains("plugin");
  if (!limit.load_case.empty() && (plugin == nullptr || *plugin != json::value(limit.load_case)))
    problems.push_back(limit.label + ": load_case is not the experiment's");
  const json::value* measure = load.as_object().if_contains("measure");
  const std::string expected = limit.direction      ? "metric"
                               : measure != nullptr ? text(*measure, "/experiment/load_case/measure")
                                                    : limit.measure;
  if (limit.measure != expected)
    problems.push_back(
        fmt::format("{}: measure {} expected, found {}", limit.label, expected, limit.measure));
  if (const json::value* hold = load.as_object().if_contains("hold")) {
    std::vector<std::string> names;
    for (const json::value& name : array(*hold, "/experiment/load_case/hold"))
      names.push_back(text(name, "/experiment/load_case/hold"));
    if (!limit.direction && names != limit.hold)
      problems.push_back(fmt::format("{}: hold [{}] expected, found [{}]", limit.label,
                                     fmt::join(names, ", "), fmt::join(limit.hold, ", ")));
  }
  const json::value& solver = member(experiment, "solver", "/experiment");
  // What is no sheet was left before any formulation finished.
  if (!allowed_contact(solver, limit.contact, !limit.poses.empty() && limit.status != "not_a_sheet"))
    problems.push_back(
        fmt::format("{}: contact \"{}\" is not one of the experiment's", limit.label, limit.contact));
  const auto target = optional_number(solver, "finite_target", "/experiment/solver");
  if (target && !limit.poses.empty() && limit.finite_target &&
      !equal(*limit.finite_target, *target, rounding))
    problems.push_back(fmt::format("{}: finite_target {:.6g}, the experiment has {:.6g}", limit.label,
                                   *limit.finite_target, *target));
}

}  // namespace

bool allowed_contact(const json::value& solver, const std::string& contact, bool has_state)
{
  if (!has_state) return contact.empty();
  const json::value* setting = solver.as_object().if_contains("contact");
  const std::string asked = setting != nullptr ? text(*setting, "/experiment/solver/contact") : "auto";
  if (asked != "auto") return contact == asked;
  const json::value* preset = solver.as_object().if_contains("preset");
  const bool published = preset != nullptr && text(*preset, "/experiment/solver/preset") == "paper";
  return published ? contact == "published" : contact == "nearest" || contact == "arc";
}

void check_asked(const json::value& experiment, const std::string& experiment_where,
                 const std::vector<Limit>& limits, Sentences& problems, Record& record)
{
  const std::string where = "/experiment/load_case";
  const json::value& load = member(experiment, "load_case", "/experiment");
  const json::value* directions = load.as_object().if_contains("directions");
  Sentences found;
  if (directions != nullptr && directions->is_object()) {
    check_sphere(number(member(*directions, "sphere", where), where), limits, found);
  } else if (directions != nullptr) {
    check_listed(asked_list(*directions, where + "/directions"), limits, found);
  } else if (const json::value* task = experiment.as_object().if_contains("task");
             task == nullptr || *task != json::value("transition")) {
    std::vector<Asked> asked;
    const std::vector<std::string> senses = asked_senses(load, where);
    for (const double angle : asked_angles(experiment, load, where))
      for (const std::string& sense : senses) asked.push_back({angle, {}, sense});
    check_listed(asked, limits, found);
  }
  for (const Limit& limit : limits) {
    const std::size_t before = found.size();
    check_terms(experiment, load, limit, found);
    const bool known = std::none_of(found.begin(), found.end(), [&](const std::string& problem) {
      return problem.starts_with(limit.label);
    });
    record.done(VerifyPart::asked, limit.where, known && before == found.size());
  }
  record.done(VerifyPart::asked, experiment_where, found.empty());
  if (std::all_of(limits.begin(), limits.end(), [](const Limit& limit) { return limit.contact.empty(); }))
    record.skip(experiment_where + "/solver/contact", "settings that no state shows");
  problems.insert(problems.end(), found.begin(), found.end());
}

}  // namespace hauberk::verification
