#include "balance.hpp"
#include "checks.hpp"
#include "kinematics.hpp"
#include "links.hpp"
#include "neighbours.hpp"
#include "read.hpp"
#include "saddle.hpp"
#include "sheet.hpp"
#include "witness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

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
                      const VerifyTolerances& tolerances, Sentences& problems, Record& record)
{
  const double margin = search_margin * scene.length, tolerance = tolerances.gap * scene.length;
  const auto closest = closest_pair(scene, limit.poses, limit.macro->deformation(), margin,
                                    tolerances.enclosure * scene.length);
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
  if (!closest || !(closest->least < closest->distance - tolerance))
    return fmt::format("smallest gap {:.3g}", gap);
  record.skip(limit.where + "/min_gap", "gaps of solids that the search does not enclose closely enough");
  record.skip(limit.where + "/status", "gaps of solids that the search does not enclose closely enough");
  return fmt::format("smallest gap found {:.3g}, certified to be above {:.3g}", gap,
                     closest->least - setting.clearance);
}

std::string check_links(const Scene& scene, const Limit& limit, Sentences& problems)
{
  const auto at_rest = links(scene, rest_places(scene), Mat3::Identity());
  const std::string changed = difference(at_rest, links(scene, limit.poses, limit.macro->deformation()));
  if (!changed.empty() && (limit.links_kept || limit.status == "locked")) problems.push_back(changed);
  if (changed.empty() && !limit.links_kept) problems.push_back("links_kept is false, but all links are kept");
  return changed.empty() ? fmt::format("{} links kept", at_rest.size()) : "links changed";
}

double check_balance(const Scene& scene, const Setting& setting, const Limit& limit,
                     const VerifyTolerances& tolerances, Sentences& problems)
{
  const double found = imbalance(scene, setting, limit);
  double least = std::numeric_limits<double>::infinity();
  for (const Contact& contact : limit.contacts) least = std::min(least, contact.gap / scene.length);
  double allowed = tolerances.balance + std::min(tolerances.most_rounding, tolerances.rounding / least);
  if (limit.is_of_resultants()) {
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
  return found;
}

/// How far a bent state is from being no sheet.
Sheet sheet_of_limit(const Scene& scene, const Limit& limit)
{
  return sheet_of(scene, *limit.macro, limit.poses, links(scene, rest_places(scene), Mat3::Identity()));
}

/// A state that is kept because it is no sheet: admissible, free of intersections, and beyond the criterion.
VerifyLine check_not_a_sheet(const Scene& scene, const Setting& setting, const Limit& limit,
                             const VerifyTolerances& tolerances, Record& record)
{
  Sentences problems;
  if (limit.value) problems.push_back(fmt::format("value {} reported, null expected", show(limit.value)));
  if (!limit.contacts.empty() || limit.force_balance || limit.infimum)
    problems.push_back("contacts, their balance or an infimum, though nothing is at rest here");
  load(limit);  // throws where the measure is none of this load case's
  check_range(scene, limit, tolerances, problems);
  for (std::string& p : misplaced(scene, setting, {*limit.macro, limit.poses}, tolerances.translation))
    problems.push_back(std::move(p));
  const std::string gap = check_gap(scene, setting, limit, tolerances, problems, record);
  const std::string kept = check_links(scene, limit, problems);
  std::string how = "no patch that is bent";
  if (is_bent(setting.load)) {
    const Sheet sheet = sheet_of_limit(scene, limit);
    how = sheet.text();
    if (sheet.holds()) problems.push_back("a sheet: " + how);
  } else {
    problems.push_back(how);
  }
  for (const VerifyPart part : {VerifyPart::values, VerifyPart::gap, VerifyPart::links, VerifyPart::contacts,
                                VerifyPart::balance, VerifyPart::held})
    record.done(part, limit.where, problems.empty());
  return {problems.empty(), fmt::format("{}: {}: {}", limit.label, limit.status,
                                        problems.empty() ? fmt::format("{}, {}, {}", gap, kept, how)
                                                         : fmt::format("{}", fmt::join(problems, "; ")))};
}

/// Reactions are those of what is held, and as large as what the forces leave of the load.
void check_held(const Scene& scene, const Setting& setting, const Limit& limit, double imbalance,
                const VerifyTolerances& tolerances, Sentences& problems)
{
  const HeldComponents components = held_components(scene, setting);
  const Vector zero = components.coefficients.transpose() * scaled(*limit.macro, scene.length);
  for (Eigen::Index k = 0; k < zero.size(); ++k)
    if (!(std::abs(zero[k]) <= tolerances.held))
      problems.push_back(fmt::format("{} is held, and is {:.3g}", components.names[k], zero[k]));
  std::vector<std::string> names;
  for (const Reaction& r : limit.reactions) names.push_back(r.name);
  if (names != components.names) {
    problems.push_back(fmt::format("reactions of [{}] expected, found [{}]",
                                   fmt::join(components.names, ", "), fmt::join(names, ", ")));
    return;
  }
  const Vector found = reactions(scene, setting, limit);
  for (Eigen::Index k = 0; k < found.size(); ++k) {
    const double reported = limit.reactions[k].value;
    if (!(std::abs(reported - found[k]) <= tolerances.reaction + 10.0 * imbalance))
      problems.push_back(fmt::format("reaction of {} {:.8g} reported, the forces leave {:.8g}", names[k],
                                     reported, found[k]));
  }
}

bool known_status(const std::string& status)
{
  constexpr std::array statuses{"locked", "unbounded",   "not_attained", "stalled",
                                "failed", "interrupted", "not_a_sheet"};
  return std::find(statuses.begin(), statuses.end(), status) != statuses.end();
}

/// A limit that nothing stops, and the motion that shows it.
VerifyLine check_witnessed(const Scene& scene, const Limit& limit, Record& record)
{
  Sentences problems, found;
  if (limit.value || !limit.contacts.empty())
    problems.push_back("a value or contacts, though nothing stops it");
  std::vector<std::size_t> undecided;
  check_witness(scene, limit, problems, found, undecided);
  for (const VerifyPart part :
       {VerifyPart::values, VerifyPart::witness, VerifyPart::gap, VerifyPart::balance, VerifyPart::held})
    record.done(part, limit.where, problems.empty());
  if (problems.empty() && !undecided.empty()) {
    // The claim stands on every piece of the motion.
    const std::string why = "motions of a witness that come too near to contact to be decided";
    for (const std::size_t k : undecided) record.skip(fmt::format("{}/witness/{}", limit.where, k), why);
    record.skip(limit.where + "/status", why);
  }
  record.skip(limit.where + "/links_kept", "what says nothing without a state");
  return {problems.empty(), fmt::format("{}: {}: {}", limit.label, limit.status,
                                        fmt::join(problems.empty() ? found : problems, "; "))};
}

/// A limit without a state: nothing that a state would have is given.
VerifyLine check_stateless(const Limit& limit, Record& record)
{
  const bool bare = !limit.value && !limit.line_stretch && !limit.min_gap && !limit.force_balance &&
                    limit.contacts.empty() && limit.z_range.value_or(0.0) == 0.0;
  const bool may_lack = limit.poses.empty() && limit.status != "locked" && bare &&
                        known_status(limit.status) && (!limit.infimum || limit.status == "not_attained");
  for (const VerifyPart part : {VerifyPart::values, VerifyPart::gap, VerifyPart::balance, VerifyPart::held})
    record.done(part, limit.where, may_lack);
  if (may_lack) {
    record.skip(limit.where + "/status", "statuses without a state or a witness");
    record.skip(limit.where + "/infimum", "statuses without a state or a witness");
    record.skip(limit.where + "/links_kept", "what says nothing without a state");
  }
  return {may_lack,
          limit.label + ": " + limit.status + (may_lack ? ", no state to check" : ", but no state is given"),
          false};
}

/// The parts of the check of a limit with a state, one after the other.
class StateCheck {
 public:
  StateCheck(const Limit& limit, Record& record, const std::string& experiment)
      : limit_(limit), record_(record), experiment_(experiment)
  {
  }

  /// Does a part, and notes whether it found anything wrong.
  template <class F>
  void part(VerifyPart part, const F& check)
  {
    const std::size_t before = problems.size();
    check();
    const bool passed = problems.size() == before;
    record_.done(part, limit_.where, passed);
    record_.done(part, experiment_, passed);
  }

  Sentences problems, found;

 private:
  const Limit& limit_;
  Record& record_;
  const std::string& experiment_;
};

}  // namespace

VerifyLine check_limit(const Scene& scene, const Setting& of_all, const Limit& limit, const json::value& json,
                       const json::value& experiment, const VerifyTolerances& tolerances,
                       const VerifyShapes& shapes, Record& record)
{
  const auto refused = [&](const std::string& why) {
    record.done(VerifyPart::values, limit.where, false);
    return VerifyLine{false, limit.label + ": " + why};
  };
  if (limit.status == "unbounded" || limit.status == "not_attained") {
    if (!limit.poses.empty()) return refused(limit.status + " limits have no locked state");
    return check_witnessed(scene, limit, record);
  }
  if (limit.poses.empty() || !limit.macro) return check_stateless(limit, record);
  if (limit.poses.size() != scene.elements.size())
    return refused(fmt::format("{} poses for {} elements", limit.poses.size(), scene.elements.size()));
  if (!known_status(limit.status)) return refused("status \"" + limit.status + "\" is not known");
  Setting setting = of_all;
  setting.hold = limit.hold;
  setting.direction_deg = limit.direction_deg;

  if (limit.status == "not_a_sheet") return check_not_a_sheet(scene, setting, limit, tolerances, record);

  StateCheck check(limit, record, of_all.where);
  Sentences &problems = check.problems, &found = check.found;
  check.part(VerifyPart::values, [&] { check_values(scene, setting, limit, tolerances, problems); });
  check.part(VerifyPart::gap,
             [&] { found.push_back(check_gap(scene, setting, limit, tolerances, problems, record)); });
  check.part(VerifyPart::links, [&] { found.push_back(check_links(scene, limit, problems)); });
  bool readable = true;
  check.part(VerifyPart::contacts,
             [&] { readable = check_contacts(scene, setting, limit, tolerances, problems, record); });
  if (readable) {
    double imbalance = 0.0;
    check.part(VerifyPart::balance, [&] {
      imbalance = check_balance(scene, setting, limit, tolerances, problems);
      found.push_back(fmt::format("imbalance {:.3g}", imbalance));
      if (limit.is_of_resultants() && imbalance > tolerances.balance) {
        for (std::size_t k = 0; k < limit.contacts.size(); ++k)
          record.skip(fmt::format("{}/contacts/{}/force", limit.where, k),
                      "forces that stand for stretches of tube, which balance nothing exactly");
      }
    });
    check.part(VerifyPart::held, [&] { check_held(scene, setting, limit, imbalance, tolerances, problems); });
    if (is_bent(setting.load) && limit.status == "locked") {
      check.part(VerifyPart::values, [&] {
        if (const Sheet sheet = sheet_of_limit(scene, limit); !sheet.holds())
          problems.push_back("no sheet: " + sheet.text());
      });
    }
    if (problems.empty()) {
      const std::string at = limit.where + "/sensitivity";
      check_sensitivity(scene, setting, limit, member(json, "sensitivity", limit.where), experiment, at,
                        shapes, problems, record);
    }
  }
  // Only where everything else is in order: it moves the state along its contacts.
  if (setting.facets > 0) {
    found.emplace_back("not tested for saddles");
  } else if (problems.empty() && limit.status == "locked") {
    if (const auto further = further_nearby(scene, setting, limit)) {
      problems.push_back(fmt::format(
          "a saddle, not a locked state: moved by {:.2g} it goes further by {:.3g} without intersection",
          further->away, further->gain));
      record.done(VerifyPart::values, limit.where, false);
    }
  }
  const Sentences& said = problems.empty() ? found : problems;
  return {problems.empty(), fmt::format("{}: {} {}: {}", limit.label, limit.status, show(limit.value),
                                        fmt::join(said, problems.empty() ? ", " : "; "))};
}

}  // namespace hauberk::verification
