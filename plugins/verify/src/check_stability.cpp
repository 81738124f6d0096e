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

constexpr std::array outcomes{"verified", "local", "honest_failure", "silent_wrong", "interrupted"};
/// A value falls short only by more than this many times what closing its gaps would gain.
constexpr double slack_factor = 3.0;
constexpr double rounding = 1e-12;

struct Case {
  std::string where, family, member, method, sense, outcome, reason, status;
  json::value direction;
  std::optional<double> value, best_known, exact;
  double slack = 0.0;
  bool checked = false;
  std::string check;
};

const char* const stated = "states of which only the value is kept";

Case read_case(const json::value& v, const std::string& where)
{
  const auto word = [&](const char* key) { return text(member(v, key, where), where + "/" + key); };
  Case out{where,
           word("family"),
           word("member"),
           word("method"),
           "",
           word("outcome"),
           word("reason"),
           word("status"),
           {},
           {},
           {},
           {},
           0.0,
           false,
           word("check")};
  if (const json::value& sense = member(v, "sense", where); !sense.is_null())
    out.sense = text(sense, where + "/sense");
  const json::value* components = v.as_object().if_contains("direction");
  out.direction = components != nullptr ? *components : member(v, "direction_deg", where);
  out.value = optional_number(v, "value", where);
  out.best_known = optional_number(v, "best_known", where);
  out.exact = optional_number(v, "exact", where);
  out.slack = number(member(v, "slack", where), where + "/slack");
  const json::value& checked = member(v, "checked", where);
  if (!checked.is_bool()) throw Malformed(where + "/checked: true or false expected");
  out.checked = checked.get_bool();
  return out;
}

/// The outcome that a case's own fields make of it; see share/doc/results.md.
std::string outcome_of(const Case& c, bool solvable, double tolerance)
{
  if (c.status == "interrupted" || c.status.empty()) return "interrupted";
  if (c.status == "unbounded" || c.status == "not_attained") return solvable ? "silent_wrong" : "verified";
  if (c.status != "locked") return "honest_failure";
  if (!c.value || !solvable || !c.checked) return "silent_wrong";
  const bool negative = c.sense == "compress" || c.sense == "down";
  const double beyond = c.best_known ? (negative ? -1.0 : 1.0) * (*c.value - *c.best_known) : 0.0;
  const double allowed = tolerance * std::abs(1.0 + *c.value);
  if (c.exact && beyond > allowed) return "silent_wrong";
  return -beyond > allowed + slack_factor * c.slack ? "local" : "verified";
}

void check_case(const Case& c, bool solvable, double tolerance, const std::vector<Case>& all,
                Sentences& problems)
{
  if (const std::string expected = outcome_of(c, solvable, tolerance); c.outcome != expected)
    problems.push_back(fmt::format("outcome {} expected, found {}", expected, c.outcome));
  if (c.reason.empty() != (c.outcome == "verified" || c.outcome == "interrupted"))
    problems.emplace_back("a reason is given exactly where the outcome is not verified");
  if (c.exact && !equal(c.best_known, c.exact, rounding))
    problems.push_back(
        fmt::format("best_known {}, the exact value is {}", show(c.best_known), show(c.exact)));
  if (c.exact || !c.best_known) return;
  // Which cases share a scene is not told; but the best known value is one of a checked case, and no less
  // than this one's.
  const bool somebodys = std::any_of(all.begin(), all.end(), [&](const Case& o) {
    return o.checked && o.value && o.sense == c.sense && equal(*o.value, *c.best_known, rounding);
  });
  if (!somebodys)
    problems.push_back(fmt::format("best_known {}: no checked case has it", show(c.best_known)));
  const double sign = c.sense == "compress" || c.sense == "down" ? -1.0 : 1.0;
  if (c.status == "locked" && c.checked && c.value && sign * (*c.value - *c.best_known) > 0.0)
    problems.push_back(
        fmt::format("value {} is further than best_known {}", show(c.value), show(c.best_known)));
}

/// What the check of a locked state said begins with what it was about.
void check_said(const Case& c, Sentences& problems, Record& record)
{
  if (c.status == "locked" && c.checked) {
    if (c.check.find("locked " + show(c.value) + ":") == std::string::npos)
      problems.push_back(fmt::format("value {}: not that of the state that was checked", show(c.value)));
    return;
  }
  record.skip(c.where + "/checked", stated);
  if (c.value) record.skip(c.where + "/value", stated);
}

bool known_status(const std::string& status)
{
  constexpr std::array statuses{"locked", "unbounded",   "not_attained", "stalled",
                                "failed", "interrupted", "not_a_sheet",  "refused"};
  return std::find(statuses.begin(), statuses.end(), status) != statuses.end();
}

/// Methods of one member are asked the same questions, unless one was refused.
void check_questions(const Case& c, const std::vector<Case>& cases, Sentences& problems)
{
  if (c.sense.empty()) return;
  for (const Case& o : cases) {
    if (o.family != c.family || o.member != c.member || o.method == c.method || o.sense.empty()) continue;
    const bool there = std::any_of(cases.begin(), cases.end(), [&](const Case& p) {
      return p.family == o.family && p.member == o.member && p.method == o.method && p.sense == c.sense &&
             p.direction == c.direction;
    });
    if (!there)
      return problems.push_back(fmt::format("'{}' was not asked for this direction and sense", o.method));
  }
}

/// How many of the cases that fit have each outcome is what `counts` says.
template <class Fits>
void check_outcomes(const json::value& counts, const std::vector<Case>& cases, const Fits& fits,
                    const std::string& where, Sentences& problems)
{
  for (const char* outcome : outcomes) {
    const auto count = std::count_if(cases.begin(), cases.end(),
                                     [&](const Case& c) { return fits(c) && c.outcome == outcome; });
    const double recorded = number(member(counts, outcome, where), where);
    if (recorded != static_cast<double>(count))
      problems.push_back(fmt::format("{}/{}: {} expected, found {:g}", where, outcome, count, recorded));
  }
}

void check_methods(const json::value& methods, const json::array& asked, const std::vector<Case>& cases,
                   const std::string& family, const std::string& where, Sentences& problems)
{
  const json::array& list = array(methods, where);
  if (list.size() != asked.size()) throw Malformed(where + ": not the experiment's methods");
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string at = fmt::format("{}/{}", where, k),
                      name = text(member(list[k], "name", at), at + "/name");
    if (name != text(member(asked[k], "name", at), at))
      problems.push_back(at + "/name: not the experiment's");
    const auto fits = [&](const Case& c) {
      return c.method == name && (family.empty() || c.family == family);
    };
    check_outcomes(member(list[k], "counts", at), cases, fits, at + "/counts", problems);
  }
}

/// Labels of the members, or the values of the first entry that varies.
Sentences asked_members(const json::value& family, const std::string& where)
{
  Sentences out;
  if (const json::value* labels = family.as_object().if_contains("labels")) {
    for (const json::value& label : array(*labels, where + "/labels"))
      out.push_back(text(label, where + "/labels"));
    return out;
  }
  return out;
}

bool check_family(const json::value& found, const json::value& asked, const json::array& methods,
                  const std::vector<Case>& cases, const std::string& where, Sentences& problems)
{
  const std::string name = text(member(found, "name", where), where + "/name");
  if (name != text(member(asked, "name", where), where))
    problems.push_back(where + "/name: not the experiment's");
  const json::value* why = asked.as_object().if_contains("why");
  if (text(member(found, "why", where), where + "/why") != (why != nullptr ? text(*why, where) : ""))
    problems.push_back(where + "/why: not the experiment's");
  const json::value* given = asked.as_object().if_contains("solvable");
  const json::value& solvable = member(found, "solvable", where);
  if (!solvable.is_bool()) throw Malformed(where + "/solvable: true or false expected");
  if (solvable.get_bool() != (given == nullptr || given->as_bool()))
    problems.push_back(where + "/solvable: not the experiment's");
  Sentences members;
  for (const json::value& m : array(member(found, "members", where), where + "/members"))
    members.push_back(text(m, where + "/members"));
  const Sentences labels = asked_members(asked, where);
  if (!labels.empty() && labels != members)
    problems.push_back(where + "/members: not the experiment's labels");
  for (const std::string& m : members)
    if (std::none_of(cases.begin(), cases.end(),
                     [&](const Case& c) { return c.family == name && c.member == m; }))
      problems.push_back(fmt::format("{}/members: there is no case of '{}'", where, m));
  check_outcomes(
      member(found, "counts", where), cases, [&](const Case& c) { return c.family == name; },
      where + "/counts", problems);
  check_methods(member(found, "methods", where), methods, cases, name, where + "/methods", problems);
  return solvable.get_bool();
}

/// Every case is of a family, a member and a method of the table, and there are no two of one question.
void check_names(const Case& c, const std::vector<Case>& cases, const json::array& families,
                 Sentences& problems)
{
  bool known = false;
  for (const json::value& family : families) {
    if (text(member(family, "name", c.where), c.where) != c.family) continue;
    for (const json::value& m : array(member(family, "members", c.where), c.where))
      known = known || m == json::value(c.member);
  }
  if (!known) problems.push_back(fmt::format("there is no member '{}' of '{}'", c.member, c.family));
  const auto same = std::count_if(cases.begin(), cases.end(), [&](const Case& o) {
    return o.family == c.family && o.member == c.member && o.method == c.method && o.sense == c.sense &&
           o.direction == c.direction;
  });
  if (same != 1) problems.emplace_back("there are two of it");
}

/// Exact values are the experiment's, by member.
void check_exact_value(const Case& c, const json::array& families, const json::array& asked,
                       Sentences& problems)
{
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (text(member(families[f], "name", c.where), c.where) != c.family) continue;
    const json::array& members = array(member(families[f], "members", c.where), c.where);
    const json::value* exact = asked[f].as_object().if_contains("exact");
    for (std::size_t k = 0; k < members.size(); ++k) {
      if (members[k] != json::value(c.member)) continue;
      const bool given = exact != nullptr && exact->is_array() && k < exact->as_array().size() &&
                         !exact->as_array()[k].is_null();
      const auto expected = given ? std::optional(number(exact->as_array()[k], c.where)) : std::nullopt;
      // Nothing is compared where the input was refused.
      if (c.status != "refused" && !equal(c.exact, expected, rounding))
        problems.push_back(fmt::format("exact {}, the experiment has {}", show(c.exact), show(expected)));
    }
  }
}

}  // namespace

void check_stability(const json::value& experiment, const json::value& map, std::vector<VerifyLine>& lines,
                     Record& record)
{
  const std::string where = "/experiment/stability";
  const json::value& asked = member(experiment, "stability", "/experiment");
  const json::array& methods = array(member(asked, "methods", where), where + "/methods");
  const json::array& asked_families = array(member(asked, "families", where), where + "/families");
  const json::array& families = array(member(map, "families", "/stability"), "/stability/families");
  std::vector<Case> cases;
  for (const json::value& c : array(member(map, "cases", "/stability"), "/stability/cases"))
    cases.push_back(read_case(c, fmt::format("/stability/cases/{}", cases.size())));
  const double tolerance = number(member(map, "tolerance", "/stability"), "/stability/tolerance");
  Sentences table;
  const auto given = optional_number(asked, "tolerance", where);
  if (given && !equal(tolerance, *given, rounding)) table.emplace_back("tolerance: not the experiment's");
  check_outcomes(
      member(map, "counts", "/stability"), cases, [](const Case&) { return true; }, "/stability/counts",
      table);
  check_methods(member(map, "methods", "/stability"), methods, cases, "", "/stability/methods", table);
  if (families.size() != asked_families.size()) throw Malformed("/stability/families: not the experiment's");
  std::map<std::string, bool> solvable;
  for (std::size_t k = 0; k < families.size(); ++k) {
    const bool answer = check_family(families[k], asked_families[k], methods, cases,
                                     fmt::format("/stability/families/{}", k), table);
    solvable[text(member(families[k], "name", where), where)] = answer;
  }
  record.done(VerifyPart::stability, "/stability", table.empty());
  record.done(VerifyPart::stability, where, table.empty());
  lines.push_back({table.empty(),
                   table.empty()
                       ? fmt::format("/stability: {} cases, families and methods as asked for", cases.size())
                       : fmt::format("/stability: {}", fmt::join(table, "; "))});
  for (const Case& c : cases) {
    Sentences problems;
    const auto family = solvable.find(c.family);
    check_names(c, cases, families, problems);
    check_questions(c, cases, problems);
    check_said(c, problems, record);
    if (!known_status(c.status)) problems.push_back(fmt::format("status \"{}\" is not known", c.status));
    check_exact_value(c, families, asked_families, problems);
    check_case(c, family == solvable.end() || family->second, tolerance, cases, problems);
    record.done(VerifyPart::stability, c.where, problems.empty());
    if (!problems.empty())
      lines.push_back({false, fmt::format("{} ({}, {}, {}): {}", c.where, c.family, c.member, c.method,
                                          fmt::join(problems, "; "))});
  }
}

}  // namespace hauberk::verification
