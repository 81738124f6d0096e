#include "limits/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace hauberk {
namespace {

/// A finite target whose pull falls below this part of the load has been reached.
constexpr double least_drive = 1e-2;
/// Listed forces that miss the load by more than this part of it hold no locked state. Rounding of gaps
/// leaves up to 3e-5; `arc` lists resultants, whose wrench is off by a multiple of gap / L.
constexpr double balanced = 1e-4;
constexpr double balanced_per_gap = 100.0;
/// On hair-thin tubes `arc` leaves gaps of 1e-12 L. More than this part is not put down to their rounding.
constexpr double most_rounding = 1e-3;
/// Rest may overlap by this much and still count as touching; what is less than rest by more is no limit.
constexpr double wrong_side = 1e-9;

/// What the equilibrium may miss what drives it by.
double allowed_imbalance(const LimitResult& r, const StateForces& h)
{
  double gap = 0.0, least = std::numeric_limits<double>::infinity();
  for (const ContactForce& c : r.contacts) {
    gap = std::max(gap, c.gap / h.model.length);
    least = std::min(least, c.gap / h.model.length);
  }
  return balanced + std::min(most_rounding, rounding_of_x / least) +
         (traits(h.locked.stage.contact.formulation).is_integral ? balanced_per_gap * gap : 0.0);
}

}  // namespace

Verdict end_of_search(const Model& m, const Locked& l)
{
  switch (l.status) {
    case LockStatus::locked:
      return {LimitStatus::locked, l.message};
    case LockStatus::interrupted:
      return {LimitStatus::interrupted, l.message};
    case LockStatus::not_a_sheet:
      return {LimitStatus::not_a_sheet, l.message};
    case LockStatus::unbounded:
      return {LimitStatus::failed,
              m.load->periodic()
                  ? "the strain left every bound, but not on a certified way from rest"
                  : "the macroscopic unknowns left every bound: nothing stops this patch in this direction"};
    default:
      return {LimitStatus::stalled, l.message};
  }
}

namespace {

/// A flat energy is no equilibrium: where contacts merge, nearest points come and go and balance nothing.
Verdict unbalanced_state(const LimitResult& r, const StateForces& h, const LimitSettings& settings)
{
  std::string message = fmt::format("contact forces miss the load by {:.1e} of it", *r.force_balance);
  const double energy = energy_imbalance(h) / h.full;
  if (traits(h.locked.stage.contact.formulation).fades && *r.force_balance > 2.0 * energy) {
    // Published contacts near a merge push through their fade too, which is no force at a point.
    message += fmt::format(
        ": the fade of published contacts holds this state, which nothing real does; the gradient of their "
        "energy misses the load by {:.1e}",
        energy);
  }
  if (settings.contact == ContactChoice::nearest) message += "; use contact arc or auto";
  return {LimitStatus::stalled, message};
}

}  // namespace

Verdict verdict_of(const LimitResult& r, const StateForces& h, const LimitSettings& settings)
{
  if (!r.links_kept) return {LimitStatus::failed, "a link was lost: the collision check failed"};
  Verdict search = end_of_search(h.model, h.locked);
  if (search.status != LimitStatus::locked) return search;
  if (!(h.driving > least_drive)) {
    return {
        LimitStatus::failed,
        fmt::format("the finite target {:g} is reached: what is left of the load does not press contacts; "
                    "choose a larger finite_target",
                    h.locked.stage.target)};
  }
  if (!(*r.min_gap > 0.0))
    return {LimitStatus::failed, "surfaces overlap at the end: the collision check failed"};
  if (!(*r.force_balance <= allowed_imbalance(r, h) * h.driving)) return unbalanced_state(r, h, settings);
  if (h.sign() * *r.value < -wrong_side * h.scale) {
    return {
        LimitStatus::stalled,
        fmt::format("rest is nearer to the limit than the gaps that this schedule leaves: value {:.3g} is "
                    "on the wrong side of rest; use preset accurate or a smaller tolerance",
                    *r.value)};
  }
  if (*r.force_balance > noticed_imbalance) {
    return {LimitStatus::locked,
            fmt::format("contact forces miss the load by {:.1e} of it: an error of that order is possible",
                        *r.force_balance)};
  }
  if (h.missed_before) {
    search.message += fmt::format(
        "{}gaps are so small that rounding left forces that miss the load by {:.1e} of it; those given are "
        "the nearest that balance",
        search.message.empty() ? "" : "; ", *h.missed_before);
  }
  return search;
}

}  // namespace hauberk
