#pragma once
/// The point that an optimizer returns.

#include <hauberk/optimizer.hpp>

#include <Eigen/Core>

#include <string>

namespace hauberk {

/// The part of a value by which a closer look may change it.
constexpr double surprise = 1e-3;

/// Best point so far: feasible before infeasible, then by value or by violation. Not thread safe.
class BestPoint {
 public:
  /// Violations up to `tolerance` count as none.
  explicit BestPoint(double tolerance) : tolerance_(tolerance) {}

  /// Whether a point would be the best so far.
  bool improved_by(double value, double violation) const;
  /// Takes the point if it is the best so far; returns whether it is.
  bool offer(const Eigen::VectorXd& x, double value, double violation);

  /// A closer look at an iterate than at a trial has come to `value` for `told`. Where it is higher by more
  /// than `surprise`, former values may be as wrong: what was offered until then does not count.
  void looked_again(double told, double value);

  bool any() const { return any_; }
  const Eigen::VectorXd& x() const { return x_; }
  double value() const { return value_; }
  double violation() const { return violation_; }
  bool feasible() const { return any_ && violation_ <= tolerance_; }

  /// The result of a run that ends here. A run that stalled at a point that violates the constraints is
  /// "infeasible", and the message says by how much they are violated. Without any point: `start`, `value`.
  OptimizerResult result(std::string status, std::string message, const Eigen::VectorXd& start,
                         double value) const;

 private:
  double tolerance_;
  bool any_ = false;
  Eigen::VectorXd x_;
  double value_ = 0.0;
  double violation_ = 0.0;
};

}  // namespace hauberk
