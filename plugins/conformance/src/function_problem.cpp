#include <hauberk/conformance/function_problem.hpp>

#include "as_vector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hauberk::conformance {
namespace {

/// Calls `functions` at v and hands out what was asked for.
void fill(const std::function<void(const VectorXd&, VectorXd&, RowMajor&)>& functions, int count,
          const VectorXd& v, std::span<double> values, std::span<double> jacobian)
{
  VectorXd c(count);
  RowMajor J(count, v.size());
  functions(v, c, J);
  if (!values.empty()) std::copy(c.begin(), c.end(), values.begin());
  if (!jacobian.empty()) std::copy(J.data(), J.data() + J.size(), jacobian.begin());
}

}  // namespace

void FunctionProblem::breaks(bool broken, const std::string& what)
{
  if (broken && breach.empty()) breach = fmt::format("{} (evaluation {})", what, evaluated.size() + 1);
}

/// v is on the safe part of one of the directions asked for, or was accepted before.
bool FunctionProblem::allowed(const VectorXd& v) const
{
  if (std::find(accepted.begin(), accepted.end(), v) != accepted.end()) return true;
  return std::any_of(directions.begin(), directions.end(), [&](const Direction& at) {
    const VectorXd moved = v - accepted.back();
    const double alpha = moved.dot(at.d) / at.d.squaredNorm();
    const double rounding = 1e-14 * (1.0 + v.norm());
    return (alpha - at.alpha) * at.d.norm() <= rounding && (moved - alpha * at.d).norm() <= rounding;
  });
}

void FunctionProblem::check_evaluation(const VectorXd& v)
{
  for (std::size_t i = 0; i < lower_bounds.size(); ++i) {
    const double x = v[i];
    breaks(!(x >= lower_bounds[i] && x <= upper_bounds[i]),
           fmt::format("it evaluated x[{}] = {} outside its bounds [{}, {}]", i, x, lower_bounds[i],
                       upper_bounds[i]));
  }
  breaks(!accepted.empty() && !allowed(v),
         "it evaluated a point that is not on the safe part of a direction asked for at the accepted point");
}

OptimizationProblem::Evaluation FunctionProblem::evaluate(std::span<const double> x, bool want_gradient)
{
  const VectorXd v = as_vector(x);
  check_evaluation(v);
  // What became of an iterate when it was accepted costs nothing to ask.
  const bool known = std::exchange(just_accepted, false) && v == accepted.back();
  if (!known) evaluated.push_back(v);
  latest = {v};
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

std::vector<OptimizationProblem::Evaluation> FunctionProblem::evaluate_batch(std::size_t count,
                                                                             std::span<const double> points,
                                                                             bool want_gradient)
{
  check_batch(count, points);
  const std::size_t n = lower_bounds.size();
  if (count > 1) ++batches;
  just_accepted = false;  // each point of a batch counts
  std::vector<Evaluation> found(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = backwards ? count - 1 - k : k;
    found[i] = evaluate(points.subspan(i * n, n), want_gradient);
  }
  latest.clear();
  for (std::size_t i = 0; i < count; ++i) latest.push_back(as_vector(points.subspan(i * n, n)));
  return found;
}

bool FunctionProblem::hessian_product(std::span<const double> x, double weight,
                                      std::span<const double> multipliers, std::span<const double> v,
                                      std::span<double> out)
{
  breaks(accepted.empty() || as_vector(x) != accepted.back(),
         "it asked for a product of the Hessian at another point than the accepted one");
  breaks(multipliers.size() != static_cast<std::size_t>(constraint_number) || v.size() != x.size() ||
             out.size() != x.size(),
         "it asked for a product of the Hessian with spans of other sizes");
  if (!hessian_offered || !hessian_function || !breach.empty()) return false;
  ++products;
  const VectorXd product = hessian_function(as_vector(x), weight, as_vector(multipliers)) * as_vector(v);
  std::copy(product.begin(), product.end(), out.begin());
  return true;
}

bool FunctionProblem::is_latest(const VectorXd& v) const
{
  return std::find(latest.begin(), latest.end(), v) != latest.end();
}

void FunctionProblem::constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian)
{
  if (constraint_number > 0) fill(constraint_functions, constraint_number, as_vector(x), c, jacobian);
}

bool FunctionProblem::residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian)
{
  breaks(latest.size() != 1 || !is_latest(as_vector(x)),
         "it asked for residuals at another point than the one evaluated last");
  breaks(r.empty() || jacobian.empty(), "it asked for residuals or their Jacobian with an empty span");
  fill(residual_functions, residual_number, as_vector(x), r, jacobian);
  return true;
}

double FunctionProblem::largest_safe_step(std::span<const double> x, std::span<const double> d)
{
  breaks(accepted.empty() || as_vector(x) != accepted.back(),
         "it asked for the largest safe step from another point than the accepted one");
  directions.push_back({as_vector(d), safe(as_vector(x), as_vector(d))});
  return directions.back().alpha;
}

void FunctionProblem::accept(std::span<const double> x)
{
  breaks(!is_latest(as_vector(x)), "it accepted another point than was evaluated last");
  accepted.push_back(as_vector(x));
  just_accepted = true;
  directions.clear();
}

}  // namespace hauberk::conformance
