#pragma once
/// Sparse L D L^T of symmetric matrices that may be indefinite, by the multifrontal method.

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace hauberk {

using Sparse = Eigen::SparseMatrix<double>;

/// P (A + shift I) P^T = L D L^T without pivoting: P keeps L sparse, columns of like pattern are eliminated
/// together in dense blocks (Duff, Reid 1983). By Sylvester's law D has as many negative entries as A + shift
/// I has negative eigenvalues. CHOLMOD chooses P and the blocks; its own factorisation in blocks is of
/// definite matrices only.
///
/// Without pivoting small pivots lose digits: who solves should refine. Not thread safe; independent of the
/// number of threads.
class SparseLdlt {
 public:
  /// For a matrix given by its lower triangle. `order`: the rows in the order of elimination, as another
  /// matrix had it; empty: the one of minimum degree or, where that leaves much to do, of nested dissection
  /// that fills less. Throws std::bad_alloc; std::runtime_error where the library that finds the order
  /// cannot be loaded.
  SparseLdlt(const Sparse& lower, const std::vector<int>& order);

  /// The rows in the order of elimination.
  const std::vector<int>& order() const { return order_; }

  /// Factors A + shift I. False, and nothing to solve with: a pivot is zero, or more than `most_negative` are
  /// negative.
  bool factor(double shift, int most_negative);
  /// Negative eigenvalues of what was factored.
  int negative() const { return negative_; }
  /// x with (A + shift I) x = b, columns by columns.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  /// Columns that are eliminated together: `columns` of them from `first` on, which have the rows `rows` (the
  /// columns' own ones first, ascending).
  struct Block {
    int first = 0, columns = 0, parent = -1;
    std::vector<int> rows;
    std::size_t at = 0;  ///< of its rows x columns entries in `values_`: L below the diagonal, D on it
  };

  void analyze(const Sparse& lower, const std::vector<int>& order);
  Eigen::VectorXd solve_permuted(Eigen::VectorXd x) const;

  std::vector<int> order_;
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation_;
  Sparse permuted_;  ///< lower triangle of P A P^T
  std::vector<Block> blocks_;
  std::vector<double> values_;
  int negative_ = 0;
};

}  // namespace hauberk
