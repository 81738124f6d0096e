#include "balance.hpp"
#include "checks.hpp"
#include "kinematics.hpp"
#include "links.hpp"
#include "neighbours.hpp"
#include "saddle.hpp"
#include "sheet.hpp"
#include "witness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk::verification {
namespace {

/// Pairs whose bounding spheres are farther apart than this many L are not searched.
constexpr double search_margin = 1.0;
/// A finite target that leaves no more than this part of the load is reached: nothing needs to hold the
/// state.
constexpr double least_drive = 1e-2;

std::vector<Place> rest_places(const Scene& scene)
{
  std::vector<Place> out;
  for (const Element& element : scene.elements) out.push_back(element.rest);
  return out;
}

/// Smallest separation less the clearance, compared with min_gap; returns what to say about it.
std::string check_gap(const Scene& scene, const Setting& setting, const Limit& limit,
                      const VerifyTolerances& tolerances, Sentences& problems)
{
  const double margin = search_margin * scene.length, tolerance = tolerances.gap * scene.length;
  const auto closest = closest_pair(scene, limit.poses, limit.macro->deformation(), margin);
  const double gap = (closest ? closest->distance : margin) - setting.clearance;
  const std::string whose = closest ? fmt::format("elements {} and {}, image {}", closest->pair.first,
                                                  closest->pair.second, shown(closest->pair.image))
                                    : "no near pair";
  if (gap < -tolerance)
    problems.push_back(fmt::format("surfaces are {:.3g} closer than the clearance ({})", -gap, whose));
  if (!limit.min_gap)
    problems.push_back("min_gap is missing");
  else if (closest ? !(std::abs(*limit.min_gap - gap) <= tolerance) : *limit.min_gap < gap)
    problems.push_back(fmt::format("min_gap {:.6g} reported, {:.6g} found ({})", *limit.min_gap, gap, whose));
  return fmt::format("smallest gap {:.3g}", gap);
}

std::string check_links(const Scene& scene, const Limit& limit, Sentences& problems)
{
  const auto at_rest = links(scene, rest_places(scene), Mat3::Identity());
  const std::string changed = difference(at_rest, links(scene, limit.poses, limit.macro->deformation()));
  if (!changed.empty() && (limit.links_kept || limit.status == "locked")) problems.push_back(changed);
  if (changed.empty() && !limit.links_kept) problems.push_back("links_kept is false, but all links are kept");
  return changed.empty() ? fmt::format("{} links kept", at_rest.size()) : "links changed";
}

std::string check_balance(const Scene& scene, const Setting& setting, const Limit& limit,
                          const VerifyTolerances& tolerances, Sentences& problems)
{
  const double found = imbalance(scene, setting, limit);
  double least = std::numeric_limits<double>::infinity();
  for (const Contact& contact : limit.contacts) least = std::min(least, contact.gap / scene.length);
  double allowed = tolerances.balance + std::min(tolerances.most_rounding, tolerances.rounding / least);
  if (limit.contact == "arc") {
    double gap = 0.0;
    for (const Contact& contact : limit.contacts) gap = std::max(gap, contact.gap);
    allowed += tolerances.arc_balance * gap / scene.length;
  }
  if (limit.status == "locked" && !(found <= allowed))
    problems.push_back(fmt::format("forces miss the load by {:.3g}, {:.3g} allowed", found, allowed));
  const double driven = driving_load(limit, scene.length).norm() / load(limit).norm();
  if (limit.status == "locked" && !(driven > least_drive))
    problems.push_back(fmt::format("the finite target is reached: {:.3g} of the load is left", driven));
  if (!limit.force_balance)
    problems.push_back("force_balance is missing");
  else if (!(std::abs(*limit.force_balance - found) <= tolerances.balance_agreement))
    problems.push_back(
        fmt::format("force_balance {:.3g} reported, {:.3g} found", *limit.force_balance, found));
  return fmt::format("imbalance {:.3g}", found);
}

/// How far a bent state is from being no sheet.
Sheet sheet_of_limit(const Scene& scene, const Limit& limit)
{
  std::vector<std::array<int, 2>> linked;
  for (const Link& link : links(scene, rest_places(scene), Mat3::Identity())) linked.push_back(link.elements);
  return sheet_of(scene, *limit.macro, limit.poses, linked);
}

/// A state that is kept because it is no sheet: admissible, free of intersections, and beyond the criterion.
VerifyLine check_not_a_sheet(const Scene& scene, const Setting& setting, const Limit& limit,
                             const VerifyTolerances& tolerances)
{
  Sentences problems;
  if (limit.value) problems.push_back(fmt::format("value {} reported, null expected", show(limit.value)));
  if (!limit.contacts.empty()) problems.push_back("contacts listed, though nothing is at rest here");
  for (std::string& p : misplaced(scene, {*limit.macro, limit.poses}, tolerances.translation))
    problems.push_back(std::move(p));
  const std::string gap = check_gap(scene, setting, limit, tolerances, problems);
  const std::string kept = check_links(scene, limit, problems);
  std::string how = "no patch on a paraboloid";
  if (setting.load == Load::paraboloid) {
    const Sheet sheet = sheet_of_limit(scene, limit);
    how = sheet.text();
    if (sheet.holds()) problems.push_back("a sheet: " + how);
  } else {
    problems.push_back(how);
  }
  return {problems.empty(), fmt::format("{}: {}: {}", limit.label, limit.status,
                                        problems.empty() ? fmt::format("{}, {}, {}", gap, kept, how)
                                                         : fmt::format("{}", fmt::join(problems, "; ")))};
}

}  // namespace

VerifyLine check_limit(const Scene& scene, const Setting& setting, const Limit& limit,
                       const VerifyTolerances& tolerances)
{
  const bool has_state = !limit.poses.empty();
  if (!has_state && !limit.value && (limit.status == "unbounded" || limit.status == "not_attained")) {
    Sentences problems, found;
    check_witness(scene, limit, problems, found);
    return {problems.empty(), fmt::format("{}: {}: {}", limit.label, limit.status,
                                          fmt::join(problems.empty() ? found : problems, "; "))};
  }
  if (!has_state || !limit.macro) {
    const bool may_lack = !has_state && limit.status != "locked" && !limit.value;
    return {
        may_lack,
        limit.label + ": " + limit.status + (may_lack ? ", no state to check" : ", but no state is given"),
        false};
  }
  if (limit.poses.size() != scene.elements.size())
    return {false, fmt::format("{}: {} poses for {} elements", limit.label, limit.poses.size(),
                               scene.elements.size())};
  if (limit.status == "unbounded" || limit.status == "not_attained")
    return {false, limit.label + ": " + limit.status + " limits have no locked state"};
  if (limit.status == "not_a_sheet") return check_not_a_sheet(scene, setting, limit, tolerances);

  Sentences problems, found;
  check_values(scene, setting, limit, tolerances, problems);
  found.push_back(check_gap(scene, setting, limit, tolerances, problems));
  found.push_back(check_links(scene, limit, problems));
  const std::size_t before = problems.size();
  check_contacts(scene, setting, limit, tolerances, problems);
  const bool readable =
      std::none_of(problems.begin() + static_cast<std::ptrdiff_t>(before), problems.end(),
                   [](const std::string& p) { return p.find("no such") != std::string::npos; });
  if (readable) found.push_back(check_balance(scene, setting, limit, tolerances, problems));
  if (setting.load == Load::paraboloid && limit.status == "locked") {
    if (const Sheet sheet = sheet_of_limit(scene, limit); !sheet.holds())
      problems.push_back("no sheet: " + sheet.text());
  }
  // Only where everything else is in order: it moves the state along its contacts.
  if (setting.facets > 0) {
    found.emplace_back("not tested for saddles");
  } else if (problems.empty() && limit.status == "locked") {
    if (const auto further = further_nearby(scene, setting, limit))
      problems.push_back(fmt::format(
          "a saddle, not a locked state: moved by {:.2g} it goes further by {:.3g} without intersection",
          further->away, further->gain));
  }
  const Sentences& said = problems.empty() ? found : problems;
  return {problems.empty(), fmt::format("{}: {} {}: {}", limit.label, limit.status, show(limit.value),
                                        fmt::join(said, problems.empty() ? ", " : "; "))};
}

}  // namespace hauberk::verification
