#include "limits/confidence.hpp"

#include "limits/limit_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

std::string name_of(LockStatus status)
{
  switch (status) {
    case LockStatus::locked:
      return "locked";
    case LockStatus::stalled:
      return "stalled";
    case LockStatus::unbounded:
      return "unbounded";
    case LockStatus::interrupted:
      return "interrupted";
    case LockStatus::not_a_sheet:
      return "not_a_sheet";
  }
  return "failed";
}

/// What a reported value may be off by, scaled.
double uncertainty(const Model& m, const LimitSettings& settings, const LimitResult& r)
{
  return r.error_estimate ? *r.error_estimate / m.value_unit() : settings.schedule.last;
}

/// Seed of the start, one of the limit's own from rest, that found its state; null: no start did.
std::optional<std::uint64_t> seed_of(const LimitResult& r)
{
  for (const LockedState& s : r.starts)
    if (s.value == *r.value && s.origin.starts_with("start")) return s.seed;
  return std::nullopt;
}

/// Two limits of one load, both found from rest, each from a start of its own: from the same start one would
/// be the mirror image of the other's search.
bool independent(const LimitResult& a, const LimitResult& b)
{
  const std::optional<std::uint64_t> own = seed_of(a), other = seed_of(b);
  return own && other && *own != *other;
}

/// One more search ends in a state that none has come to with about the probability (states seen
/// once)/(searches that locked) (I. J. Good, The population frequencies of species, Biometrika 40, 1953).
/// Above this the furthest state is one of an open number. A single such state may be any search's mishap,
/// and of few searches the estimate says nothing.
constexpr double settled_share = 0.1;
constexpr int mishaps = 1, fewest_searches = 10;

bool is_settled(const Confidence& c)
{
  const auto locked = c.searches - static_cast<int>(c.failed_searches.size());
  return locked < fewest_searches || c.seen_once <= mishaps || c.seen_once <= settled_share * locked;
}

std::string word_of(const Confidence& c)
{
  if (!c.contradicted_by.empty()) return "contradicted";
  if (c.ended_here < 2 && c.confirmed_by.empty()) return "single";
  return is_settled(c) ? "confirmed" : "unsettled";
}

}  // namespace

void enter_searches(Confidence& out, const Model& m, const LimitTask& task, const LimitSettings& settings,
                    const std::vector<FoundState>& found, std::size_t best,
                    const std::vector<LockedState>& distinct)
{
  out = {};
  out.searches = static_cast<int>(found.size());
  out.distinct = static_cast<int>(distinct.size());
  out.seen_once = static_cast<int>(
      std::ranges::count_if(distinct, [](const LockedState& state) { return state.count == 1; }));
  const double furthest = reached(m, task, found[best].locked.state);
  const double same = compared_to + further_than(settings);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Locked& l = found[k].locked;
    const double there = reached(m, task, l.state);
    if (l.status == LockStatus::locked) {
      if (there < furthest - same) continue;
      ++out.ended_here;
      if (k != best) out.confirmed_by.push_back(found[k].origin);
      continue;
    }
    FailedSearch failed{found[k].origin, found[k].seed, name_of(l.status), std::nullopt};
    if (!l.stages.empty()) {
      failed.reached = m.load->value(task.direction, l.state.macro_values()) * m.value_unit();
      if (there > furthest + same)
        out.contradicted_by.push_back(fmt::format("a search that failed came to {:.9g}", *failed.reached));
    }
    out.failed_searches.push_back(std::move(failed));
  }
  std::sort(out.confirmed_by.begin(), out.confirmed_by.end());
  out.confirmed_by.erase(std::unique(out.confirmed_by.begin(), out.confirmed_by.end()),
                         out.confirmed_by.end());
  out.word = word_of(out);
}

void enter_relations(std::vector<LimitResult>& results, const Model& m, const LimitSettings& settings,
                     const std::vector<LimitTask>& tasks, const Donors& donors)
{
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    LimitResult& own = results[k];
    if (own.status != LimitStatus::locked || !own.value) continue;
    const double value = reached(m, tasks[k], own);
    double most = 0.0;  // by which any state is further
    std::string furthest;
    for (std::size_t donor = 0; donor < donors.count(); ++donor) {
      const std::size_t d = donors.task(donor);
      const LimitResult& other = results[d];
      if (d == k || other.status != LimitStatus::locked || !other.value) continue;
      const std::string by = fmt::format("{}, {}{}", other.direction.text(), other.sense,
                                         donors.is_own(donor) ? "" : ", by a symmetry of the scene");
      const double margin = compared_to + uncertainty(m, settings, own) + uncertainty(m, settings, other);
      std::optional<double> there;
      if (donors.same_load(donor, tasks[k])) {
        there = reached(m, tasks[d], other);
      } else {
        Vector macro(m.macro_count);
        for (int i = 0; i < m.macro_count; ++i) macro[i] = other.macro[i].second / m.macro_unit(i);
        there = donors.reached(donor, macro, tasks[k]);
      }
      if (!there) continue;
      if (*there > value + margin) {
        if (*there - value > most) furthest = fmt::format("{}: further by {:.3g}", by, *there - value);
        most = std::max(most, *there - value);
      } else if (donors.same_load(donor, tasks[k]) && *there > value - margin && independent(own, other)) {
        own.confidence.confirmed_by.push_back(by);
      }
    }
    if (!furthest.empty()) own.confidence.contradicted_by.push_back(std::move(furthest));
    auto& by = own.confidence.confirmed_by;
    std::sort(by.begin(), by.end());
    by.erase(std::unique(by.begin(), by.end()), by.end());
    own.confidence.word = word_of(own.confidence);
  }
}

}  // namespace hauberk
