#include "adapter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The penalty exceeds the multipliers, for which the merit function is exact, by this factor.
constexpr double penalty_margin = 1.5;
/// So many points in a row that are not evaluated end a run of NLopt: mma and ccsaq would ask for them for
/// ever, as no model explains a wall.
constexpr int most_walls = 100;

}  // namespace

NloptAdapter::NloptAdapter(OptimizationProblem& problem, const NloptSettings& settings,
                           OptimizerObserver& observer, std::span<const double> start)
    : walk_(problem, settings.walk, observer, start), gradients_(settings.algorithm != NloptAlgorithm::cobyla)
{
}

bool NloptAdapter::begin(std::string& why)
{
  if (!walk_.begin(gradients_, why)) return false;
  worst_ = walk_.accepted().value;
  raise_penalty();
  return true;
}

const Walk::Place& NloptAdapter::look(const double* z, bool want_gradient)
{
  const Eigen::Map<const VectorXd> scaled(z, size());
  const VectorXd x = scaled.allFinite() ? walk_.problem().unscaled(scaled) : VectorXd(scaled);
  if (ended() && x != walk_.accepted().x) {
    refused_.x = x;
    return refused_;
  }
  const int before = walk_.problem().evaluations();
  const Walk::Place& place = walk_.look(x, want_gradient);
  walls_ = walk_.problem().evaluations() > before ? 0 : walls_ + 1;
  walled_ = walled_ || walls_ > most_walls;
  if (!place.ok || walls_ > 0) return place;
  worst_ = std::max(worst_, place.value);
  // Without gradients there are no multipliers, and a merit function without a penalty leads off the
  // constraints.
  if (walk_.improved_by(place) || (gradients_ && merit(place) < merit())) {
    walk_.accept_last();
    raise_penalty();
  }
  return place;
}

void NloptAdapter::raise_penalty()
{
  const VectorXd& multipliers = walk_.multipliers();
  if (multipliers.size() > 0)
    penalty_ = std::max(penalty_, penalty_margin * multipliers.cwiseAbs().maxCoeff());
}

double NloptAdapter::objective(const double* z, double* gradient)
{
  const Walk::Place& p = look(z, gradient != nullptr);
  const Index n = size();
  if (p.ok) {
    if (gradient != nullptr) Eigen::Map<VectorXd>(gradient, n) = p.at.gradient / unit();
    return p.value / unit();
  }
  if (gradient != nullptr) {
    VectorXd slope = VectorXd::Zero(n);
    const VectorXd d = walk_.problem().step_between(walk_.accepted().x, p.x);
    if (d.allFinite() && d.squaredNorm() > 0.0) slope = d / d.squaredNorm();
    Eigen::Map<VectorXd>(gradient, n) = slope;
  }
  return worst_ / unit() + 1.0;
}

void NloptAdapter::constraints(const double* z, Index first, Index count, double* values, double* jacobian)
{
  // Objective and constraints are asked one after the other: whoever comes first evaluates.
  const Walk::Place& p = look(z, jacobian != nullptr);
  const Walk::Place& accepted = walk_.accepted();
  VectorXd c = accepted.at.c;
  const MatrixXd* J = &accepted.at.J;
  if (p.ok && p.at.c.size() == c.size()) {
    c = p.at.c;
    J = &p.at.J;
  } else {
    const VectorXd d = walk_.problem().step_between(accepted.x, p.x);
    if (d.allFinite()) c += *J * d;
  }
  Eigen::Map<VectorXd>(values, count) = -c.segment(first, count);
  if (jacobian == nullptr) return;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      jacobian, count, size()) = -J->middleRows(first, count);
}

void NloptAdapter::rethrow() const
{
  if (exception_) std::rethrow_exception(exception_);
}

bool NloptAdapter::leave_walls()
{
  walls_ = 0;
  return std::exchange(walled_, false);
}

void NloptAdapter::restore()
{
  walk_.restore();
  raise_penalty();
}

}  // namespace hauberk
