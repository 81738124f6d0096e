#include "equilibrium/newton.hpp"

#include "equilibrium/quadratic_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace hauberk {
namespace {

constexpr double first_radius = 0.1;    ///< L: trust radius at the start of a stage
constexpr double largest_radius = 0.5;  ///< L, of few elements
/// The norm of a step in which every element moves equally far grows with the root of their number; beyond
/// this number the largest radius does, too.
constexpr double few_elements = 32.0;
constexpr double smallest_radius = 1e-13;  ///< L: a hundred times the rounding of coordinates
constexpr double smallest_escape = 1e-6;   ///< L: shorter steps along negative curvature are not tried
constexpr int most_slides = 50;            ///< times `most_iterations`: the most steps of a stage
/// The published fade makes valleys along which rings roll on towards ever smaller eigenvalues, downhill by
/// next to nothing: so many escapes without a noticeable decrease are enough there.
constexpr int most_idle_escapes = 20;
constexpr double longest_growth = 1.5;  ///< of a stretch of the lattice in one step of a path that is kept
constexpr double noise = 1e-15;         ///< relative rounding of energies
/// Relative change of an arc's energy when its panels change from step to step (about the panel rule's
/// error); decreases below fifty times this are judged by the gradient.
constexpr double quadrature_noise = 1e-9, rough_quadrature_noise = 1e-7;
/// There, steps that shrink the gradient by less than this only stir the rounding.
constexpr double worthwhile = 0.7;

/// Forces that miss the load by more than this part of it are not at their rounding yet, and may be improved
/// by smaller factors, with steps of other lengths, so many times in a stage.
constexpr double balanced = 1e-5;
constexpr double noticed_gain = 0.98;
constexpr double widen = 30.0;
constexpr int most_rescues = 20;

class Newton {
 public:
  Newton(const Model& m, State& state, const Vector& load, const Stage& stage, const KeepGoing& keep_going,
         GapBounds& bounds)
      : m_(m),
        state_(state),
        load_(load),
        stage_(stage),
        keep_going_(keep_going),
        bounds_(bounds),
        load_norm_(load_size(m, load)),
        most_radius_(largest_radius * std::sqrt(std::max(1.0, m.element_count() / few_elements))),
        model_(m, load_norm_)
  {
  }

  /// The end where contact was not evaluated to its end.
  StageResult interrupted() { return finish({StageStatus::interrupted, "interrupted"}); }

  StageResult run()
  {
    if (!begin()) return finish({StageStatus::stalled, "the stage starts with a gap that is not positive"});
    for (;;) {
      if (const std::optional<End> end = give_up()) return finish(*end);
      ModelStep step = model_.newton_step(now_, radius_);
      // Forces that miss the load by more than rounding does: other lengths of steps may balance them.
      const bool unbalanced = rescues_ < most_rescues && dual_norm(now_.gradient) > balanced * load_norm_;
      const bool rescue = unbalanced && stage_.balance;
      bool escape = false;
      if (step.predicted < stage_.tolerance * stage_.mu || (escaping_ && rejected_ > 0)) {
        const Stationary found = at_stationary_point(step, unbalanced);
        if (found == Stationary::minimum) return finish({StageStatus::minimum, ""});
        if (found == Stationary::too_short) continue;
        escape = true;
      }
      escaping_ = escape;
      ++result_.iterations;
      Trial trial = attempt(step);
      if (better(trial, rescue)) {
        accept(std::move(trial), rescue, escape);
        if (const std::optional<End> end = out_of_bounds()) return finish(*end);
      } else if (const std::optional<End> end = reject(trial, step, rescue)) {
        return finish(*end);
      }
    }
  }

 private:
  struct End {
    StageStatus status;
    std::string message;
  };

  /// A step that was tried, and the state it leads to.
  struct Trial {
    State state;
    TotalEnergy energy;
    double alpha = 0.0;   ///< fraction of the step that was taken; 0: none of it is certified
    double length = 0.0;  ///< of the whole step
    double predicted = 0.0, actual = 0.0;  ///< decrease of the energy
    bool tiny = false;                     ///< decreases are within the rounding of the energy
  };

  /// What a point is where the quadratic model promises no more than the tolerance.
  enum class Stationary {
    minimum,
    too_short,  ///< the radius, which is wider from here on, hid what is left to gain
    saddle      ///< the step goes along negative curvature
  };

  /// Evaluates the start; false where it is not admissible.
  bool begin()
  {
    pairs_ = stage_pairs(m_, state_, stage_);
    now_ = total_energy(m_, state_, load_, stage_, pairs_, 2, &bounds_);
    result_.evaluations += now_.contact.evaluations;
    noticed_ = now_.energy;
    if (!now_.admissible) return false;
    model_.go_to(now_);
    return true;
  }

  /// Why no further step is tried.
  std::optional<End> give_up()
  {
    if (!keep_going_()) return End{StageStatus::interrupted, "interrupted"};
    if (result_.evaluations > stage_.most_evaluations)
      return End{StageStatus::spent, "no minimum within the evaluations that it may have"};
    if (now_.contact.regularity < stage_.least_curvature)
      return End{StageStatus::merging, "a contact comes near to merging with another"};
    // A state may have to slide a long way through a channel as narrow as the gaps, in many short steps:
    // what counts is whether it still goes down.
    if (now_.energy < noticed_ - stage_.mu) {
      noticed_ = now_.energy;
      noticed_at_ = result_.iterations;
      escapes_then_ = result_.escapes;
    }
    const int idle = result_.iterations - noticed_at_;
    if (idle < stage_.most_iterations && result_.iterations / most_slides < stage_.most_iterations) return {};
    return End{StageStatus::iteration_limit,
               fmt::format("no minimum after {} Newton steps, the last {} without a noticeable decrease",
                           result_.iterations, idle)};
  }

  /// Of a saddle the step becomes one along its most negative curvature.
  Stationary at_stationary_point(ModelStep& step, bool unbalanced)
  {
    if (!step.shifted) return Stationary::minimum;
    if (!escaping_ && unbalanced && widening_pays() && step_norm(m_, step.dy) > 0.5 * radius_ &&
        radius_ < first_radius) {
      ++rescues_;
      widened_at_ = now_.energy;
      radius_ = std::min(first_radius, widen * radius_);
      return Stationary::too_short;
    }
    // Negative curvature that lowers the energy by nothing at any length was rounding.
    if (escaping_ && radius_ < smallest_escape) return Stationary::minimum;
    if (!model_.saddle_step(now_, radius_, step)) return Stationary::minimum;
    const bool idle = result_.escapes - escapes_then_ >= most_idle_escapes;
    return traits(stage_.contact.formulation).fades && idle ? Stationary::minimum : Stationary::saddle;
  }

  /// Contacts that the model does not see, as they are out of reach, turn long steps back, and the radius
  /// shrinks to the width of the channel between contacts. What a step of that length promises says nothing
  /// about how far the channel still goes down: left in a wide stage, the rest of the way is gone in narrow
  /// ones, in steps that are shorter as their gaps are. So a stage widens the radius again while that gains
  /// anything; its forces need not balance, as those of the last stage do. `nearest` alone, without a least
  /// curvature that hands contacts that merge to `arc`, has no minimum where they do, and ends there.
  bool widening_pays() const
  {
    if (stage_.balance) return true;
    if (stage_.contact.formulation == Formulation::nearest && !std::isfinite(stage_.least_curvature))
      return false;
    return now_.energy < widened_at_ - stage_.tolerance * stage_.mu;
  }

  Trial attempt(const ModelStep& step)
  {
    Trial t;
    t.alpha = try_step(step.dy, t.state, t.energy);
    t.length = step_norm(m_, step.dy);
    if (t.alpha > 0.0) {
      t.predicted = -model_.change(now_, step.dy, t.alpha);
      t.actual = now_.energy - t.energy.energy;
    }
    t.tiny = std::abs(t.predicted) < 50.0 * energy_rounding();
    return t;
  }

  double energy_rounding() const
  {
    const double rounding = noise * (std::abs(now_.energy) + 1.0);
    if (!traits(stage_.contact.formulation).is_integral) return rounding;
    const bool rough = stage_.contact.quadrature == Quadrature::rough;
    return rounding + (rough ? rough_quadrature_noise : quadrature_noise) * stage_.mu * now_.contact.energy;
  }

  /// Below the rounding of the energy the gradient decides.
  bool better(const Trial& t, bool rescue) const
  {
    if (!(t.alpha > 0.0) || !t.energy.admissible) return false;
    if (!t.tiny) return t.actual > 1e-3 * std::max(t.predicted, 0.0);
    return dual_norm(t.energy.gradient) < (rescue ? noticed_gain : worthwhile) * dual_norm(now_.gradient);
  }

  /// Shortens the radius, or says what the point is where no length of a step gains anything.
  std::optional<End> reject(const Trial& t, ModelStep& step, bool rescue)
  {
    if (t.tiny && rescue) {
      // The energy is at its rounding, the forces are not at theirs: another length may balance them.
      ++rescues_;
      radius_ = rescues_ % 2 == 1 && step.shifted ? std::min(first_radius, widen * radius_)
                                                  : 0.3 * std::max(t.alpha, 1e-3) * t.length;
      return {};
    }
    // Nothing more can be gained above rounding, or noise: a minimum unless the curvature says otherwise.
    const double noise_of_stage = stage_.tolerance_of_noise * stage_.mu;
    const bool is_whole = !step.shifted || step_norm(m_, step.dy) < 0.5 * radius_;  // no radius shortened it
    const bool noisy =
        is_whole && t.alpha > 0.0 && step.predicted < noise_of_stage && std::abs(t.actual) < noise_of_stage;
    if ((t.tiny || noisy) && t.energy.admissible &&
        (!step.shifted || !model_.saddle_step(now_, radius_, step)))
      return End{StageStatus::minimum, ""};
    ++rejected_;
    radius_ = 0.25 * std::min(radius_, std::max(t.alpha, 1e-3) * t.length);
    if (!(radius_ < smallest_radius)) return {};
    // Nothing above rounding is gained at any length: the balance of forces judges what this is.
    if (t.tiny && t.energy.admissible) return End{StageStatus::minimum, ""};
    if (!(t.alpha > 0.0)) {
      return End{StageStatus::stalled,
                 fmt::format("no part of a step is certified free of collisions, smallest gap {:.1e} L",
                             now_.contact.min_gap)};
    }
    return End{StageStatus::stalled,
               fmt::format("no step lowers the energy: predicted {:.1e}, found {:.1e}, smallest gap {:.1e} L",
                           t.predicted, t.actual, now_.contact.min_gap)};
  }

  /// Goes to the trial's state; the radius follows how well the quadratic model foresaw the decrease.
  void accept(Trial&& t, bool rescue, bool escape)
  {
    rejected_ = 0;
    if (t.tiny && rescue && dual_norm(t.energy.gradient) > worthwhile * dual_norm(now_.gradient)) ++rescues_;
    if (escape) ++result_.escapes;
    const double ratio = t.tiny ? 1.0 : t.actual / std::max(t.predicted, 1e-300);
    if (ratio < 0.25) {
      radius_ = 0.5 * std::min(radius_, t.alpha * t.length);
    } else if (ratio > 0.6) {
      radius_ = std::min(longest_step(t.energy), std::max(radius_, 2.5 * t.alpha * t.length));
    }
    state_ = std::move(t.state);
    now_ = std::move(t.energy);
    if (stage_.keep_path) result_.path.push_back(state_);
    model_.go_to(now_);
  }

  /// Why no path leads on from the state.
  std::optional<End> out_of_bounds() const
  {
    if (runaway()) return End{StageStatus::unbounded, "the strain leaves every bound"};
    if (std::string why = not_a_sheet(m_, state_); !why.empty())
      return End{StageStatus::not_a_sheet, std::move(why)};
    return {};
  }

  StageResult finish(const End& end)
  {
    result_.status = end.status;
    result_.message = end.message;
    result_.energy = now_.energy;
    result_.residual = now_.admissible ? dual_norm(now_.gradient) / load_norm_ : 0.0;
    return result_;
  }

  double dual_norm(const Vector& g) const
  {
    return std::sqrt((g.cwiseAbs2().array() / m_.metric.array()).sum());
  }

  /// Shortens the step until it is certified and admissible, evaluates its end. Returns the fraction taken.
  double try_step(const Vector& dy, State& trial, TotalEnergy& next)
  {
    double alpha = 1.0;
    trial = advanced(m_, state_, dy, 1.0);
    for (int k = 0; k < 40 && !m_.load->admissible(trial.macro_values()); ++k) {
      alpha *= 0.5;
      trial = advanced(m_, state_, dy, alpha);
    }
    // Of a lattice that changes by more, ever more images could meet on the way.
    const auto too_far = [this](const State& s) {
      const auto [lo, hi] = stretches(state_);
      const auto [low, high] = stretches(s);
      return high > longest_growth * hi || low * longest_growth < lo;
    };
    while (stage_.keep_path && !m_.lattice.empty() && too_far(trial)) {
      alpha *= 0.5;
      trial = advanced(m_, state_, dy, alpha);
    }
    const SafeStep safe = checked_step(m_, state_, alpha * dy, keep_gap, stage_, &bounds_);
    result_.evaluations += safe.evaluations;
    if (safe.alpha <= 0.0) return 0.0;
    if (safe.alpha < 1.0) {
      alpha *= safe.alpha;
      trial = advanced(m_, state_, dy, alpha);
    }
    pairs_ = stage_pairs(m_, trial, stage_);
    next = total_energy(m_, trial, load_, stage_, pairs_, 2, &bounds_);
    result_.evaluations += next.contact.evaluations;
    return alpha;
  }

  /// Where a path may run away its steps grow with the strain, so that decades of it take few; with nothing
  /// in reach they only need to be certified.
  double longest_step(const TotalEnergy& e) const
  {
    if (!stage_.keep_path) return most_radius_;
    if (e.contact.energy == 0.0) return std::numeric_limits<double>::infinity();
    const auto [lo, hi] = stretches(state_);
    return most_radius_ * std::max({1.0, hi, 1.0 / lo});
  }

  /// Smallest and largest stretch of a state's lattice or surface.
  std::pair<double, double> stretches(const State& s) const
  {
    return m_.load->stretch_range(s.macro_values());
  }

  bool runaway() const
  {
    const auto [lo, hi] = stretches(state_);
    return lo < 1e-3 || hi > 1e3;
  }

  const Model& m_;
  State& state_;
  const Vector& load_;
  const Stage& stage_;
  const KeepGoing& keep_going_;
  GapBounds& bounds_;
  const double load_norm_, most_radius_;
  QuadraticModel model_;
  TotalEnergy now_;                        ///< at the state
  double radius_ = first_radius;           ///< of the trust region, L
  bool escaping_ = false;                  ///< the last step went along negative curvature
  int rejected_ = 0;                       ///< steps since the last accepted one
  int rescues_ = 0;                        ///< steps that were taken, or widened, to balance forces
  double noticed_ = 0.0;                   ///< energy at the last noticeable decrease
  int noticed_at_ = 0, escapes_then_ = 0;  ///< steps and escapes at that time
  /// Energy when the radius was widened last.
  double widened_at_ = std::numeric_limits<double>::infinity();
  std::vector<ElementPair> pairs_;
  StageResult result_;
};

}  // namespace

StageResult solve_stage(const Model& model, State& state, const Vector& load, const Stage& stage,
                        const KeepGoing& keep_going, GapBounds* bounds)
{
  GapBounds own;
  Stage polled = stage;
  polled.contact.keep_going = &keep_going;
  Newton newton(model, state, load, polled, keep_going, bounds != nullptr ? *bounds : own);
  try {
    return newton.run();
  } catch (const Interrupted&) {  // within a step, which is then not taken
    return newton.interrupted();
  }
}

}  // namespace hauberk
