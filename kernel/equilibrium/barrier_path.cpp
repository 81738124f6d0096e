#include "equilibrium/barrier_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace hauberk {
namespace {

/// Forces of the last stage that miss the load by more than this part of it are worth a second attempt.
constexpr double unbalanced = 5e-5;
/// Rounding of coordinates, L, and the smallest gap under load that a stage leaves, as part of g_hat.
constexpr double rounding_of_x = 1e-15, smallest_gap_of_stage = 0.01;
/// Ends that are wider than one that fails, by these factors: the first three where its forces do not
/// balance, all where it stalls. A stage that is wider than widest_stalled (L) has no such end.
constexpr std::array<double, 6> wider_ends = {3.0, 10.0, 30.0, 100.0, 300.0, 1000.0};
constexpr std::size_t ends_for_balance = 3;
constexpr double widest_stalled = 1e-7;
constexpr double steady_order =
    0.3;  ///< relative change of the convergence ratio that still counts as steady

/// Distance to the value at g_hat = 0 from the last three stages of one formulation, when the differences
/// shrink in proportion to g_hat.
std::optional<double> estimate_error(const std::vector<StageRecord>& s)
{
  const std::size_t n = s.size();
  if (n < 3) return std::nullopt;
  const double ratio = s[n - 1].g_hat / s[n - 2].g_hat;
  if (s[n - 1].formulation != s[n - 3].formulation || s[n - 2].formulation != s[n - 1].formulation)
    return std::nullopt;
  const double d1 = s[n - 2].value - s[n - 3].value, d2 = s[n - 1].value - s[n - 2].value;
  if (d2 == 0.0) return 0.0;
  const double order = d2 / d1;  // about `ratio` for first order
  if (!(order > 0.0 && std::abs(order / ratio - 1.0) < steady_order)) return std::nullopt;
  return std::abs(d2) * order / (1.0 - order);
}

class Path {
 public:
  Path(const Model& m, const State& start, const Vector& load, ContactChoice choice, const Schedule& schedule,
       const KeepGoing& keep_going)
      : m_(m),
        load_(load),
        choice_(choice),
        schedule_(schedule),
        keep_going_(keep_going),
        size_(load_size(m, load)),
        most_evaluations_(schedule.most_evaluations)
  {
    flat_tubes_ = has_flat_tubes(m);
    out_.state = start;
    if (schedule.keep_path) out_.path.push_back(start);
    arc_to_the_end_ = choice == ContactChoice::arc;
  }

  Locked run()
  {
    for (const PlannedStage& planned : planned_stages(m_, choice_, schedule_)) {
      if (stage(planned)) continue;
      end_wider_than(planned.g_hat);
      return std::move(out_);
    }
    out_.status = LockStatus::locked;
    balance();
    if (out_.status != LockStatus::locked) return std::move(out_);
    out_.error_estimate = ends_over_other_places() ? room_under_load() : estimate_error(out_.stages);
    return std::move(out_);
  }

 private:
  Stage make_stage(const PlannedStage& plan) const
  {
    return barrier_stage(m_, size_, choice_, schedule_, plan);
  }

  /// Goes to the end of a stage; false where the path ends in it.
  bool stage(PlannedStage plan)
  {
    const State before = out_.state;
    if (arc_to_the_end_ || (arc_while_wide_ && is_wide(plan.g_hat, schedule_)))
      plan.formulation = Formulation::arc;
    const bool ribbons = flat_tubes_ && plan.formulation == Formulation::arc && plan.sides == Sides::ribbon;
    if (ribbons && blind_) plan.sides = Sides::one;
    StageResult r = attempt(before, plan);
    if (ribbons && !blind_ && (gave_up(r) || is_blocked(r))) {
      // Ribbons jump where a cross-section has two nearest places.
      blind_ = is_blocked(r);
      plan.sides = Sides::one;
      r = attempt(before, plan);
    }
    if (may_change(plan)) repeat_with_arc(before, plan, r);
    if (schedule_.keep_path) out_.path.insert(out_.path.end(), path_.begin(), path_.end());
    if (r.status != StageStatus::minimum) {
      out_.status = end_of_path(r.status);
      out_.message = r.message;
      return false;
    }
    out_.stage = make_stage(plan);
    out_.stages.push_back(
        {plan.g_hat, load_.dot(out_.state.macro), plan.formulation, r.iterations, r.residual, r.escapes});
    out_.trail.push_back(out_.state);
    previous_ = before_valid_ ? std::optional<State>(before) : std::nullopt;
    before_valid_ = true;
    return true;
  }

  bool may_change(const PlannedStage& plan) const
  {
    return choice_ == ContactChoice::automatic && plan.formulation == Formulation::nearest;
  }

  /// A stage of `arc`: where there are flat tubes over ribbons, which is entered, unless these were blocked
  /// once, or that gives up, is blocked, or, as the last stage, leaves forces that do not balance.
  StageResult attempt_with_arc(const State& before, PlannedStage& arc)
  {
    if (!flat_tubes_ || blind_) return attempt(before, arc);
    const Sides surfaces = std::exchange(arc.sides, Sides::ribbon);
    StageResult r = attempt(before, arc);
    const bool balanced = r.status != StageStatus::minimum || !arc.last || !(r.residual > unbalanced);
    blind_ = is_blocked(r);
    if (!gave_up(r) && !blind_ && balanced) return r;
    arc.sides = surfaces;
    return attempt(before, arc);
  }

  static bool gave_up(const StageResult& r)
  {
    return r.status == StageStatus::merging || r.status == StageStatus::stalled ||
           r.status == StageStatus::iteration_limit;
  }

  /// It ended far from a minimum, as no step that lowers its energy is free of collisions: surfaces meet
  /// where the barrier sees none. Of minima forces miss the load by 5 % of it at most, whatever the stage's
  /// tolerance.
  static bool is_blocked(const StageResult& r)
  {
    constexpr double missed_of_load = 0.1;
    return r.status == StageStatus::minimum && r.residual > missed_of_load;
  }

  /// Runs a stage of `nearest` again with `arc`, where it gave up or its forces do not balance.
  void repeat_with_arc(const State& before, PlannedStage& plan, StageResult& r)
  {
    PlannedStage arc = plan;
    arc.formulation = Formulation::arc;
    if (gave_up(r)) {
      // What a wide stage of nearest did not lead to, narrow ones may end all the same.
      const bool gave_up_for_good = r.status != StageStatus::merging;
      (is_wide(plan.g_hat, schedule_) ? arc_while_wide_ : arc_to_the_end_) = gave_up_for_good;
      plan = arc;
      r = attempt_with_arc(before, plan);
      return;
    }
    if (!plan.last || r.status != StageStatus::minimum || !(r.residual > unbalanced)) return;
    // Contacts that merge can leave forces on points that do not balance; spread forces do.
    const State points = out_.state;
    const std::vector<State> path = path_;
    const StageResult spread = attempt_with_arc(before, arc);
    if (spread.status == StageStatus::interrupted ||
        (spread.status == StageStatus::minimum && spread.residual < r.residual)) {
      plan = arc;
      r = spread;
    } else {
      out_.state = points;
      path_ = path;
    }
  }

  static LockStatus end_of_path(StageStatus status)
  {
    switch (status) {
      case StageStatus::interrupted:
        return LockStatus::interrupted;
      case StageStatus::unbounded:
        return LockStatus::unbounded;
      case StageStatus::not_a_sheet:
        return LockStatus::not_a_sheet;
      default:
        return LockStatus::stalled;
    }
  }

  /// A force is as exact as its gap: rounding of coordinates over g. Where many contacts share the load along
  /// surfaces that conform, the last stage's gaps can be too small for their forces to balance. Then the last
  /// stage is a wider one, as little as it takes. The value is then off by a multiple of that g_hat, and as
  /// a rule without an error estimate, since the last widths are not in the ratio of the others. Where none
  /// balances the best of them stays, and its forces tell.
  void balance()
  {
    const bool rounding_matters = rounding_of_x > 0.1 * unbalanced * smallest_gap_of_stage * schedule_.last;
    if (!rounding_matters || !(out_.stages.back().residual > unbalanced)) return;
    // It is locked; that its forces balance, too, is worth what it takes.
    most_evaluations_ = std::numeric_limits<long>::max();
    const Locked narrowest = out_;
    Locked best = out_;
    for (const double wider : std::span(wider_ends).first(ends_for_balance)) {
      const double g_hat = wider * schedule_.last;
      if (!go_back(narrowest, g_hat)) break;
      if (!stage(planned_stage(m_, choice_, schedule_, g_hat, true))) {
        if (out_.status == LockStatus::interrupted) return;
        continue;
      }
      if (out_.stages.back().residual < best.stages.back().residual) best = out_;
      if (best.stages.back().residual <= unbalanced) break;
    }
    best.iterations = out_.iterations;
    best.evaluations = out_.evaluations;
    out_ = std::move(best);
  }

  /// Goes back to the narrowest stage of `from` that is twice as wide as g_hat; false where there is none.
  bool go_back(const Locked& from, double g_hat)
  {
    out_.stages = from.stages;
    out_.trail = from.trail;
    while (!out_.stages.empty() && out_.stages.back().g_hat < 2.0 * g_hat) {
      out_.stages.pop_back();
      out_.trail.pop_back();
    }
    if (out_.stages.empty()) return false;
    out_.state = out_.trail.back();
    out_.status = from.status;  // what an attempt before this one said does not count
    out_.message = from.message;
    previous_.reset();
    return true;
  }

  /// Where faces lie flat upon each other, the gaps of a narrow stage can be too small for any part of a step
  /// to be certified. A stage that is wider, and still narrow, is then the last one, if its forces balance.
  void end_wider_than(double failed)
  {
    if (out_.status != LockStatus::stalled || failed > widest_stalled) return;
    const Locked stalled = out_;
    for (const double wider : wider_ends) {
      const double g_hat = wider * failed;
      if (!go_back(stalled, g_hat)) break;
      if (stage(planned_stage(m_, choice_, schedule_, g_hat, true))) {
        if (out_.stages.back().residual > unbalanced) continue;
        out_.status = LockStatus::locked;
        out_.error_estimate = room_under_load();
        out_.message = fmt::format("gaps are left {:g} times as wide as asked, since with narrower ones {}",
                                   g_hat / schedule_.last, stalled.message);
        return;
      }
      if (out_.status == LockStatus::interrupted) return;
    }
    const int iterations = out_.iterations;
    const long evaluations = out_.evaluations;
    out_ = stalled;
    out_.iterations = iterations;
    out_.evaluations = evaluations;
  }

  /// Whether the last stage may be one of `arc` over surfaces and those before it over ribbons, as with flat
  /// tubes: the two come to a limit from other distances.
  bool ends_over_other_places() const
  {
    const std::size_t n = out_.stages.size();
    return flat_tubes_ && n > 1 && out_.stages[n - 1].formulation == Formulation::arc &&
           out_.stages[n - 2].formulation == Formulation::arc;
  }

  /// By how much the value would rise if the gaps under load closed, to first order: a force is the value's
  /// derivative with respect to its gap, so this is the sum of force times gap.
  double room_under_load() const
  {
    Request request;
    request.order = 1;
    request.points = true;
    const Stage& last = out_.stage;
    const ContactEnergy e =
        contact_energy(m_, out_.state, stage_pairs(m_, out_.state, last), last.contact, request);
    double room = 0.0;
    for (const ContactEnergy::Point& p : e.points) room += last.mu * p.contact.force * p.contact.gap;
    return room;
  }

  StageResult attempt(const State& before, const PlannedStage& plan)
  {
    State s = before;
    extrapolate(s, plan);
    const State from = schedule_.keep_path ? s : State();
    Stage stage = make_stage(plan);
    stage.most_evaluations = most_evaluations_ - out_.evaluations;
    StageResult r = solve_stage(m_, s, load_, stage, keep_going_, &bounds_);
    out_.iterations += r.iterations;
    out_.evaluations += r.evaluations;
    if (schedule_.keep_path) {
      path_.assign(1, from);
      path_.insert(path_.end(), r.path.begin(), r.path.end());
    }
    out_.state = std::move(s);
    return r;
  }

  /// y(g_hat) is asymptotically linear: continue the line through the last two stages' ends. Barriers push
  /// alike (barrier.hpp), so it goes on where the formulation changes.
  void extrapolate(State& s, PlannedStage plan)
  {
    const std::size_t n = out_.stages.size();
    if (n < 2 || !previous_) return;
    const double a = out_.stages[n - 2].g_hat, b = out_.stages[n - 1].g_hat;
    const Vector dy = ((plan.g_hat - b) / (b - a)) * difference(m_, *previous_, s);
    plan.last = false;
    const SafeStep safe = checked_step(m_, s, dy, 0.05, make_stage(plan), &bounds_);
    out_.evaluations += safe.evaluations;
    const State next = advanced(m_, s, dy, safe.alpha);
    if (m_.load->admissible(next.macro_values())) s = next;
  }

  const Model& m_;
  const Vector& load_;
  ContactChoice choice_;
  const Schedule& schedule_;
  const KeepGoing& keep_going_;
  double size_;
  long most_evaluations_;  ///< in all, but for what balances forces
  GapBounds bounds_;
  bool arc_to_the_end_ = false;
  bool arc_while_wide_ = false;
  bool flat_tubes_ = false;  ///< there are some, which ribbons are of
  bool blind_ = false;       ///< a stage over ribbons was blocked by what they do not see
  bool before_valid_ = false;
  std::vector<State> path_;        ///< of the last attempt, from where its stage began
  std::optional<State> previous_;  ///< end of the stage before the last finished one
  Locked out_;
};

}  // namespace

bool has_flat_tubes(const Model& m)
{
  return std::ranges::any_of(m.bodies, [](const Body& b) { return b.is_ellipse(); });
}

Stage barrier_stage(const Model& m, double size, ContactChoice choice, const Schedule& schedule,
                    const PlannedStage& plan)
{
  const auto& [g_hat, f, quadrature, sides, last] = plan;
  Stage s;
  s.contact = {f, g_hat, m.clearance, schedule.search};
  s.contact.quadrature = quadrature;
  s.contact.sides = sides;
  s.contact.threads = schedule.threads;
  s.ccd = schedule.ccd;
  s.target = schedule.target;
  s.mu = schedule.stiffness * g_hat * size;
  s.keep_path = schedule.keep_path;
  s.tolerance = last ? schedule.last_tolerance : schedule.tolerance;
  const bool rough = traits(f).is_integral && quadrature == Quadrature::rough;
  const bool ends_at_noise = last && rough && schedule.ends_at_noise;
  if (ends_at_noise) s.tolerance_of_noise = schedule.tolerance;
  s.balance = last && !ends_at_noise;
  s.most_iterations = schedule.most_iterations;
  if (choice == ContactChoice::automatic && f == Formulation::nearest)
    s.least_curvature = least_regular_curvature(g_hat);
  return s;
}

Locked barrier_lock(const Model& model, const State& start, const Vector& load, ContactChoice choice,
                    const Schedule& schedule, const KeepGoing& keep_going)
{
  return Path(model, start, load, choice, schedule, keep_going).run();
}

}  // namespace hauberk
