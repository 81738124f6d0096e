#pragma once
/// Model of half a sum of squares whose residuals have kinks.

#include <Eigen/Core>
#include <common/subproblem.hpp>

#include <vector>

namespace hauberk {

/// Linearisations ("cuts") of residuals at the iterate and at points evaluated near it.
///
/// |r_i| is modelled by the largest of its linearisations s (r_i(x_k) + J_i(x_k) (x + d - x_k)), s the sign
/// of r_i at the iterate, over the iterate itself and those earlier points whose linearisation does not
/// exceed |r_i| there, as one of a convex function cannot. So a kink that was seen from both sides is in the
/// model, and a step along it can be long (a proximal bundle method on each residual: Lemarechal and
/// Sagastizabal, Mathematical Programming 76 (1997) 393-410; of half a sum of squares: Gauss-Newton where
/// there are no cuts).
class Bundle {
 public:
  /// The new iterate; the last one becomes a cut.
  void move(const Eigen::VectorXd& x, Residuals at);
  /// Another point that was evaluated. True when the model at the iterate now differs there noticeably.
  bool add(const Eigen::VectorXd& x, Residuals at);
  /// Forgets all but the iterate.
  void drop_cuts() { cuts_.clear(); }
  void clear();

  bool empty() const { return at_.empty(); }
  /// Minimises the model + 1/2 shift curvature() |d|^2 subject to the linearised constraints and bounds.
  Step propose(const Linearisation& at, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
               double shift, double penalty) const;

 private:
  struct Cut {
    Eigen::VectorXd x;
    Residuals at;
  };
  /// One linearisation of |r_i|: value at the iterate and gradient.
  struct Piece {
    Eigen::Index residual = 0;
    double value = 0.0;
    Eigen::VectorXd gradient;
  };

  double sign(Eigen::Index i) const { return at_.r[i] < 0.0 ? -1.0 : 1.0; }
  /// Largest diagonal entry of the Gauss-Newton Hessian: the unit of the shift.
  double curvature() const;
  void keep(Cut cut);
  /// Pieces of cuts that count; those of the iterate are not among them.
  std::vector<Piece> pieces() const;

  Eigen::VectorXd x_;
  Residuals at_;
  std::vector<Cut> cuts_;  ///< oldest first
};

}  // namespace hauberk
