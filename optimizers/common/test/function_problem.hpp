#pragma once
/// A problem given by functions, which records how an optimizer uses it.

#include <hauberk/optimizer.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace hauberk::testing_problems {

using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A problem made of functions. Checks the protocol: evaluations stay within bounds and within the safe part
/// of a direction asked for at the accepted point, and only evaluated points are accepted.
class FunctionProblem : public OptimizationProblem {
 public:
  std::vector<double> lower_bounds, upper_bounds;
  std::function<double(const VectorXd&, VectorXd&)> objective;  ///< value; fills the gradient
  int constraint_number = 0;
  std::function<void(const VectorXd&, VectorXd&, RowMajor&)> constraint_functions;
  int residual_number = 0;  ///< 0: the objective is not given as a sum of squares
  std::function<void(const VectorXd&, VectorXd&, RowMajor&)> residual_functions;
  std::function<double(const VectorXd&, const VectorXd&)> safe = [](const auto&, const auto&) { return 1.0; };
  std::function<bool(const VectorXd&)> fails = [](const auto&) { return false; };

  std::vector<VectorXd> evaluated, accepted;
  int gradients = 0;  ///< evaluations that asked for one
  int broken_protocol = 0;

  std::span<const double> lower() const override { return lower_bounds; }
  std::span<const double> upper() const override { return upper_bounds; }
  int constraint_count() const override { return constraint_number; }

  Evaluation evaluate(std::span<const double> x, bool want_gradient) override
  {
    const VectorXd v = vector(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] < lower_bounds[i] || x[i] > upper_bounds[i]) ++broken_protocol;
    }
    if (!accepted.empty() && !allowed(v)) ++broken_protocol;
    // What became of an iterate when it was accepted costs nothing to ask.
    const bool known = std::exchange(just_accepted, false) && v == accepted.back();
    if (!known) evaluated.push_back(v);
    Evaluation e;
    if (want_gradient && !known) ++gradients;
    if (fails(v)) {
      e.why = "told to fail";
      return e;
    }
    VectorXd gradient(v.size());
    e.value = objective(v, gradient);
    e.ok = true;
    if (want_gradient) e.gradient.assign(gradient.begin(), gradient.end());
    return e;
  }

  void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) override
  {
    const VectorXd v = vector(x);
    VectorXd values(constraint_number);
    RowMajor J(constraint_number, v.size());
    constraint_functions(v, values, J);
    std::copy(values.begin(), values.end(), c.begin());
    if (!jacobian.empty()) std::copy(J.data(), J.data() + J.size(), jacobian.begin());
  }

  int residual_count() const override { return residual_number; }
  bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) override
  {
    const VectorXd v = vector(x);
    if (evaluated.empty() || v != evaluated.back()) ++broken_protocol;
    VectorXd values(residual_number);
    RowMajor J(residual_number, v.size());
    residual_functions(v, values, J);
    std::copy(values.begin(), values.end(), r.begin());
    std::copy(J.data(), J.data() + J.size(), jacobian.begin());
    return true;
  }

  double largest_safe_step(std::span<const double> x, std::span<const double> d) override
  {
    if (accepted.empty() || vector(x) != accepted.back()) ++broken_protocol;
    directions.push_back({vector(d), safe(vector(x), vector(d))});
    return directions.back().alpha;
  }

  void accept(std::span<const double> x) override
  {
    if (evaluated.empty() || vector(x) != evaluated.back()) ++broken_protocol;
    accepted.push_back(vector(x));
    just_accepted = true;
    directions.clear();
  }

 private:
  struct Direction {
    VectorXd d;
    double alpha;
  };

  static VectorXd vector(std::span<const double> x)
  {
    return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  }

  /// v is on the safe part of one of the directions asked for, or was accepted before.
  bool allowed(const VectorXd& v) const
  {
    if (std::find(accepted.begin(), accepted.end(), v) != accepted.end()) return true;
    return std::any_of(directions.begin(), directions.end(), [&](const Direction& at) {
      const VectorXd moved = v - accepted.back();
      const double alpha = moved.dot(at.d) / at.d.squaredNorm();
      const double rounding = 1e-14 * (1.0 + v.norm());
      return (alpha - at.alpha) * at.d.norm() <= rounding && (moved - alpha * at.d).norm() <= rounding;
    });
  }

  std::vector<Direction> directions;
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

}  // namespace hauberk::testing_problems
