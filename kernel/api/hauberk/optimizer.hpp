#pragma once
/// Interface for optimizers: minimise a problem that the kernel owns, from a start, under an observer.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// min f(x) subject to lower <= x <= upper and, component by component, c(x) = 0 for the first
/// `equality_count` constraints and c(x) >= 0 for the others. A constraint is violated by |c| or max(0, -c).
///
/// The objective is only defined where the path from the current accepted point is free of intersections:
/// ask `largest_safe_step` before evaluating at x + alpha d, and call `accept` on every new iterate.
///
/// A problem is not thread safe: an optimizer makes one call at a time. Every x that it evaluates lies within
/// the bounds, which stay valid and unchanged while it runs.
class OptimizationProblem {
 public:
  virtual ~OptimizationProblem() = default;

  virtual std::span<const double> lower() const = 0;
  virtual std::span<const double> upper() const = 0;
  virtual int constraint_count() const = 0;
  /// How many of the constraints, the first ones, are equations c(x) = 0.
  virtual int equality_count() const { return 0; }

  struct Evaluation {
    bool ok = false;  ///< false: the point could not be evaluated (treated as infinitely bad); `why` says why
    double value = 0.0;
    std::vector<double> gradient;  ///< empty when not wanted
    std::string why;
  };
  /// Objective, and its gradient when wanted.
  virtual Evaluation evaluate(std::span<const double> x, bool want_gradient) = 0;

  /// Evaluations of `count` points, row-major count x size of x, in their order: those that `evaluate` gives
  /// at each of them from the same accepted point, whatever their order and the number of threads. All ways
  /// are asked for by `largest_safe_step` beforehand; each point counts as one evaluation. Any of them may be
  /// accepted next; residuals are known only after a point was evaluated by itself. This implementation
  /// evaluates one after the other. Throws PluginError when the sizes contradict each other.
  virtual std::vector<Evaluation> evaluate_batch(std::size_t count, std::span<const double> points,
                                                 bool want_gradient);

  /// Number of residuals where the objective is half the sum of their squares, else 0.
  virtual int residual_count() const = 0;

  /// Residuals r (size residual_count) at the point that was evaluated last, and their Jacobian, row-major
  /// residual_count x size of x: f = 1/2 sum r_i^2. False when they are not known there. Residuals may have
  /// kinks; an optimizer sees more of them through residuals than through the gradient of their sum. Entry
  /// i * n + k of the Jacobian is d r_i/d x_k, n the size of x. Neither span may be empty.
  virtual bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) = 0;

  /// Constraints c (size constraint_count, never empty where there are any) and their Jacobian, row-major
  /// count x size of x; an empty `jacobian` means that it is not wanted.
  virtual void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) = 0;

  /// out = (weight f'' - sum_i multipliers_i c_i'') v at the accepted point x, which is the Hessian of the
  /// Lagrangian weight f - multipliers . c in the direction v. Sizes: multipliers constraint_count, v and out
  /// size of x. False where it is not known there, and then `out` means nothing.
  virtual bool hessian_product(std::span<const double> x, double weight, std::span<const double> multipliers,
                               std::span<const double> v, std::span<double> out);

  /// Largest alpha in [0, 1] such that x + s d stays free of intersections for all s in [0, alpha], where x
  /// is the last accepted point.
  virtual double largest_safe_step(std::span<const double> x, std::span<const double> d) = 0;

  /// Makes x, just evaluated by itself or in a batch, the new iterate: warm starts continue from its states.
  /// A problem may look at an iterate more closely than at a trial, so its value, gradient and residuals can
  /// change here: evaluating x again costs nothing and tells.
  virtual void accept(std::span<const double> x) = 0;

  /// Number of the stream of random numbers that a stochastic optimizer draws from (`seed_of_stream`): runs
  /// from several starts have different ones.
  virtual std::uint64_t stream() const { return 0; }

 protected:
  /// Throws PluginError unless `points` has the size of `count` points.
  void check_batch(std::size_t count, std::span<const double> points) const;
};

/// Seed of the draws of a stream: `seed` itself for stream 0; for others, well mixed bits of both (the
/// finaliser of SplitMix64: Steele, Lea and Flood, OOPSLA 2014). Thread safe.
std::uint64_t seed_of_stream(std::uint64_t seed, std::uint64_t stream);

/// What an optimizer tells about each iterate.
struct OptimizerIterate {
  int iteration = 0;
  double value = 0.0;
  double step = 0.0;                  ///< accepted step length, 0 for the start
  double constraint_violation = 0.0;  ///< the largest of |c| and max(0, -c)
  double optimality = 0.0;            ///< norm of the projected gradient of the Lagrangian
  std::span<const double> x;
};

/// Called after every iterate, in the optimizer's thread.
class OptimizerObserver {
 public:
  virtual ~OptimizerObserver() = default;
  /// Return false to stop; the optimizer then returns its best point with status "stopped".
  virtual bool on_iterate(const OptimizerIterate& iterate) = 0;
};

struct OptimizerResult {
  std::string status;     ///< "converged", "small_step", "iteration_limit", "stopped", "infeasible", "failed"
  std::string message;    ///< a sentence for people
  std::vector<double> x;  ///< best feasible point found (least violation if none is feasible)
  double value = 0.0;
  int iterations = 0;
  int evaluations = 0;
};

/// What an optimizer declares of itself, with its settings.
struct OptimizerTraits {
  /// Several threads may run `minimize` at once, on different problems. Otherwise the program lets one run of
  /// the plugin's library wait for another; a run that a problem starts in the thread that calls it does not
  /// wait.
  bool thread_safe = false;
  /// It keeps equality constraints. Otherwise problems that have any are refused before it sees them.
  bool equalities = false;
  /// It draws random numbers: all from the field `seed` of its section and the problem's `stream`, so that
  /// the same ones give the same run, bit for bit.
  bool stochastic = false;
};

/// An optimizer of constrained problems. Immutable after construction.
class Optimizer {
 public:
  virtual ~Optimizer() = default;
  /// The same in every call. Thread safe.
  virtual OptimizerTraits traits() const { return {}; }
  /// Minimises from `start` (which must be within bounds). Throws InputError where the problem has equality
  /// constraints that the optimizer does not keep, and PluginError when the result breaks the contract (wrong
  /// size, not finite, outside bounds). Thread safe as `traits` says.
  OptimizerResult minimize(OptimizationProblem& problem, std::span<const double> start,
                           OptimizerObserver& observer) const;

 protected:
  virtual OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                                      OptimizerObserver& observer) const = 0;
};

}  // namespace hauberk
