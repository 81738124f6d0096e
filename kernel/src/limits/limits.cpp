#include "limit_report.hpp"

#include <hauberk/limits/limits.hpp>
#include <hauberk/mechanics/gaps.hpp>

namespace hauberk {
namespace {

std::span<const double> macro_span(const Model& m, const State& s)
{
  return {s.macro.data(), static_cast<std::size_t>(m.macro_count)};
}

/// A locked start whose path did not pass through anything. Certified paths do not; sampled ones may.
bool sound(const Model& m, const Locked& l, const Schedule& schedule)
{
  if (l.status != LockStatus::locked) return false;
  return schedule.ccd == CollisionCheck::certified ||
         (links_kept(m, l.state) && smallest_gap(m, l.state, schedule.last) > 0.0);
}

}  // namespace

std::optional<LimitResult> decided_by_links(const Model& m, const LimitTask& task)
{
  const std::vector<Vec3> cycles = cycle_translations(m);
  const Boundedness b = m.load->boundedness(task.direction_deg * degree, task.sense, cycles);
  if (b == Boundedness::attained) return std::nullopt;
  LimitResult r = limit_header(m, task);
  r.links_kept = true;
  if (b == Boundedness::unbounded) {
    r.status = LimitStatus::unbounded;
    r.message = "no chain of links holds this direction";
  } else {
    r.status = LimitStatus::not_attained;
    r.message = "approached only as another strain grows without bound";
  }
  return r;
}

LimitResult summarize(const Model& m, const SceneSpec& spec, const LimitTask& task,
                      const LimitSettings& settings, const std::vector<Locked>& starts)
{
  const double theta = task.direction_deg * degree;
  constexpr double same_value = 1e-9;  // a further start must be further by more than rounding
  // The best sound locked state; if there is none, the first start tells what happened.
  const auto value_of = [&](const Locked& l) {
    const double v = m.load->value(theta, macro_span(m, l.state));
    return task.sense == Sense::positive ? v : -v;
  };
  std::size_t best = 0;
  bool any = false;
  std::vector<bool> usable;
  for (const Locked& l : starts) usable.push_back(sound(m, l, settings.schedule));
  for (std::size_t k = 0; k < starts.size(); ++k) {
    if (!usable[k]) continue;
    if (!any || value_of(starts[k]) > value_of(starts[best]) + same_value) best = k;
    any = true;
  }
  LimitResult r = fill_limit(m, spec, task, settings, starts[best]);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    r.iterations += k == best ? 0 : starts[k].iterations;
    r.evaluations += k == best ? 0 : starts[k].evaluations;
    if (usable[k]) {
      add_start(r.starts, m, task, starts[k], settings.seed + static_cast<std::uint64_t>(k));
    }
  }
  r.better_state = any && best != 0;
  return r;
}

std::vector<ProfilePoint> profiles(const std::vector<LimitResult>& limits, const std::string& positive,
                                   const std::string& negative)
{
  std::vector<ProfilePoint> out;
  const auto at = [&out](double direction) -> ProfilePoint& {
    for (ProfilePoint& p : out) {
      if (p.direction_deg == direction) return p;
    }
    out.push_back({direction, {}, {}, {}});
    return out.back();
  };
  for (const LimitResult& l : limits) {
    if (l.status != LimitStatus::locked) {
      at(l.direction_deg);
      continue;
    }
    if (l.sense == positive) at(l.direction_deg).e_s = l.value;
    if (l.sense == negative) at(l.direction_deg).e_c = l.value;
  }
  for (ProfilePoint& p : out) {
    if (p.e_s && p.e_c && 1.0 + *p.e_c > 0.0) p.eta = (*p.e_s - *p.e_c) / (1.0 + *p.e_c);
  }
  return out;
}

}  // namespace hauberk
