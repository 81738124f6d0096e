#pragma once
/// A walk in the form in which Ipopt asks for values.

#include "ipopt_optimizer.hpp"

#include <IpTNLP.hpp>

#include <limits>

namespace hauberk {

/// min f(z)/unit subject to the bounds of the scaled variables z and c(z) >= -tolerance/2, of equations = 0:
/// without that little room, an equation given as two inequalities would leave no interior.
///
/// Ipopt's functions may say that a point cannot be evaluated; that is the answer where it cannot be reached,
/// and Ipopt shortens its step. Derivatives are asked for at Ipopt's own iterates alone (soft restoration and
/// the watchdog are switched off), so the point where one is asked for becomes the accepted one. When the
/// walk is stopped they throw `Stopped`, which Ipopt lets through, as it does exceptions of the problem.
class IpoptNlp final : public Ipopt::TNLP {
 public:
  struct Stopped {};

  /// `exact`: the problem knows its Hessian.
  IpoptNlp(Walk& walk, Eigen::VectorXd start, const IpoptSettings& settings, bool exact);

  /// An iterate turned out to have another value than Ipopt was told, so its line search compares with what
  /// is not so.
  bool surprised() const { return surprised_; }
  /// The Hessian was asked for and not known.
  bool lost_hessian() const { return lost_hessian_; }

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& jacobian_entries,
                    Ipopt::Index& hessian_entries, IndexStyleEnum& style) override;
  bool get_bounds_info(Ipopt::Index n, double* z_lower, double* z_upper, Ipopt::Index m, double* c_lower,
                       double* c_upper) override;
  bool get_starting_point(Ipopt::Index n, bool want_z, double* z, bool want_bound_multipliers, double* z_l,
                          double* z_u, Ipopt::Index m, bool want_multipliers, double* lambda) override;
  bool eval_f(Ipopt::Index n, const double* z, bool is_new, double& value) override;
  bool eval_grad_f(Ipopt::Index n, const double* z, bool is_new, double* gradient) override;
  bool eval_g(Ipopt::Index n, const double* z, bool is_new, Ipopt::Index m, double* c) override;
  bool eval_jac_g(Ipopt::Index n, const double* z, bool is_new, Ipopt::Index m, Ipopt::Index entries,
                  Ipopt::Index* row, Ipopt::Index* column, double* values) override;
  bool eval_h(Ipopt::Index n, const double* z, bool is_new, double weight, Ipopt::Index m,
              const double* lambda, bool is_new_lambda, Ipopt::Index entries, Ipopt::Index* row,
              Ipopt::Index* column, double* values) override;
  bool intermediate_callback(Ipopt::AlgorithmMode mode, Ipopt::Index iteration, double value,
                             double violation, double dual_violation, double mu, double step,
                             double regularization, double alpha_dual, double alpha_primal,
                             Ipopt::Index trials, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override;
  /// Nothing: the walk knows its best point.
  void finalize_solution(Ipopt::SolverReturn status, Ipopt::Index n, const double* z, const double* z_l,
                         const double* z_u, Ipopt::Index m, const double* c, const double* lambda,
                         double value, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities* quantities) override;

 private:
  const Walk::Place& look(const double* z);
  bool arrive(const double* z);
  /// Whether the best point is better than when this was last true.
  bool gained();

  Walk& walk_;
  Eigen::VectorXd start_;  ///< scaled
  IpoptSettings settings_;
  bool exact_;
  bool surprised_ = false;
  bool lost_hessian_ = false;
  Eigen::VectorXd seen_;  ///< scaled accepted point at the last callback
  int idle_ = 0;          ///< callbacks since it moved by a step worth an evaluation
  int stalled_ = 0;       ///< callbacks since it gained
  double value_ = std::numeric_limits<double>::infinity();
  double violation_ = std::numeric_limits<double>::infinity();
};

}  // namespace hauberk
