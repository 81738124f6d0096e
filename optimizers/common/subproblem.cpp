#include "subproblem.hpp"

#include "numerics/quadratic_program.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Status = QuadraticSolution::Status;

/// Slacks are priced up at most this often, tenfold each time.
constexpr int penalty_raises = 8;
/// A tenfold price that lowers the violation by less than this part does not help any more.
constexpr double worthwhile = 1e-2;
/// Curvature given to slacks, which the QP method needs, relative to price per violation: small beside
/// either.
constexpr double slack_curvature = 1e-6;

/// The program with `slacks` further variables, one for each constraint of `violated`, priced at `price`.
QuadraticProgram assemble(const MatrixXd& B, const Linearisation& at, const VectorXd& lower,
                          const VectorXd& upper, const std::vector<Index>& violated, double price)
{
  const Index n = B.rows();
  const Index m = at.c.size();
  const auto slacks = static_cast<Index>(violated.size());
  QuadraticProgram q;
  q.G = MatrixXd::Zero(n + slacks, n + slacks);
  q.G.topLeftCorner(n, n) = B;
  q.a = VectorXd::Constant(n + slacks, price);
  q.a.head(n) = at.gradient;
  q.equalities = at.equalities;
  q.A = MatrixXd::Zero(m + 2 * n + slacks, n + slacks);
  q.b = VectorXd::Zero(m + 2 * n + slacks);
  q.A.topLeftCorner(m, n) = at.J;
  q.b.head(m) = -at.c;
  q.A.block(m, 0, n, n).setIdentity();
  q.b.segment(m, n) = lower;
  q.A.block(m + n, 0, n, n) = -MatrixXd::Identity(n, n);
  q.b.segment(m + n, n) = -upper;
  for (Index k = 0; k < slacks; ++k) {
    const Index i = violated[k];
    q.G(n + k, n + k) = slack_curvature * price / std::abs(at.c[i]);
    q.A(i, n + k) = at.c[i] < 0.0 ? 1.0 : -1.0;
    q.A(m + 2 * n + k, n + k) = 1.0;
  }
  return q;
}

}  // namespace

Step propose_step(const MatrixXd& B, const Linearisation& at, const VectorXd& lower, const VectorXd& upper,
                  double penalty)
{
  const Index n = B.rows();
  const Index m = at.c.size();
  Step step;
  const auto take = [&](const QuadraticSolution& solution) {
    step.ok = true;
    step.d = solution.x.head(n).cwiseMax(lower).cwiseMin(upper);
    step.multipliers = solution.multipliers.head(m);
    step.model_violation = total_violation(at.c + at.J * step.d, at.equalities);
    step.gradient = at.gradient;
    step.descent = -at.gradient.dot(step.d);
    step.decrease = step.descent - 0.5 * step.d.dot(B * step.d);
  };
  const QuadraticSolution hard = solve(assemble(B, at, lower, upper, {}, 0.0));
  if (hard.status == Status::solved) {
    take(hard);
    return step;
  }

  std::vector<Index> violated;
  double steepest = 0.0;
  for (Index i = 0; i < m; ++i) {
    if (i < at.equalities ? at.c[i] == 0.0 : at.c[i] >= 0.0) continue;
    violated.push_back(i);
    steepest = std::max(steepest, at.J.row(i).cwiseAbs().maxCoeff());
  }
  if (violated.empty()) return step;  // d = 0 is feasible, so the method itself failed
  step.elastic = true;
  double price = 2.0 * penalty;
  // Below the gradient per constraint gradient, slack is cheaper than any step.
  if (steepest > 0.0) price = std::max(price, 2.0 * at.gradient.cwiseAbs().maxCoeff() / steepest);
  if (!(price > 0.0)) price = 1.0;
  for (int raise = 0; raise <= penalty_raises; ++raise, price *= 10.0) {
    const QuadraticSolution soft = solve(assemble(B, at, lower, upper, violated, price));
    if (soft.status != Status::solved) break;
    const double before = step.ok ? step.model_violation : 0.0;
    const bool first = !step.ok;
    take(soft);
    if (!first && step.model_violation >= (1.0 - worthwhile) * before) break;
  }
  return step;
}

}  // namespace hauberk
