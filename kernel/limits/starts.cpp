/// States that searches begin from: rest, perturbed, under random or tilted loads. How many there are is
/// decided in rest_searches.cpp.

#include "limits/limits.hpp"
#include "motion/advancement.hpp"

#include <cmath>
#include <limits>
#include <random>

namespace hauberk {
namespace {

/// First activation distances (L) of searches that keep a state which wider stages leave.
constexpr double narrow_stages[] = {1e-4, 1e-6};

/// Further starts take this many random moves, each as long as nothing collides.
constexpr int moves = 4;

/// Normal variates by Box-Muller: std::normal_distribution differs between standard libraries.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : rng_(seed) {}
  double operator()()
  {
    const double u = (static_cast<double>(rng_() >> 11U) + 0.5) * 0x1.0p-53;
    const double v = (static_cast<double>(rng_() >> 11U) + 0.5) * 0x1.0p-53;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }
  Vec3 vector()
  {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::mt19937_64 rng_;
};

/// A load of any direction of the macroscopic unknowns with the same probability, in the norm of loads.
Vector random_direction(const Model& m, Normal& normal)
{
  Vector out(m.macro_count);
  for (int k = 0; k < m.macro_count; ++k) out[k] = normal() * std::sqrt(m.metric[k]);
  return out;
}

}  // namespace

State perturbed(const Model& m, const State& from, double size, std::uint64_t seed, Copies copies)
{
  State s = from;
  if (size <= 0.0) return s;
  Normal normal(seed);
  const int count = size > 0.01 ? moves : 1;
  for (int k = 0; k < count; ++k) {
    Vector dy = Vector::Zero(m.dofs());
    for (int i = 0; i < m.element_count(); ++i) {
      const int source = m.source[i];
      if (copies == Copies::alike && source != i) {
        dy.segment(m.offset(i), m.element_dofs()) = dy.segment(m.offset(source), m.element_dofs());
        continue;
      }
      const Mat3& Q = m.rest[i].rotation;
      const Vec3 u = Q * normal.vector(), w = Q * normal.vector();
      dy.segment(m.offset(i), m.coordinate_count) = size * u.head(m.coordinate_count);
      dy.segment<3>(m.offset(i) + m.coordinate_count) = size * w;
    }
    dy = free_part(m, dy);
    const SafeStep safe = largest_safe_step(m, s, dy, 0.3);
    s = advanced(m, s, dy, safe.alpha);
  }
  return s;
}

State start_state(const Model& m, const LimitSettings& settings)
{
  return settings.start ? *settings.start : rest_state(m);
}

Vector tilted(const Model& m, const Vector& load, const LimitSettings& settings, std::uint64_t seed)
{
  Normal normal(seed);
  const auto metric = m.metric.head(m.macro_count).array();
  const auto dot = [&](const Vector& a, const Vector& b) { return (a.array() * b.array() / metric).sum(); };
  const double size = std::sqrt(dot(load, load));
  Vector across = random_direction(m, normal);
  across -= dot(across, load) / (size * size) * load;
  const double angle = settings.tilt * degree;
  return std::cos(angle) * load + std::sin(angle) * size / std::sqrt(dot(across, across)) * across;
}

namespace {

/// A load as large as `load`, of any direction of the macroscopic unknowns with the same probability.
Vector random_load(const Model& m, const Vector& load, std::uint64_t seed)
{
  Normal normal(seed);
  const auto metric = m.metric.head(m.macro_count).array();
  const auto size = [&](const Vector& v) { return std::sqrt((v.array().square() / metric).sum()); };
  const Vector out = random_direction(m, normal);
  return size(load) / size(out) * out;
}

/// Where the widest stage of a random load leads.
Locked folded_by_random_load(const Model& m, const LimitTask& task, const LimitSettings& settings,
                             const State& from, std::uint64_t seed, const KeepGoing& keep_going)
{
  Schedule widest = settings.schedule;
  widest.last = widest.first;
  widest.last_tolerance = widest.tolerance;
  widest.target = std::numeric_limits<double>::infinity();
  const Vector load = random_load(m, macro_load(m, task.direction, task.sense).pull, seed);
  return hauberk::lock(m, from, load, settings.contact, widest, keep_going);
}

Locked lock_from(const Model& m, const LimitTask& task, const LimitSettings& settings, const State& from,
                 const KeepGoing& keep_going)
{
  return hauberk::lock(m, from, macro_load(m, task.direction, task.sense), settings.contact,
                       settings.schedule, keep_going);
}

/// `found`, which went on from `folded`, with the work of both.
Locked with_cost_of(const Locked& folded, Locked found)
{
  found.iterations += folded.iterations;
  found.evaluations += folded.evaluations;
  return found;
}

}  // namespace

Locked limit_from_random_load(const Model& m, const LimitTask& task, const LimitSettings& settings,
                              int number, const KeepGoing& keep_going)
{
  const std::uint64_t seed = settings.seed + static_cast<std::uint64_t>(number);
  const State from = perturbed(m, start_state(m, settings), settings.perturbation, seed, Copies::apart);
  const Locked folded = folded_by_random_load(m, task, settings, from, seed, keep_going);
  if (folded.status == LockStatus::interrupted) return folded;
  return with_cost_of(folded, folded.status == LockStatus::locked
                                  ? lock_from(m, task, settings, folded.state, keep_going)
                                  : limit_from_start(m, task, settings, number, keep_going));
}

Locked limit_refolded(const Model& m, const LimitTask& task, const LimitSettings& settings, const State& from,
                      std::uint64_t seed, const KeepGoing& keep_going)
{
  Locked folded = folded_by_random_load(m, task, settings, from, seed, keep_going);
  if (folded.status != LockStatus::locked) return folded;
  return with_cost_of(folded, lock_from(m, task, settings, folded.state, keep_going));
}

Locked locked_under_tilted_load(const Model& m, const LimitTask& task, const LimitSettings& settings,
                                std::uint64_t seed, const KeepGoing& keep_going)
{
  const MacroLoad load = macro_load(m, task.direction, task.sense);
  const State from = perturbed(m, start_state(m, settings), settings.perturbation, seed, Copies::apart);
  return hauberk::lock(m, from, tilted(m, load.pull, settings, seed), settings.contact, settings.schedule,
                       keep_going);
}

Locked limit_from_tilted_load(const Model& m, const LimitTask& task, const LimitSettings& settings,
                              std::uint64_t seed, const KeepGoing& keep_going)
{
  Locked elsewhere = locked_under_tilted_load(m, task, settings, seed, keep_going);
  if (elsewhere.status != LockStatus::locked) return elsewhere;
  return with_cost_of(elsewhere, limit_from_state(m, task, settings, elsewhere.state, keep_going));
}

Locked limit_from_state(const Model& m, const LimitTask& task, const LimitSettings& settings,
                        const State& from, const KeepGoing& keep_going)
{
  const MacroLoad load = macro_load(m, task.direction, task.sense);
  Schedule schedule = without_widest(settings.schedule);
  Locked out = hauberk::lock(m, from, load, settings.contact, schedule, keep_going);
  if (!keeps(load.held, from.macro)) return out;
  // Wide stages may let a fold go that the state is in. It is further then than where they lead, and narrower
  // ones hold it.
  const auto reached = [&load](const State& s) { return load.pull.dot(s.macro); };
  for (const double first : narrow_stages) {
    const bool shorter =
        out.status == LockStatus::locked && reached(out.state) < reached(from) - further_than(settings);
    if (!shorter || first <= schedule.last) break;
    schedule.first = first;
    schedule.most_evaluations = settings.schedule.most_evaluations - out.evaluations;
    Locked narrow = hauberk::lock(m, from, load, settings.contact, schedule, keep_going);
    if (narrow.status == LockStatus::interrupted) return narrow;
    const int iterations = out.iterations + narrow.iterations;
    const long evaluations = out.evaluations + narrow.evaluations;
    if (narrow.status == LockStatus::locked && reached(narrow.state) > reached(out.state))
      out = std::move(narrow);
    out.iterations = iterations;
    out.evaluations = evaluations;
  }
  return out;
}

Locked limit_from_start(const Model& m, const LimitTask& task, const LimitSettings& settings, int start,
                        const KeepGoing& keep_going)
{
  bool repeated = false;
  for (int i = 0; i < m.element_count(); ++i) repeated |= m.source[i] != i;
  const bool small = start == 0 || (start == 1 && repeated && settings.perturbation > 0.0);
  const State from = perturbed(
      m, start_state(m, settings), small ? settings.perturbation : settings.further_perturbation,
      settings.seed + static_cast<std::uint64_t>(start), start == 0 ? Copies::alike : Copies::apart);
  const MacroLoad load = macro_load(m, task.direction, task.sense);
  Schedule schedule = settings.schedule;
  // Where links do not stop a load, the way from rest shows whether anything does.
  schedule.keep_path = !settings.start && bounded_by_links(m, task) != Boundedness::attained;
  Locked out;
  // Where steps are not certified, or a finite target holds what no contact does, a barrier is asked first
  // whether anything stops the load at all.
  const bool witnesses = settings.contact != ContactChoice::constrained &&
                         settings.contact != ContactChoice::published && !std::isfinite(schedule.target) &&
                         schedule.ccd == CollisionCheck::certified;
  if (schedule.keep_path && !witnesses) {
    Schedule certified = schedule;
    certified.target = std::numeric_limits<double>::infinity();
    certified.ccd = CollisionCheck::certified;
    out = hauberk::lock(m, from, load, ContactChoice::automatic, certified, keep_going);
  }
  if (out.status != LockStatus::unbounded && out.status != LockStatus::interrupted)
    out = hauberk::lock(m, from, load, settings.contact, schedule, keep_going);
  if (out.status != LockStatus::unbounded) out.path.clear();
  // A perturbed start lies straight ahead of rest.
  if (!out.path.empty()) out.path.insert(out.path.begin(), rest_state(m));
  return out;
}

}  // namespace hauberk
