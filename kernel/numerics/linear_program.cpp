#include "numerics/linear_program.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Pivots of one minimisation, times rows and columns: Bland's rule ends, but nothing says how soon.
constexpr Eigen::Index most_pivots = 50;
constexpr double smallest_pivot = 1e-11;

}  // namespace

LinearProgram::LinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double tolerance)
    : variables_(A.cols()), tolerance_(tolerance)
{
  const Eigen::Index m = A.rows(), n = variables_;
  tableau_ = Eigen::MatrixXd::Zero(m, n + m + 1);
  tableau_.leftCols(n) = A;
  tableau_.col(n + m) = b;
  Eigen::RowVectorXd cost = Eigen::RowVectorXd::Zero(n + m + 1);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (b[i] < 0.0) tableau_.row(i) *= -1.0;
    tableau_(i, n + i) = 1.0;
    basis_.push_back(n + i);
    cost -= tableau_.row(i);  // the sum of artificial variables, which is zero where f is feasible
    cost[n + i] += 1.0;
  }
  const double size = m > 0 ? std::max(1.0, b.cwiseAbs().maxCoeff()) : 1.0;
  tolerance_ *= size;
  feasible_ = minimise(cost, n + m) == End::optimal && -cost[n + m] <= tolerance_ * std::max<double>(1.0, m);
  if (!feasible_) return;
  // An artificial variable that is still in the basis is zero; another takes its place, or its row is void.
  for (std::size_t i = 0; i < basis_.size(); ++i) {
    if (basis_[i] < n) continue;
    const auto row = static_cast<Eigen::Index>(i);
    Eigen::Index column = 0;
    if (n == 0 || tableau_.row(row).head(n).cwiseAbs().maxCoeff(&column) <= tolerance_) continue;
    pivot(row, column, cost);
  }
}

std::optional<double> LinearProgram::least(const Eigen::VectorXd& c)
{
  if (!feasible_) return std::nullopt;
  const Eigen::Index end = tableau_.cols() - 1;
  Eigen::RowVectorXd cost = Eigen::RowVectorXd::Zero(end + 1);
  cost.head(variables_) = c;
  for (std::size_t i = 0; i < basis_.size(); ++i) {
    if (basis_[i] < variables_) cost -= c[basis_[i]] * tableau_.row(i);
  }
  switch (minimise(cost, variables_)) {
    case End::optimal:
      return -cost[end];
    case End::unbounded:
      return -std::numeric_limits<double>::infinity();
    case End::failed:
      break;
  }
  return std::nullopt;
}

LinearProgram::End LinearProgram::minimise(Eigen::RowVectorXd& cost, Eigen::Index columns)
{
  const Eigen::Index end = tableau_.cols() - 1;
  const double scale = std::max(1.0, cost.head(columns).cwiseAbs().maxCoeff());
  for (Eigen::Index left = most_pivots * (tableau_.rows() + columns); left > 0; --left) {
    Eigen::Index column = 0;
    while (column < columns && cost[column] >= -tolerance_ * scale) ++column;
    if (column == columns) return End::optimal;
    Eigen::Index row = -1;
    double least = 0.0;
    for (Eigen::Index i = 0; i < tableau_.rows(); ++i) {
      if (tableau_(i, column) <= tolerance_) continue;
      const double ratio = std::max(0.0, tableau_(i, end)) / tableau_(i, column);
      const bool earlier = row >= 0 && ratio == least && basis_[i] < basis_[row];
      if (row < 0 || ratio < least || earlier) {
        row = i;
        least = ratio;
      }
    }
    if (row < 0) return End::unbounded;
    if (std::abs(tableau_(row, column)) < smallest_pivot) return End::failed;
    pivot(row, column, cost);
  }
  return End::failed;
}

void LinearProgram::pivot(Eigen::Index row, Eigen::Index column, Eigen::RowVectorXd& cost)
{
  tableau_.row(row) /= tableau_(row, column);
  for (Eigen::Index i = 0; i < tableau_.rows(); ++i) {
    if (i != row) tableau_.row(i) -= tableau_(i, column) * tableau_.row(row);
  }
  cost -= cost[column] * tableau_.row(row);
  basis_[row] = column;
}

}  // namespace hauberk
