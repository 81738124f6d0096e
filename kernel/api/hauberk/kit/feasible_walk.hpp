#pragma once
/// A descent between the constraints, which keeps the contract of OptimizationProblem, so that an optimizer
/// has to say no more than where to go.
///
///     kit::FeasibleWalk walk(problem, start, observer, {1000, 10000});
///     while (walk.going()) {
///       if (walk.optimality() <= 1e-6) return walk.end("converged", "the projected gradient is small");
///       walk.move(walk.step(0.1));
///     }
///     return walk.end();

#include <hauberk/optimizer.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::kit {

/// The sum of products of components.
inline double dot(std::span<const double> a, std::span<const double> b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// The largest component by size; 0 where there is none, not a number where one is none.
inline double largest(std::span<const double> a)
{
  return std::accumulate(a.begin(), a.end(), 0.0, [](double most, double x) {
    return std::isnan(most) || std::abs(x) <= most ? most : std::abs(x);
  });
}

/// A walk from iterate to iterate, all of them within the bounds and the constraints. It asks how far a way
/// is safe before it evaluates anything there, takes points that cannot be evaluated, are not finite or
/// violate a constraint for infinitely bad, accepts, tells the observer and counts. So it needs a start that
/// satisfies the constraints ("failed" otherwise, with nothing evaluated), and ends with "small_step" where
/// it meets one that it cannot pass. Violations up to `feasible` count as none.
///
/// Decrease is asked of the largest of the last `memory` values (Grippo, Lampariello and Lucidi, SIAM J.
/// Numer. Anal. 23, 1986), which lets a method cross a curved valley at full steps; with a memory of 1 every
/// iterate is better than the one before. Not thread safe; what the problem and the observer throw passes
/// through.
class FeasibleWalk {
 public:
  using Vector = std::vector<double>;

  struct Limits {
    int iterations = 1000;    ///< accepted steps
    int evaluations = 10000;  ///< of the objective; the start is always evaluated
    std::size_t memory = 8;   ///< values that the next one must be below one of
    double feasible = 1e-8;   ///< violation that counts as none
  };

  /// Evaluates and accepts the start.
  FeasibleWalk(OptimizationProblem& problem, std::span<const double> start, OptimizerObserver& observer,
               const Limits& limits)
      : problem_(problem), observer_(observer), limits_(limits), x_(start.begin(), start.end()), best_(x_)
  {
    if (violation(x_) > limits_.feasible) {
      stop("failed", "the start violates the constraints, and this method begins where they hold");
      return;
    }
    const OptimizationProblem::Evaluation here = evaluate(x_);
    best_value_ = here.value;
    if (!here.ok)
      stop("failed", "the start cannot be evaluated: " + here.why);
    else
      take(here, 0.0);
  }

  /// False once the walk has ended: see end().
  bool going() const { return status_.empty(); }

  const Vector& x() const { return x_; }                ///< the iterate
  double value() const { return value_; }               ///< of the objective there
  const Vector& gradient() const { return gradient_; }  ///< of the objective there

  /// P(x - scale gradient) - x, with P the projection onto the bounds.
  Vector step(double scale) const
  {
    Vector d(x_.size());
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = within(i, x_[i] - scale * gradient_[i]) - x_[i];
    return d;
  }

  /// The largest component of step(1): 0 at a minimum that meets no constraint but bounds.
  double optimality() const { return largest(step(1.0)); }

  /// Moves the iterate along d, as far as is safe or a part of that: to the first of the points that are good
  /// enough. Without one, or where the budget is spent or the observer says so, the walk has ended, and false
  /// is returned.
  bool move(const Vector& d)
  {
    if (!going()) return false;
    if (iterations_ >= limits_.iterations)
      return stop("iteration_limit", "stopped after " + std::to_string(iterations_) + " iterations");
    constexpr double armijo = 1e-4, shorter = 0.4, shortest = 1e-12;
    const double bar = *std::max_element(recent_.begin(), recent_.end()), slope = dot(gradient_, d);
    double alpha = problem_.largest_safe_step(x_, d);
    // 0 and not-a-number end the search.
    for (; alpha * largest(d) > shortest * (1.0 + largest(x_)); alpha *= shorter) {
      Vector x(d.size());
      for (std::size_t i = 0; i < d.size(); ++i) x[i] = within(i, x_[i] + alpha * d[i]);
      if (violation(x) > limits_.feasible) continue;
      if (evaluations_ >= limits_.evaluations)
        return stop("iteration_limit", "stopped after " + std::to_string(evaluations_) + " evaluations");
      const OptimizationProblem::Evaluation there = evaluate(x);
      if (!there.ok || !(there.value <= bar + armijo * alpha * slope)) continue;
      x_ = std::move(x);
      ++iterations_;
      return take(there, alpha);
    }
    return stop("small_step", "no step that is safe, allowed and better was found");
  }

  /// The best iterate, and why the walk ended.
  OptimizerResult end() const { return end(status_, message_); }
  /// The best iterate, with a reason of the method's own.
  OptimizerResult end(const std::string& status, const std::string& message) const
  {
    return {status, message, best_, best_value_, iterations_, evaluations_};
  }

 private:
  double within(std::size_t i, double x) const
  {
    return std::clamp(x, problem_.lower()[i], problem_.upper()[i]);
  }

  /// The largest of |c| over equations and max(0, -c) over the others; infinite where one is not a number.
  double violation(const Vector& x)
  {
    Vector c(static_cast<std::size_t>(problem_.constraint_count()));
    if (c.empty()) return 0.0;
    problem_.constraints(x, c, {});
    const auto equations = static_cast<std::size_t>(problem_.equality_count());
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = i < equations ? std::abs(c[i]) : std::max(0.0, -c[i]);
    const double worst = largest(c);
    return std::isnan(worst) ? std::numeric_limits<double>::infinity() : worst;
  }

  OptimizationProblem::Evaluation evaluate(const Vector& x)
  {
    ++evaluations_;
    return look(x);
  }

  /// An evaluation that is ok only where it is finite.
  OptimizationProblem::Evaluation look(const Vector& x)
  {
    OptimizationProblem::Evaluation e = problem_.evaluate(x, true);
    const auto finite = [](double v) { return std::isfinite(v); };
    if (e.ok && !(finite(e.value) && std::all_of(e.gradient.begin(), e.gradient.end(), finite))) {
      e.ok = false;
      e.why = "it is not finite";
    }
    return e;
  }

  /// Makes x_, just evaluated, the iterate. False when the observer stops.
  bool take(OptimizationProblem::Evaluation here, double length)
  {
    problem_.accept(x_);
    OptimizationProblem::Evaluation seen = look(x_);  // may have changed; costs nothing
    if (seen.ok) here = std::move(seen);
    value_ = here.value;
    gradient_ = std::move(here.gradient);
    if (iterations_ == 0 || value_ <= best_value_) {
      best_ = x_;
      best_value_ = value_;
    }
    recent_.push_back(value_);
    if (recent_.size() > limits_.memory) recent_.pop_front();
    const OptimizerIterate iterate{iterations_, value_, length, 0.0, optimality(), x_};
    return observer_.on_iterate(iterate) || stop("stopped", "stopped by the observer");
  }

  bool stop(const char* status, std::string message)
  {
    status_ = status;
    message_ = std::move(message);
    return false;
  }

  OptimizationProblem& problem_;
  OptimizerObserver& observer_;
  Limits limits_;
  Vector x_, gradient_, best_;
  double value_ = 0.0, best_value_ = 0.0;
  std::deque<double> recent_;  ///< values of the last iterates
  int iterations_ = 0, evaluations_ = 0;
  std::string status_, message_;
};

}  // namespace hauberk::kit
