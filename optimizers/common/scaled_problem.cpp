#include "scaled_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

VectorXd copy(std::span<const double> x)
{
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size()));
}

std::span<const double> view(const VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }

}  // namespace

ScaledProblem::ScaledProblem(OptimizationProblem& problem, std::span<const double> start)
    : problem_(problem), lower_(copy(problem.lower())), upper_(copy(problem.upper())), scale_(upper_ - lower_)
{
  for (Index i = 0; i < scale_.size(); ++i) {
    if (std::isfinite(scale_[i]) && scale_[i] > 0.0) continue;
    scale_[i] = std::max(1.0, std::abs(start[i]));
  }
}

VectorXd ScaledProblem::moved(const VectorXd& x, const VectorXd& d, double alpha) const
{
  return (x + alpha * scale_.cwiseProduct(d)).cwiseMax(lower_).cwiseMin(upper_);
}

Trial ScaledProblem::checked(OptimizationProblem::Evaluation evaluation, bool want_gradient) const
{
  Trial trial;
  trial.value = evaluation.value;
  trial.why = std::move(evaluation.why);
  if (!evaluation.ok) return trial;
  trial.ok = std::isfinite(trial.value);
  if (!trial.ok) trial.why = "the value or its gradient is not finite";
  if (!want_gradient || !trial.ok) return trial;
  trial.ok = false;
  if (evaluation.gradient.size() != static_cast<std::size_t>(size())) {
    trial.why = "the gradient has " + std::to_string(evaluation.gradient.size()) + " components";
    return trial;
  }
  trial.gradient = copy(evaluation.gradient).cwiseProduct(scale_);
  trial.ok = trial.gradient.allFinite();
  if (!trial.ok) trial.why = "the value or its gradient is not finite";
  return trial;
}

Trial ScaledProblem::evaluate(const VectorXd& x, bool want_gradient)
{
  ++evaluations_;
  return checked(problem_.evaluate(view(x), want_gradient), want_gradient);
}

std::vector<Trial> ScaledProblem::evaluate(const std::vector<VectorXd>& points, bool want_gradient)
{
  std::vector<double> rows;
  for (const VectorXd& x : points) rows.insert(rows.end(), x.begin(), x.end());
  evaluations_ += static_cast<int>(points.size());
  std::vector<Trial> trials;
  for (OptimizationProblem::Evaluation& e : problem_.evaluate_batch(points.size(), rows, want_gradient))
    trials.push_back(checked(std::move(e), want_gradient));
  return trials;
}

VectorXd ScaledProblem::constraints(const VectorXd& x)
{
  VectorXd c(problem_.constraint_count());
  if (c.size() > 0) problem_.constraints(view(x), {c.data(), static_cast<std::size_t>(c.size())}, {});
  return c;
}

void ScaledProblem::linearise(const VectorXd& x, Linearisation& at)
{
  at.c.resize(problem_.constraint_count());
  at.equalities = problem_.equality_count();
  RowMajor J(at.c.size(), x.size());
  if (at.c.size() > 0) {
    problem_.constraints(view(x), {at.c.data(), static_cast<std::size_t>(at.c.size())},
                         {J.data(), static_cast<std::size_t>(J.size())});
  }
  at.J = J * scale_.asDiagonal();
}

Trial ScaledProblem::begin(const VectorXd& start, Linearisation& at, bool want_gradient)
{
  Trial trial = evaluate(start, want_gradient);
  if (!trial.ok) return trial;
  trial = accept(start, trial);
  at.gradient = trial.gradient;
  linearise(start, at);
  if (!at.c.allFinite() || !at.J.allFinite()) {
    trial.ok = false;
    trial.why = "the constraints or their derivatives are not finite";
  }
  return trial;
}

Residuals ScaledProblem::residuals(const VectorXd& x)
{
  Residuals out;
  const int count = problem_.residual_count();
  if (count <= 0) return out;
  VectorXd r(count);
  RowMajor J(count, x.size());
  if (!problem_.residuals(view(x), {r.data(), static_cast<std::size_t>(r.size())},
                          {J.data(), static_cast<std::size_t>(J.size())}))
    return out;
  if (!r.allFinite() || !J.allFinite()) return out;
  out.r = std::move(r);
  out.J = J * scale_.asDiagonal();
  return out;
}

bool ScaledProblem::hessian(const VectorXd& x, double weight, const VectorXd& multipliers, MatrixXd& H)
{
  H.resize(size(), size());
  VectorXd out(size());
  for (Index k = 0; k < size(); ++k) {
    const VectorXd v = scale_[k] * VectorXd::Unit(size(), k);
    if (!problem_.hessian_product(view(x), weight, view(multipliers), view(v),
                                  {out.data(), static_cast<std::size_t>(out.size())}) ||
        !out.allFinite())
      return false;
    H.col(k) = scale_.cwiseProduct(out);
  }
  return true;
}

double ScaledProblem::largest_safe_step(const VectorXd& x, const VectorXd& d)
{
  const VectorXd unscaled = scale_.cwiseProduct(d);
  const double alpha = problem_.largest_safe_step(view(x), view(unscaled));
  return alpha > 0.0 ? std::min(alpha, 1.0) : 0.0;  // not-a-number: nothing is safe
}

Trial ScaledProblem::accept(const VectorXd& x, const Trial& trial)
{
  problem_.accept(view(x));
  const Trial closer = evaluate(x, trial.gradient.size() > 0);
  --evaluations_;  // the problem knows its iterate
  return closer.ok ? closer : trial;
}

}  // namespace hauberk
