#include "bundle.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Points kept, and how far from the iterate (largest scaled component): residuals curve, cuts do not.
constexpr std::size_t most_cuts = 24;
constexpr double range = 0.3;
/// A cut matters when it lifts the model at its own point by this part of the residual.
constexpr double noticeable = 1e-3;
/// Bounds of |r| in the program, relative to the residuals: never active.
constexpr double wide = 1e3;

}  // namespace

void Bundle::keep(Cut cut)
{
  if (cuts_.size() == most_cuts) cuts_.erase(cuts_.begin());
  cuts_.push_back(std::move(cut));
}

void Bundle::move(const VectorXd& x, Residuals at)
{
  if (at_.r.size() != at.r.size()) cuts_.clear();
  if (!empty() && at_.r.size() == at.r.size()) keep({x_, std::move(at_)});
  x_ = x;
  at_ = std::move(at);
}

bool Bundle::add(const VectorXd& x, Residuals at)
{
  if (at.r.size() != at_.r.size()) return false;
  const VectorXd d = x - x_;
  const auto model = [&](const std::vector<Piece>& list) {
    VectorXd value(at_.r.size());
    for (Index i = 0; i < value.size(); ++i) value[i] = std::abs(at_.r[i] + at_.J.row(i).dot(d));
    for (const Piece& p : list) value[p.residual] = std::max(value[p.residual], p.value + p.gradient.dot(d));
    return value;
  };
  const VectorXd before = model(pieces());
  keep({x, std::move(at)});
  const VectorXd after = model(pieces());
  return ((after - before).array() > noticeable * at_.r.cwiseAbs().array()).any();
}

void Bundle::clear()
{
  cuts_.clear();
  at_ = {};
}

double Bundle::curvature() const
{
  const double largest = at_.J.colwise().squaredNorm().maxCoeff();
  return std::max(largest, std::numeric_limits<double>::min());
}

std::vector<Bundle::Piece> Bundle::pieces() const
{
  std::vector<Piece> out;
  for (const Cut& cut : cuts_) {
    const VectorXd back = x_ - cut.x;
    if (back.cwiseAbs().maxCoeff() > range) continue;
    for (Index i = 0; i < at_.r.size(); ++i) {
      Piece p;
      p.residual = i;
      p.gradient = sign(i) * cut.at.J.row(i).transpose();
      p.value = sign(i) * cut.at.r[i] + p.gradient.dot(back);
      if (p.value <= std::abs(at_.r[i])) out.push_back(std::move(p));
    }
  }
  return out;
}

Step Bundle::propose(const Linearisation& at, const VectorXd& lower, const VectorXd& upper, double shift,
                     double penalty) const
{
  const Index n = lower.size();
  const Index m = at.c.size();
  const Index residuals = at_.r.size();
  std::vector<Piece> list = pieces();
  std::vector<Index> column(residuals, -1);  // of the residual's own variable
  Index own = 0;
  for (const Piece& p : list) {
    Index& c = column[p.residual];
    if (c < 0) c = own++;
  }
  for (Index i = 0; i < residuals; ++i) {  // the iterate's pieces
    if (column[i] < 0) continue;
    // Both sides: the residual may change its sign within the step.
    const VectorXd gradient = sign(i) * at_.J.row(i).transpose();
    list.push_back({i, std::abs(at_.r[i]), gradient});
    list.push_back({i, -std::abs(at_.r[i]), -gradient});
  }

  // Unknowns (d, w): |r_i(x + d)| is at most |r_i| + w_i.
  const auto rows = static_cast<Index>(list.size());
  MatrixXd B = MatrixXd::Zero(n + own, n + own);
  Linearisation extended;
  extended.gradient = VectorXd::Zero(n + own);
  extended.c = VectorXd::Zero(m + rows);
  extended.J = MatrixXd::Zero(m + rows, n + own);
  extended.equalities = at.equalities;
  extended.c.head(m) = at.c;
  extended.J.topLeftCorner(m, n) = at.J;
  B.diagonal().head(n).setConstant(shift * curvature());
  for (Index i = 0; i < residuals; ++i) {
    const Index c = column[i];
    if (c >= 0) {
      B(n + c, n + c) = 1.0;
      extended.gradient[n + c] = std::abs(at_.r[i]);
    } else {
      B.topLeftCorner(n, n) += at_.J.row(i).transpose() * at_.J.row(i);
      extended.gradient.head(n) += at_.r[i] * at_.J.row(i).transpose();
    }
  }
  for (Index k = 0; k < rows; ++k) {
    const Piece& p = list[k];
    extended.c[m + k] = std::max(0.0, std::abs(at_.r[p.residual]) - p.value);
    extended.J.row(m + k).head(n) = -p.gradient.transpose();
    extended.J(m + k, n + column[p.residual]) = 1.0;
  }
  VectorXd low = VectorXd::Constant(n + own, -wide * (1.0 + at_.r.cwiseAbs().maxCoeff()));
  VectorXd high = -low;
  low.head(n) = lower;
  high.head(n) = upper;
  const Step whole = propose_step(B, extended, low, high, penalty);

  Step step;
  step.ok = whole.ok;
  step.elastic = whole.elastic;
  if (!step.ok) return step;
  step.d = whole.d.head(n);
  step.multipliers = whole.multipliers.head(m);
  step.model_violation = total_violation(at.c + at.J * step.d, at.equalities);
  VectorXd model = (at_.r + at_.J * step.d).cwiseAbs();
  VectorXd weight = VectorXd::Zero(residuals);
  MatrixXd mean = MatrixXd::Zero(residuals, n);  // of |r|'s gradients, weighted by the multipliers
  for (Index i = 0; i < residuals; ++i) {
    if (column[i] >= 0) model[i] = 0.0;
  }
  for (Index k = 0; k < rows; ++k) {
    const Piece& p = list[k];
    model[p.residual] = std::max(model[p.residual], p.value + p.gradient.dot(step.d));
    weight[p.residual] += whole.multipliers[m + k];
    mean.row(p.residual) += whole.multipliers[m + k] * p.gradient.transpose();
  }
  step.decrease = step.descent = 0.5 * (at_.r.squaredNorm() - model.squaredNorm());
  step.gradient = VectorXd::Zero(n);
  for (Index i = 0; i < residuals; ++i) {
    if (weight[i] > 0.0)
      step.gradient += std::abs(at_.r[i]) / weight[i] * mean.row(i).transpose();
    else
      step.gradient += at_.r[i] * at_.J.row(i).transpose();
  }
  return step;
}

}  // namespace hauberk
