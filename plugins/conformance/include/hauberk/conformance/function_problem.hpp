#pragma once
/// A problem given by functions, which records how an optimizer uses it.

#include <hauberk/optimizer.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hauberk::conformance {

using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A problem made of functions. Checks the protocol: evaluations stay within bounds and within the safe part
/// of a direction asked for at the accepted point, and only points that were evaluated last, alone or in a
/// batch, are accepted.
class FunctionProblem : public OptimizationProblem {
 public:
  std::vector<double> lower_bounds, upper_bounds;
  std::function<double(const VectorXd&, VectorXd&)> objective;  ///< value; fills the gradient
  int constraint_number = 0, equality_number = 0;
  std::function<void(const VectorXd&, VectorXd&, RowMajor&)> constraint_functions;
  int residual_number = 0;  ///< 0: the objective is not given as a sum of squares
  std::function<void(const VectorXd&, VectorXd&, RowMajor&)> residual_functions;
  /// Hessian of weight f - multipliers . c; null: not known. The optimizer sees it only if it is offered.
  std::function<Eigen::MatrixXd(const VectorXd& x, double weight, const VectorXd& multipliers)>
      hessian_function;
  bool hessian_offered = false;
  bool backwards = false;  ///< points of a batch are evaluated from its end
  std::uint64_t stream_number = 0;
  std::function<double(const VectorXd&, const VectorXd&)> safe = [](const auto&, const auto&) { return 1.0; };
  std::function<bool(const VectorXd&)> fails = [](const auto&) { return false; };

  std::vector<VectorXd> evaluated, accepted;
  int gradients = 0;   ///< evaluations that asked for one
  int products = 0;    ///< of the Hessian
  int batches = 0;     ///< of more than one point
  std::string breach;  ///< the first call that broke the protocol, a sentence; empty: none

  std::span<const double> lower() const override { return lower_bounds; }
  std::span<const double> upper() const override { return upper_bounds; }
  int constraint_count() const override { return constraint_number; }
  int equality_count() const override { return equality_number; }
  int residual_count() const override { return residual_number; }
  std::uint64_t stream() const override { return stream_number; }
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override;
  std::vector<Evaluation> evaluate_batch(std::size_t count, std::span<const double> points,
                                         bool want_gradient) override;
  bool hessian_product(std::span<const double> x, double weight, std::span<const double> multipliers,
                       std::span<const double> v, std::span<double> out) override;
  void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) override;
  bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) override;
  double largest_safe_step(std::span<const double> x, std::span<const double> d) override;
  void accept(std::span<const double> x) override;

 private:
  struct Direction {
    VectorXd d;
    double alpha;
  };

  void check_evaluation(const VectorXd& v);
  void breaks(bool broken, const std::string& what);
  bool allowed(const VectorXd& v) const;
  /// v is one of the points evaluated last.
  bool is_latest(const VectorXd& v) const;

  std::vector<Direction> directions;
  std::vector<VectorXd> latest;  ///< the points evaluated last
  bool just_accepted = false;
};

/// Records iterates; stops after `limit` of them.
class Recorder : public OptimizerObserver {
 public:
  std::vector<OptimizerIterate> iterates;  // x is not kept: it points into the optimizer
  int limit = 1 << 30;

  bool on_iterate(const OptimizerIterate& iterate) override
  {
    iterates.push_back(iterate);
    iterates.back().x = {};
    return static_cast<int>(iterates.size()) < limit;
  }
};

}  // namespace hauberk::conformance
