#include "limits/locked_states.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hauberk {

double z_range(const Model& m, const State& s)
{
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  const std::vector<Pose> p = poses(m, s);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double z = p[i].position.z() - m.rest[i].position.z();
    lo = std::min(lo, z);
    hi = std::max(hi, z);
  }
  return hi - lo;
}

namespace {

/// States closer than this in value, and a hundred times as close in the norm of the macroscopic unknowns,
/// are one.
constexpr double same_state = 1e-5;

LockedState locked_state(const Model& m, const LimitTask& task, const FoundState& found)
{
  const Locked& l = found.locked;
  LockedState s;
  s.value = m.load->value(task.direction, l.state.macro_values()) * m.value_unit();
  for (int k = 0; k < m.macro_count; ++k) {
    s.macro.push_back(l.state.macro[k] * m.macro_unit(k));
  }
  s.z_range = z_range(m, l.state) * m.length;
  s.seed = found.seed;
  s.origin = found.origin;
  s.count = 1;
  return s;
}

/// The state of the list that is one with another; null: there is none. Mirror images have the same value and
/// metric norm of the macroscopic state. Heights are those of loose elements, too, which are no part of what
/// holds.
LockedState* equal_state(std::vector<LockedState>& list, const Model& m, const LockedState& s)
{
  const double scale = m.value_unit();
  const auto norm = [&m](const std::vector<double>& x) {
    double n = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) n += m.metric[k] * x[k] * x[k];
    return std::sqrt(n);
  };
  const auto equal = [&](const LockedState& o) {
    return std::abs(o.value - s.value) < same_state * scale &&
           std::abs(norm(o.macro) - norm(s.macro)) < same_state * 100 * scale;
  };
  const auto at = std::find_if(list.begin(), list.end(), equal);
  return at == list.end() ? nullptr : &*at;
}

}  // namespace

void add_start(std::vector<LockedState>& list, const Model& m, const LimitTask& task, const FoundState& found)
{
  LockedState s = locked_state(m, task, found);
  LockedState* same = equal_state(list, m, s);
  if (same == nullptr) return list.push_back(std::move(s));
  const double sign = task.sense == Sense::positive ? 1.0 : -1.0;
  s.count = ++same->count;
  if (sign * s.value > sign * same->value) *same = std::move(s);
}

void stand_for_equals(std::vector<LockedState>& list, const Model& m, const LimitTask& task,
                      const FoundState& reported)
{
  LockedState s = locked_state(m, task, reported);
  LockedState* same = equal_state(list, m, s);
  // A row of states, each one with the next, may end far from where it began.
  if (same == nullptr) return list.push_back(std::move(s));
  s.count = same->count;
  *same = std::move(s);
}

}  // namespace hauberk
