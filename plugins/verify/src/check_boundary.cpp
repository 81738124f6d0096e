#include "balance.hpp"
#include "checks.hpp"
#include "read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/json/array.hpp>

#include <cmath>
#include <map>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// Index of a limit along components.
std::size_t limit_index(const json::value& v, const std::vector<Limit>& limits, const std::string& where)
{
  const double k = number(v, where);
  const bool there = k >= 0.0 && k < static_cast<double>(limits.size()) && k == std::floor(k);
  if (!there || !limits[k].direction)
    throw Malformed(fmt::format("{}: no limit along components has the index {:g}", where, k));
  return static_cast<std::size_t>(k);
}

std::size_t check_triangles(const json::value& boundary, const std::vector<Limit>& limits)
{
  const json::array& triangles = array(member(boundary, "triangles", "/boundary"), "/boundary/triangles");
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::string at = fmt::format("/boundary/triangles/{}", t);
    const json::array& corners = array(triangles[t], at);
    if (corners.size() != 3) throw Malformed(at + ": three limits expected");
    for (const json::value& corner : corners) limit_index(corner, limits, at);
  }
  return triangles.size();
}

bool usable(const Limit& limit) { return limit.direction && limit.status == "locked" && limit.macro; }

/// By how much the best of all states is further along a limit than its own; at most 0 where it is the best.
double shortfall(const std::vector<Limit>& limits, const Limit& own)
{
  double by = 0.0;
  for (const Limit& other : limits) {
    if (usable(other)) by = std::max(by, value(own, *other.macro) - value(own, *own.macro));
  }
  return by;
}

}  // namespace

VerifyLine check_boundary(const json::value& boundary, const std::vector<Limit>& limits, bool complete,
                          const VerifyTolerances& tolerances)
{
  Sentences problems;
  const std::string at = "/boundary/shortfalls";
  const double margin = number(member(boundary, "margin", "/boundary"), "/boundary/margin");
  // A limit that could not be read has no place here, so that indices would mean others.
  if (!complete) throw Malformed("/boundary: cannot be checked, not all limits can be read");
  const std::size_t triangles = check_triangles(boundary, limits);
  std::map<std::size_t, double> reported;
  for (const json::value& s : array(member(boundary, "shortfalls", "/boundary"), at)) {
    const std::size_t k = limit_index(member(s, "limit", at), limits, at);
    const std::size_t state = limit_index(member(s, "state", at), limits, at);
    const double by = number(member(s, "by", at), at);
    if (!usable(limits[k]) || !usable(limits[state]))
      throw Malformed(at + ": names limits that are not locked");
    const double found = value(limits[k], *limits[state].macro) - value(limits[k], *limits[k].macro);
    if (!equal(by, found, tolerances.value))
      problems.push_back(fmt::format(
          "limit {} falls short of the state of {} by {:.6g} reported, {:.6g} found", k, state, by, found));
    reported[k] = by;
  }
  for (std::size_t k = 0; k < limits.size(); ++k) {
    if (!usable(limits[k])) continue;
    const double by = shortfall(limits, limits[k]);
    const double said = reported.contains(k) ? reported.at(k) : 0.0;
    if (by > margin + tolerances.value && !equal(said, by, tolerances.value))
      problems.push_back(fmt::format("limit {} falls short by {:.6g}, {:.6g} reported", k, by, said));
  }
  return {problems.empty(),
          "boundary: " + (problems.empty()
                              ? fmt::format("{} triangles; {} limits fall short of another one's state",
                                            triangles, reported.size())
                              : fmt::format("{}", fmt::join(problems, "; ")))};
}

}  // namespace hauberk::verification
