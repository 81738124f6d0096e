#include "tasks/stability/stability_summary.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

constexpr std::size_t longest_reason = 160;

std::string row(const std::string& family, const std::string& method, const OutcomeCounts& n, std::size_t w1,
                std::size_t w2)
{
  const auto count = [&n](Outcome o) { return n[static_cast<std::size_t>(o)]; };
  std::string text =
      fmt::format("{:<{}}  {:<{}} {:>9} {:>6} {:>8} {:>7}", family, w1, method, w2, count(Outcome::verified),
                  count(Outcome::local), count(Outcome::honest_failure), count(Outcome::silent_wrong));
  if (count(Outcome::interrupted) > 0)
    text += fmt::format("  ({} not computed)", count(Outcome::interrupted));
  return text + "\n";
}

/// Of reasons that are alike only what differs is of interest: a line per case, cut where it gets long.
std::string remark(const StabilityMap& map, const StabilityCase& c)
{
  const StabilityFamilyResult& family = map.families[c.family];
  std::string reason = c.reason;
  if (reason.size() > longest_reason) reason = reason.substr(0, longest_reason) + "...";
  const std::string at =
      c.direction.is_angle() ? fmt::format("at {:g}", c.direction.degrees()) : c.direction.text();
  const std::string limit = c.sense.empty() ? "" : fmt::format(", {} {}", c.sense, at);
  return fmt::format("{}, {}, {}{}: {}: {}\n", family.name, family.labels[c.member], map.methods[c.method],
                     limit, to_string(c.outcome), reason);
}

}  // namespace

std::string stability_summary(const StabilityMap& map)
{
  std::size_t w1 = 6, w2 = 6;
  for (const StabilityFamilyResult& family : map.families) w1 = std::max(w1, family.name.size());
  for (const std::string& method : map.methods) w2 = std::max(w2, method.size());
  std::string text = fmt::format("{:<{}}  {:<{}} {:>9} {:>6} {:>8} {:>7}\n", "family", w1, "method", w2,
                                 "verified", "local", "failed", "wrong");
  for (std::size_t f = 0; f < map.families.size(); ++f) {
    for (std::size_t m = 0; m < map.methods.size(); ++m)
      text += row(m == 0 ? map.families[f].name : "", map.methods[m], count_outcomes(map, f, m), w1, w2);
  }
  for (std::size_t m = 0; m < map.methods.size(); ++m)
    text += row(m == 0 ? "all" : "", map.methods[m], count_outcomes(map, {}, m), w1, w2);
  text += "\n";
  for (const Outcome outcome : {Outcome::silent_wrong, Outcome::local, Outcome::honest_failure}) {
    for (const StabilityCase& c : map.cases) {
      if (c.outcome == outcome) text += remark(map, c);
    }
  }
  return text;
}

}  // namespace hauberk
