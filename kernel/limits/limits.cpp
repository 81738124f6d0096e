#include "limits/limits.hpp"

#include "equilibrium/gaps.hpp"
#include "limits/confidence.hpp"
#include "limits/limit_report.hpp"
#include "limits/locked_states.hpp"
#include "model/links.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// A locked start whose path did not pass through anything. Certified paths do not; sampled ones may.
bool sound(const Model& m, const Locked& l, const Schedule& schedule)
{
  if (l.status != LockStatus::locked) return false;
  return schedule.ccd == CollisionCheck::certified ||
         (links_kept(m, l.state) && smallest_gap(m, l.state, schedule.last) > 0.0);
}

/// A start whose path goes past the bound of strains, and further than the locked state `best`.
std::optional<std::size_t> witness(const Model& m, const LimitTask& task,
                                   const std::vector<FoundState>& found, std::optional<std::size_t> best)
{
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Locked& l = found[k].locked;
    if (l.status != LockStatus::unbounded || l.path.empty()) continue;
    if (!best || reached(m, task, l.state) > reached(m, task, found[*best].locked.state)) return k;
  }
  return std::nullopt;
}

}  // namespace

Boundedness bounded_by_links(const Model& m, const LimitTask& task)
{
  const std::vector<Vec3> cycles = cycle_translations(m);
  return m.load->boundedness(task.direction, task.sense, cycles);
}

std::optional<std::size_t> furthest(const Model& m, const LimitTask& task, const LimitSettings& settings,
                                    const std::vector<FoundState>& found)
{
  constexpr double same_value = 1e-9;  // a later one must be further by more than rounding
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!sound(m, found[k].locked, settings.schedule)) continue;
    if (!best ||
        reached(m, task, found[k].locked.state) > reached(m, task, found[*best].locked.state) + same_value)
      best = k;
  }
  return best;
}

bool on_one_line(double degrees, double other)
{
  return std::abs(std::remainder(degrees - other, 180.0)) < 1e-9;
}

bool on_one_line(const Direction& a, const Direction& b)
{
  return a.is_angle() && b.is_angle() && on_one_line(a.degrees(), b.degrees());
}

double reached(const Model& m, const LimitTask& task, const State& state)
{
  const double v = m.load->value(task.direction, state.macro_values());
  return task.sense == Sense::positive ? v : -v;
}

double reached(const Model& m, const LimitTask& task, const LimitResult& result)
{
  const double v = *result.value / m.value_unit();
  return task.sense == Sense::positive ? v : -v;
}

LimitResult summarize(const Model& m, const SceneSpec& spec, const LimitTask& task,
                      const LimitSettings& settings, const std::vector<FoundState>& found,
                      const KeepGoing& keep_going)
{
  // A motion past every bound, if there is one; else the furthest sound locked state; if there is none, a
  // search that came to an end for a reason tells it, else the first start what happened.
  std::optional<std::size_t> sound_best = furthest(m, task, settings, found);
  const auto ended = std::find_if(found.begin(), found.end(), [](const FoundState& f) {
    return f.locked.status == LockStatus::not_a_sheet;
  });
  std::size_t best =
      sound_best.value_or(ended == found.end() ? 0 : static_cast<std::size_t>(ended - found.begin()));
  if (const std::optional<std::size_t> away = witness(m, task, found, sound_best)) {
    best = *away;
    sound_best.reset();
  }
  LimitResult r = fill_limit(m, spec, task, settings, found[best].locked, keep_going);
  if (r.status == LimitStatus::interrupted) return r;
  if (sound_best && r.status == LimitStatus::stalled) {
    // Its forces do not balance. Another search may have ended at the same state with forces that do.
    constexpr double same_state = 1e-6;
    for (std::size_t k = 0; k < found.size() && r.status == LimitStatus::stalled; ++k) {
      if (k == *sound_best || !sound(m, found[k].locked, settings.schedule) ||
          reached(m, task, found[k].locked.state) <
              reached(m, task, found[*sound_best].locked.state) - same_state)
        continue;
      LimitResult other = fill_limit(m, spec, task, settings, found[k].locked, keep_going);
      if (other.status == LimitStatus::interrupted) return other;
      if (other.status != LimitStatus::locked) continue;
      r = std::move(other);
      best = k;
    }
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    r.iterations += k == best ? 0 : found[k].locked.iterations;
    r.evaluations += k == best ? 0 : found[k].locked.evaluations;
    if (sound(m, found[k].locked, settings.schedule)) add_start(r.starts, m, task, found[k]);
  }
  if (sound_best) stand_for_equals(r.starts, m, task, found[best]);
  r.better_state = sound_best && best != 0;
  if (sound_best) enter_searches(r.confidence, m, task, settings, found, best, r.starts);
  return r;
}

std::vector<ProfilePoint> profiles(const std::vector<LimitResult>& limits, const LoadCase& load)
{
  const auto [positive, negative] = load.sense_names();
  std::vector<ProfilePoint> out;
  const auto at = [&out](double direction) -> ProfilePoint& {
    for (ProfilePoint& p : out) {
      if (p.direction_deg == direction) return p;
    }
    out.push_back({direction, {}, {}, {}});
    return out.back();
  };
  for (const LimitResult& l : limits) {
    if (!l.direction.is_angle()) continue;
    const double direction = l.direction.degrees();
    if (l.status != LimitStatus::locked) {
      at(direction);
      continue;
    }
    if (l.sense == positive) at(direction).e_s = l.value;
    if (l.sense == negative) at(direction).e_c = l.value;
  }
  const bool strain = load.value_length_power() == 0;
  for (ProfilePoint& p : out) {
    if (strain && p.e_s && p.e_c && 1.0 + *p.e_c > 0.0) p.eta = (*p.e_s - *p.e_c) / (1.0 + *p.e_c);
  }
  return out;
}

}  // namespace hauberk
