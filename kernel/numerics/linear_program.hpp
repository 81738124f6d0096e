#pragma once
/// Small dense linear programs over one polyhedron.

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <vector>

namespace hauberk {

/// The polyhedron {f >= 0 : A f = b}, and the least values of linear functions on it.
///
/// Primal simplex method on a dense tableau; Bland's rule picks the pivots, so that no degenerate vertex is
/// visited twice (Bland, Mathematics of Operations Research 2 (1977) 103-107). Rows of A must be of
/// comparable size; numbers below `tolerance` times the largest of b count as zero. Not thread safe.
class LinearProgram {
 public:
  LinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double tolerance = 1e-9);

  /// False: no f >= 0 has A f = b.
  bool feasible() const { return feasible_; }

  /// min c . f; -infinity where it has no bound; null: not feasible, or rounding prevented progress.
  std::optional<double> least(const Eigen::VectorXd& c);

 private:
  enum class End { optimal, unbounded, failed };
  End minimise(Eigen::RowVectorXd& cost, Eigen::Index columns);
  void pivot(Eigen::Index row, Eigen::Index column, Eigen::RowVectorXd& cost);

  Eigen::MatrixXd tableau_;  ///< rows of A, identity for the start, b; in the current basis
  std::vector<Eigen::Index> basis_;
  Eigen::Index variables_ = 0;
  double tolerance_ = 0.0;
  bool feasible_ = false;
};

}  // namespace hauberk
