#pragma once
/// A walk in the form in which pagmo asks for values.

#include <common/walk.hpp>

#include <pagmo/problem.hpp>
#include <pagmo/types.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// The free variables, scaled, within their bounds; one number for each of their points, by which they are
/// in the order of Deb's rules (Comput. Methods Appl. Mech. Eng. 186 (2000) 311): points that satisfy the
/// constraints by their value, behind them others by their violation, and last those that cannot be reached
/// or evaluated. Only the order has a meaning, and the methods that use it see no more.
///
/// A point that is the best so far becomes the accepted one: the next points are reached from there. When the
/// walk is stopped, `Stopped` is thrown, which pagmo lets through, as it does exceptions of the problem.
class Candidates {
 public:
  struct Stopped {};
  /// Every violation is behind this, every point that cannot be reached at `unreachable`. Values are beyond
  /// it nowhere where an objective has a use.
  static constexpr double infeasible = 1e100;
  static constexpr double unreachable = 1e250;

  /// pagmo asks for one; it must not be asked anything.
  Candidates() = default;
  explicit Candidates(Walk& walk);

  /// Number of free variables.
  std::size_t size() const { return free_.size(); }
  /// The accepted point.
  pagmo::vector_double position() const;
  /// What `fitness` gives of points that are all reached from the accepted one, evaluated as a batch; the
  /// best of them, if it is the best so far, is accepted when all are known.
  std::vector<double> fitness_of(const std::vector<pagmo::vector_double>& points) const;

  // What pagmo asks for.
  pagmo::vector_double fitness(const pagmo::vector_double& z) const;
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const { return {lower_, upper_}; }
  std::string get_name() const { return "candidates"; }
  pagmo::thread_safety get_thread_safety() const { return pagmo::thread_safety::none; }

 private:
  Eigen::VectorXd point(const pagmo::vector_double& z) const;
  /// Its number where that is known without an evaluation.
  std::optional<double> ruled_out(const Eigen::VectorXd& x) const;
  /// The number of a place that was looked at.
  double rank(const Walk::Place& place) const;

  Walk* walk_ = nullptr;
  std::vector<Eigen::Index> free_;
  pagmo::vector_double lower_, upper_;
};

}  // namespace hauberk
