#include "equilibrium/barrier_path.hpp"
#include "equilibrium/constrained.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Conditions missed by less than this (strain, or curvature times L) are rounding.
constexpr double rounding_of_conditions = 1e-15;
/// Stiffness of a tether over the size of the load: what is left of the conditions is the reaction over it.
constexpr double first_tether = 1e2, most_tether = 1e8, stiffer = 1e2;

/// Brings a state to where its conditions are kept, on a certified path: a tether draws the macroscopic
/// unknowns there while the load pulls and contact resists; what the tether leaves, the reaction over its
/// stiffness, is one step that is short beside the gaps of the widest stage.
class Approach {
 public:
  Approach(const Model& m, const State& start, const MacroLoad& load, ContactChoice choice,
           const Schedule& schedule, const KeepGoing& keep_going)
      : m_(m),
        load_(load),
        keep_going_(keep_going),
        size_(load_size(m, load.pull)),
        most_evaluations_(schedule.most_evaluations)
  {
    PlannedStage plan = planned_stage(m, choice, schedule, schedule.first, false);
    // It is one stage, and nearest would end in it where contacts merge.
    plan.formulation = formulation_at(choice, schedule.first, schedule);
    stage_ = barrier_stage(m, size_, choice, schedule, plan);
    stage_.tether = load.held;
    for (Eigen::Index k = 0; k < stage_.tether.cols(); ++k) stage_.tether.col(k).normalize();
    out_.state = start;
  }

  /// Ribbons of flat tubes know one of two nearest places of a cross-section, and steps are cut at the other:
  /// where they do not come there, surfaces may.
  Locked run()
  {
    const bool ribbons = stage_.contact.formulation == Formulation::arc &&
                         stage_.contact.sides == Sides::ribbon && has_flat_tubes(m_);
    const State start = out_.state;
    Locked found = draw();
    if (!ribbons || found.status != LockStatus::stalled) return found;
    stage_.contact.sides = Sides::one;
    out_.state = start;
    return draw();
  }

 private:
  Locked draw()
  {
    for (double stiffness = first_tether; stiffness <= most_tether; stiffness *= stiffer) {
      if (step_in()) return finish(LockStatus::locked, "");
      stage_.tether_stiffness = stiffness * size_;
      stage_.most_evaluations = most_evaluations_ - out_.evaluations;
      const StageResult r = solve_stage(m_, out_.state, load_.pull, stage_, keep_going_, &bounds_);
      out_.iterations += r.iterations;
      out_.evaluations += r.evaluations;
      if (r.status == StageStatus::interrupted) return finish(LockStatus::interrupted, r.message);
      if (r.status == StageStatus::unbounded) return finish(LockStatus::unbounded, r.message);
    }
    if (step_in()) return finish(LockStatus::locked, "");
    return finish(LockStatus::stalled, fmt::format("what is held is missed by {:.1e} on the way from another "
                                                   "state: contact keeps it from there",
                                                   missed(load_.held, out_.state.macro)));
  }

  bool step_in()
  {
    Vector dy = Vector::Zero(m_.dofs());
    dy.head(m_.macro_count) = within(load_.held, out_.state.macro) - out_.state.macro;
    const State there = advanced(m_, out_.state, dy, 1.0);
    if (!m_.load->admissible(there.macro_values())) return false;
    const SafeStep safe = checked_step(m_, out_.state, dy, keep_gap, stage_, &bounds_);
    out_.evaluations += safe.evaluations;
    if (safe.alpha < 1.0) return false;
    out_.state = there;
    return true;
  }

  Locked finish(LockStatus status, std::string message)
  {
    out_.status = status;
    out_.message = std::move(message);
    return out_;
  }

  const Model& m_;
  const MacroLoad& load_;
  const KeepGoing& keep_going_;
  double size_;
  long most_evaluations_;
  Stage stage_;
  GapBounds bounds_;
  Locked out_;
};

Locked lock_freely(const Model& model, const State& start, const Vector& load, ContactChoice choice,
                   const Schedule& schedule, const KeepGoing& keep_going)
{
  return choice == ContactChoice::constrained
             ? constrained_lock(model, start, load, schedule, keep_going)
             : barrier_lock(model, start, load, choice, schedule, keep_going);
}

}  // namespace

Locked lock(const Model& model, const State& start, const MacroLoad& load, ContactChoice choice,
            const Schedule& schedule, const KeepGoing& keep_going)
{
  if (load.held.cols() == 0) return lock_freely(model, start, load.pull, choice, schedule, keep_going);
  Locked approach;
  approach.state = start;
  if (missed(load.held, start.macro) > rounding_of_conditions) {
    approach = Approach(model, start, load, choice, schedule, keep_going).run();
    if (approach.status != LockStatus::locked) return approach;
  }
  const HeldModel held(model, load.held);
  Schedule rest = schedule;
  rest.most_evaluations -= approach.evaluations;
  Locked out = lock_freely(held.model(), held.restricted(approach.state), held.pull(load.pull), choice, rest,
                           keep_going);
  out.state = held.full(out.state);
  for (State& s : out.trail) s = held.full(s);
  for (State& s : out.path) s = held.full(s);
  out.iterations += approach.iterations;
  out.evaluations += approach.evaluations;
  return out;
}

ContactChoice contact_named(std::string_view name)
{
  std::string known;
  for (const auto& [text, choice] : contact_choices) {
    if (name == text) return choice;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", text);
  }
  throw InputError(fmt::format("contact '{}' is unknown; there are {}", name, known));
}

std::vector<double> activation_distances(const Schedule& s)
{
  if (!(s.last < s.first)) return {s.last};
  // The widest stage lets symmetric states buckle, so it is never left out; slack for rounding.
  const int steps = static_cast<int>(std::ceil(std::log(s.last / s.first) / std::log(s.ratio) - 1e-6));
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(steps) + 1);
  for (int k = 0; k < steps; ++k)
    out.push_back(s.first * std::pow(s.last / s.first, static_cast<double>(k) / steps));
  out.push_back(s.last);
  return out;
}

bool is_wide(double g_hat, const Schedule& schedule)
{
  return g_hat > schedule.change * 1.001;  // slack for the rounding of powers
}

Formulation formulation_at(ContactChoice choice, double g_hat, const Schedule& schedule)
{
  switch (choice) {
    case ContactChoice::nearest:
    case ContactChoice::constrained:
      return Formulation::nearest;
    case ContactChoice::arc:
      return Formulation::arc;
    case ContactChoice::published:
      return Formulation::published;
    case ContactChoice::mesh:
      return Formulation::mesh;
    case ContactChoice::automatic:
      break;
  }
  return is_wide(g_hat, schedule) ? Formulation::arc : Formulation::nearest;
}

PlannedStage planned_stage(const Model& m, ContactChoice choice, const Schedule& schedule, double g_hat,
                           bool last)
{
  PlannedStage out{g_hat, formulation_at(choice, g_hat, schedule)};
  out.last = last;
  // What a wide stage leaves of the gaps is a larger error than that of a rough integral.
  const bool wide = g_hat > schedule.change;
  // A wide stage that is the last is one of a fold or of a design's first search, whose values are compared.
  const auto surface = [](const Body& b) { return b.solid && solid_probe_dimension(b) == 2; };
  if (choice == ContactChoice::automatic && !(wide && last) && std::ranges::all_of(m.bodies, surface))
    out.formulation = Formulation::nearest;
  out.quadrature = wide ? Quadrature::rough : last ? schedule.last_quadrature : Quadrature::fine;
  out.sides = wide && !last ? Sides::ribbon : Sides::both;
  return out;
}

std::vector<PlannedStage> planned_stages(const Model& m, ContactChoice choice, const Schedule& schedule)
{
  std::vector<PlannedStage> out;
  for (const double g_hat : activation_distances(schedule))
    out.push_back(planned_stage(m, choice, schedule, g_hat, g_hat == schedule.last));
  return out;
}

double constrained_margin(const Schedule& schedule) { return 0.1 * schedule.last; }

double least_regular_curvature(double g_hat) { return 2.0 * std::sqrt(g_hat); }

Schedule without_widest(const Schedule& s)
{
  const std::vector<double> stages = activation_distances(s);
  Schedule out = s;
  out.first = stages[std::min<std::size_t>(1, stages.size() - 1)];
  return out;
}

Vector load_vector(const Model& m, const Direction& direction, Sense sense)
{
  Vector t(m.macro_count);
  m.load->load(direction, {t.data(), static_cast<std::size_t>(m.macro_count)});
  return sense == Sense::positive ? t : Vector(-t);
}

}  // namespace hauberk
