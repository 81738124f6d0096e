#pragma once
/// Interface for optimizers: minimise a problem that the kernel owns, from a start, under an observer.

#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// min f(x) subject to lower <= x <= upper and c(x) >= 0 (component-wise).
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

  struct Evaluation {
    bool ok = false;  ///< false: the point could not be evaluated (treated as infinitely bad); `why` says why
    double value = 0.0;
    std::vector<double> gradient;  ///< empty when not wanted
    std::string why;
  };
  /// Objective, and its gradient when wanted.
  virtual Evaluation evaluate(std::span<const double> x, bool want_gradient) = 0;

  /// Number of residuals where the objective is half the sum of their squares, else 0.
  virtual int residual_count() const = 0;

  /// Residuals r (size residual_count) at the point that was evaluated last, and their Jacobian, row-major
  /// residual_count x size of x: f = 1/2 sum r_i^2. False when they are not known there. Residuals may have
  /// kinks; an optimizer sees more of them through residuals than through the gradient of their sum. Entry
  /// i * n + k of the Jacobian is d r_i/d x_k, n the size of x. Neither span may be empty.
  virtual bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) = 0;

  /// Inequality constraints c (size constraint_count, never empty where there are any) and their Jacobian,
  /// row-major count x size of x; an empty `jacobian` means that it is not wanted.
  virtual void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) = 0;

  /// Largest alpha in [0, 1] such that x + s d stays free of intersections for all s in [0, alpha], where x
  /// is the last accepted point.
  virtual double largest_safe_step(std::span<const double> x, std::span<const double> d) = 0;

  /// Makes x, just evaluated, the new iterate: warm starts continue from its states. A problem may look at an
  /// iterate more closely than at a trial, so its value, gradient and residuals can change here: evaluating x
  /// again costs nothing and tells.
  virtual void accept(std::span<const double> x) = 0;
};

/// What an optimizer tells about each iterate.
struct OptimizerIterate {
  int iteration = 0;
  double value = 0.0;
  double step = 0.0;                  ///< accepted step length, 0 for the start
  double constraint_violation = 0.0;  ///< max(0, -min c)
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

/// A local optimizer for smooth constrained problems. Immutable after construction; `minimize` may be called
/// from several threads on different problems.
class Optimizer {
 public:
  virtual ~Optimizer() = default;
  /// Minimises from `start` (which must be within bounds). Throws PluginError when the result breaks the
  /// contract (wrong size, not finite, outside bounds).
  OptimizerResult minimize(OptimizationProblem& problem, std::span<const double> start,
                           OptimizerObserver& observer) const;

 protected:
  virtual OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                                      OptimizerObserver& observer) const = 0;
};

}  // namespace hauberk
