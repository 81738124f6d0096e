#include "nlp.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

using Eigen::VectorXd;
using Ipopt::Index;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What Ipopt takes for infinite is larger than 1e19.
constexpr double unbounded = 2e19;
/// Iterates in a row that hardly move end a run. Where no step can be evaluated Ipopt would shorten
/// one to nothing, accept that, and go on for ever.
constexpr int most_idle = 2;
/// So do iterates none of which is better than the best so far by more than the tolerance: at a kink the
/// Hessian grows and steps shrink without an end.
constexpr int most_stalled = 40;
/// A violation that is smaller by less than this part is none to speak of.
constexpr double worthwhile = 0.99;

}  // namespace

IpoptNlp::IpoptNlp(Walk& walk, VectorXd start, const IpoptSettings& settings, bool exact)
    : walk_(walk), start_(std::move(start)), settings_(settings), exact_(exact)
{
}

bool IpoptNlp::get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                            IndexStyleEnum& style)
{
  n = static_cast<Index>(walk_.problem().size());
  m = walk_.problem().constraint_count();
  jacobian_entries = n * m;
  hessian_entries = exact_ ? n * (n + 1) / 2 : 0;
  style = C_STYLE;
  return true;
}

bool IpoptNlp::get_bounds_info(Index n, double* z_lower, double* z_upper, Index m, double* c_lower,
                               double* c_upper)
{
  const ScaledProblem& problem = walk_.problem();
  Eigen::Map<VectorXd>(z_lower, n) = problem.scaled(problem.lower()).cwiseMax(-unbounded);
  Eigen::Map<VectorXd>(z_upper, n) = problem.scaled(problem.upper()).cwiseMin(unbounded);
  std::fill(c_lower, c_lower + m, -0.5 * settings_.walk.constraint_tolerance);
  std::fill(c_upper, c_upper + m, unbounded);
  const int equations = problem.equality_count();
  std::fill(c_lower, c_lower + equations, 0.0);
  std::fill(c_upper, c_upper + equations, 0.0);
  return true;
}

bool IpoptNlp::get_starting_point(Index n, bool /*want_z*/, double* z, bool /*want_bound_multipliers*/,
                                  double* /*z_l*/, double* /*z_u*/, Index /*m*/, bool /*want_multipliers*/,
                                  double* /*lambda*/)
{
  Eigen::Map<VectorXd>(z, n) = start_;
  return true;
}

const Walk::Place& IpoptNlp::look(const double* z)
{
  const Eigen::Map<const VectorXd> scaled(z, walk_.problem().size());
  const VectorXd x = scaled.allFinite() ? walk_.problem().unscaled(scaled) : VectorXd(scaled);
  const Walk::Place& place = walk_.look(x, true);
  if (walk_.stopped() != Walk::Stop::none) throw Stopped();
  return place;
}

bool IpoptNlp::arrive(const double* z)
{
  const Walk::Place& place = look(z);
  if (!place.ok) return false;
  if (place.x == walk_.accepted().x) return true;
  const double told = place.value;
  walk_.accept_last();
  if (walk_.stopped() != Walk::Stop::none) throw Stopped();
  surprised_ |= std::abs(walk_.accepted().value - told) > surprise * std::abs(told);
  return true;
}

bool IpoptNlp::eval_f(Index /*n*/, const double* z, bool /*is_new*/, double& value)
{
  const Walk::Place& place = look(z);
  value = place.value / walk_.unit();
  return place.ok;
}

bool IpoptNlp::eval_grad_f(Index n, const double* z, bool /*is_new*/, double* gradient)
{
  if (!arrive(z)) return false;
  Eigen::Map<VectorXd>(gradient, n) = walk_.accepted().at.gradient / walk_.unit();
  return true;
}

bool IpoptNlp::eval_g(Index /*n*/, const double* z, bool /*is_new*/, Index m, double* c)
{
  const Walk::Place& place = look(z);
  if (place.ok) Eigen::Map<VectorXd>(c, m) = place.at.c;
  return place.ok;
}

bool IpoptNlp::eval_jac_g(Index n, const double* z, bool /*is_new*/, Index m, Index /*entries*/, Index* row,
                          Index* column, double* values)
{
  if (values == nullptr) {
    for (Index entry = 0; entry < m * n; ++entry) {
      row[entry] = entry / n;
      column[entry] = entry % n;
    }
    return true;
  }
  if (!arrive(z)) return false;
  Eigen::Map<RowMajor>(values, m, n) = walk_.accepted().at.J;
  return true;
}

bool IpoptNlp::eval_h(Index n, const double* z, bool /*is_new*/, double weight, Index m, const double* lambda,
                      bool /*is_new_lambda*/, Index /*entries*/, Index* row, Index* column, double* values)
{
  if (values == nullptr) {
    Index entry = 0;
    for (Index i = 0; i < n; ++i) {
      for (Index k = 0; k <= i; ++k, ++entry) {
        row[entry] = i;
        column[entry] = k;
      }
    }
    return true;
  }
  if (!arrive(z)) return false;
  // Ipopt's Lagrangian is f + lambda . c, and its f is over the unit.
  Eigen::MatrixXd H;
  if (!walk_.hessian(weight / walk_.unit(), -Eigen::Map<const VectorXd>(lambda, m), H)) {
    lost_hessian_ = true;
    return false;
  }
  Index entry = 0;
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k <= i; ++k) values[entry++] = 0.5 * (H(i, k) + H(k, i));
  }
  return true;
}

bool IpoptNlp::intermediate_callback(Ipopt::AlgorithmMode /*mode*/, Index /*iteration*/, double /*value*/,
                                     double /*violation*/, double /*dual_violation*/, double /*mu*/,
                                     double /*step*/, double /*regularization*/, double /*alpha_dual*/,
                                     double /*alpha_primal*/, Index /*trials*/,
                                     const Ipopt::IpoptData* /*data*/,
                                     Ipopt::IpoptCalculatedQuantities* /*quantities*/)
{
  const VectorXd z = walk_.problem().scaled(walk_.accepted().x);
  const bool moved = seen_.size() == 0 || (z - seen_).cwiseAbs().maxCoeff() >= settings_.min_step;
  idle_ = moved ? 0 : idle_ + 1;
  seen_ = z;
  stalled_ = gained() ? 0 : stalled_ + 1;
  return !surprised_ && idle_ < most_idle && stalled_ < most_stalled;
}

bool IpoptNlp::gained()
{
  const BestPoint& best = walk_.best();
  const double violation = best.feasible() ? 0.0 : best.violation();
  const bool nearer = violation < worthwhile * violation_;
  const bool lower =
      violation <= violation_ && best.value() < value_ - settings_.walk.tolerance * walk_.unit();
  if (!nearer && !lower) return false;
  violation_ = violation;
  value_ = best.value();
  return true;
}

void IpoptNlp::finalize_solution(Ipopt::SolverReturn /*status*/, Index /*n*/, const double* /*z*/,
                                 const double* /*z_l*/, const double* /*z_u*/, Index /*m*/,
                                 const double* /*c*/, const double* /*lambda*/, double /*value*/,
                                 const Ipopt::IpoptData* /*data*/,
                                 Ipopt::IpoptCalculatedQuantities* /*quantities*/)
{
}

}  // namespace hauberk
