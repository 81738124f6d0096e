#include "equilibrium/newton.hpp"

#include "contact/published.hpp"
#include "equilibrium/curvature.hpp"
#include "model/near_pairs.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
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

/// Shift that null directions carry, relative to the largest scaled diagonal of the Hessian (rounding) and
/// to the load (curvatures below it do not matter).
constexpr double rounding_shift = 1e-14;
constexpr double load_shift = 1e-7;

/// Curvature below -this times the load counts as a saddle.
constexpr double saddle_curvature = 1e-5;

/// Step of the shifted Newton system.
struct Step {
  Vector dy;
  double lambda = 0.0;
  double predicted = 0.0;  ///< decrease of the unshifted quadratic model, >= 0
  bool shifted = false;    ///< lambda had to exceed the floor
};

class Newton {
 public:
  Newton(const Model& m, State& state, const Vector& load, const Stage& stage, const KeepGoing& keep_going,
         GapBounds& bounds)
      : m_(m), state_(state), load_(load), stage_(stage), keep_going_(keep_going), bounds_(bounds)
  {
    most_radius_ = largest_radius * std::sqrt(std::max(1.0, m.element_count() / few_elements));
    load_norm_ = load_size(m, load);
  }

  /// The end where contact was not evaluated to its end.
  StageResult interrupted() { return finish({StageStatus::interrupted, "interrupted"}); }

  StageResult run()
  {
    if (!begin()) return finish({StageStatus::stalled, "the stage starts with a gap that is not positive"});
    for (;;) {
      if (const std::optional<End> end = give_up()) return finish(*end);
      Step step = newton_step(now_, radius_);
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
    curvature_ = curvature_of(m_, now_, order_);
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
  Stationary at_stationary_point(Step& step, bool unbalanced)
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
    if (!saddle_step(now_, radius_, step)) return Stationary::minimum;
    const bool idle = result_.escapes - escapes_then_ >= most_idle_escapes;
    return stage_.contact.formulation == Formulation::published && idle ? Stationary::minimum
                                                                        : Stationary::saddle;
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

  Trial attempt(const Step& step)
  {
    Trial t;
    t.alpha = try_step(step.dy, t.state, t.energy);
    t.length = step_norm(m_, step.dy);
    const double slope = now_.gradient.dot(step.dy);
    if (t.alpha > 0.0) {
      t.predicted = -(t.alpha * slope + 0.5 * t.alpha * t.alpha * step.dy.dot(curvature_->times(step.dy)));
    }
    if (t.alpha > 0.0) t.actual = now_.energy - t.energy.energy;
    t.tiny = std::abs(t.predicted) < 50.0 * energy_rounding();
    return t;
  }

  double energy_rounding() const
  {
    const double rounding = noise * (std::abs(now_.energy) + 1.0);
    if (stage_.contact.formulation != Formulation::arc) return rounding;
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
  std::optional<End> reject(const Trial& t, Step& step, bool rescue)
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
    if ((t.tiny || noisy) && t.energy.admissible && (!step.shifted || !saddle_step(now_, radius_, step)))
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
    curvature_ = curvature_of(m_, now_, order_);
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

  Step newton_step(const TotalEnergy& e, double radius)
  {
    Step s;
    const double scale = curvature_->scale();
    const double floor = std::max(load_shift * load_norm_, rounding_shift * scale);
    double lambda = floor, too_low = 0.0;
    const auto raise = [&] {
      too_low = lambda;
      lambda = std::max(8.0 * lambda, 1e-4 * load_norm_);
      s.shifted = true;
    };
    // Shifts that a known direction of negative curvature rules out are not tried.
    if (soft_.size() > 0) {
      const double needed = -soft_.dot(curvature_->times(soft_));
      while (lambda <= needed) raise();
    }
    bool softened = false;
    for (int it = 0; it < 60; ++it) {
      if (!curvature_->factor(lambda)) {
        raise();
        continue;
      }
      if (s.shifted && !softened) soften();
      softened = true;
      s.dy = -curvature_->solve(e.gradient);
      s.lambda = lambda;
      const double norm = step_norm(m_, s.dy);
      if (norm <= 1.1 * radius) break;
      // Newton on the secular equation 1/norm(lambda) = 1/radius.
      const Vector w = m_.metric.cwiseProduct(s.dy);
      const double q = w.dot(curvature_->solve(w));
      double next = lambda + (norm * norm / q) * (norm - radius) / radius;
      if (!(next > lambda)) next = 2.0 * lambda;
      lambda = std::max(next, too_low * 1.5);
      if (lambda > 2.0 * floor) s.shifted = true;
    }
    if (s.dy.size() == 0) {
      throw ComputationError(fmt::format(
          "the curvature of a state with a smallest gap of {:.1e} L cannot be factorised at any shift",
          e.contact.min_gap));
    }
    s.predicted = -(e.gradient.dot(s.dy) + 0.5 * s.dy.dot(curvature_->times(s.dy)));
    if (s.predicted < 0.0) s.predicted = -0.5 * e.gradient.dot(s.dy);
    return s;
  }

  /// Turns `soft_` towards the direction of least curvature, by inverse iteration with what was factored.
  void soften()
  {
    int steps = 2;
    if (soft_.size() == 0) {
      steps = 5;
      soft_ = unsymmetric(m_.dofs());
    }
    for (int k = 0; k < steps; ++k) {
      soft_ = curvature_->solve(m_.metric.cwiseProduct(soft_));
      soft_ /= step_norm(m_, soft_);
    }
  }

  /// At a stationary point that may be a saddle: a step along the most negative curvature, or false.
  bool saddle_step(const TotalEnergy& e, double radius, Step& s)
  {
    Vector d;
    const double lowest = curvature_->lowest(s.lambda, d);
    if (lowest > -std::max(saddle_curvature * load_norm_, 10.0 * rounding_shift * curvature_->scale()))
      return false;
    const double slope = e.gradient.dot(d);
    if (slope > 0.0) d = -d;
    const double length = std::min(radius, 0.05);
    s.dy = length * d;
    s.predicted = -(e.gradient.dot(s.dy) + 0.5 * s.dy.dot(curvature_->times(s.dy)));
    s.shifted = true;
    return true;
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
  double load_norm_ = 1.0, most_radius_ = largest_radius;
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
  EliminationOrder order_;
  std::unique_ptr<Curvature> curvature_;  ///< of the state's energy
  Vector soft_;  ///< unit length in the step norm, of little curvature when last looked at; or empty
  StageResult result_;
};

}  // namespace

SafeStep checked_step(const Model& m, const State& from, const Vector& dy, double keep, const Stage& stage,
                      GapBounds* bounds)
{
  if (stage.ccd == CollisionCheck::certified || stage.contact.formulation == Formulation::mesh)
    return largest_safe_step(m, from, dy, keep, stage.contact.threads, bounds, stage.contact.keep_going);
  return sampled_safe_step(m, from, dy, std::sqrt(published::d_th) * stage.contact.g_hat);
}

std::vector<ElementPair> stage_pairs(const Model& m, const State& s, const Stage& stage)
{
  return near_pairs(m, s, stage.contact.g_hat + stage.contact.clearance);
}

namespace {

/// K of what the objective adds to -load . macro, 1/2 macro . K macro; empty: nothing.
Matrix macro_stiffness(const Model& m, const Stage& stage)
{
  const bool finite = std::isfinite(stage.target);
  if (!finite && stage.tether.cols() == 0) return {};
  Matrix K = Matrix::Zero(m.macro_count, m.macro_count);
  if (finite && m.macro_square.size() > 0)
    K = m.macro_square / stage.target;
  else if (finite)
    K.diagonal().setConstant(1.0 / stage.target);
  if (stage.tether.cols() > 0) K += stage.tether_stiffness * stage.tether * stage.tether.transpose();
  return K;
}

/// With that K.
Vector driving_load(const Matrix& K, const State& s, const Vector& load)
{
  return K.size() > 0 ? Vector(load - K * s.macro) : load;
}

}  // namespace

double load_size(const Model& m, const Vector& load)
{
  return std::sqrt((load.cwiseAbs2().array() / m.metric.head(m.macro_count).array()).sum());
}

Vector driving_load(const Model& m, const State& s, const Vector& load, const Stage& stage)
{
  return driving_load(macro_stiffness(m, stage), s, load);
}

TotalEnergy total_energy(const Model& m, const State& s, const Vector& load, const Stage& stage,
                         const std::vector<ElementPair>& pairs, int order, const GapBounds* bounds)
{
  TotalEnergy t;
  Request request;
  request.order = order;
  t.contact = contact_energy(m, s, pairs, stage.contact, request, bounds);
  t.admissible = t.contact.min_gap > 0.0;
  t.energy = stage.mu * t.contact.energy - load.dot(s.macro);
  const Matrix K = macro_stiffness(m, stage);
  if (order >= 1) {
    t.gradient = stage.mu * t.contact.gradient;
    t.gradient.head(m.macro_count) -= driving_load(K, s, load);
  }
  if (order >= 2) {
    t.hessian = stage.mu * t.contact.hessian;
    t.sparse_hessian = stage.mu * t.contact.sparse_hessian;
  }
  if (K.size() > 0) {
    t.energy += 0.5 * s.macro.dot(K * s.macro);
    for (int k = 0; order >= 2 && k < m.macro_count; ++k) {
      for (int l = 0; l < (m.sparse() ? k + 1 : m.macro_count); ++l)
        (m.sparse() ? t.sparse_hessian.coeffRef(k, l) : t.hessian(k, l)) += K(k, l);
    }
  }
  if (m.held.cols() > 0) {
    if (order >= 1) t.gradient = free_part(m, t.gradient);
    if (order >= 2 && !m.sparse()) hold(m, t.hessian);
  }
  return t;
}

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
