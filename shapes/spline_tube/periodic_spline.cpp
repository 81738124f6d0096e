#include "periodic_spline.hpp"

namespace hauberk {
namespace {

constexpr int terms = CardinalSpline::degree + 1;

/// Rows are the six uniform B-splines that are not 0 from one node to the next, columns their coefficients of
/// 1, s, ..., s^5, times 120.
const Eigen::Matrix<double, terms, terms>& b_splines()
{
  static const Eigen::Matrix<double, terms, terms> rows =
      (Eigen::Matrix<double, terms, terms>() << 1, -5, 10, -10, 5, -1,  //
       26, -50, 20, 20, -20, 5,                                         //
       66, 0, -60, 0, 30, -10,                                          //
       26, 50, 20, -20, -20, 10,                                        //
       1, 5, 10, 10, 5, -5,                                             //
       0, 0, 0, 0, 0, 1)
          .finished() /
      120.0;
  return rows;
}

}  // namespace

CardinalSpline::CardinalSpline(int n)
{
  const auto wrapped = [n](int k) { return ((k % n) + n) % n; };
  // The value at node k of weights w: (w_(k-2) + 26 w_(k-1) + 66 w_k + 26 w_(k+1) + w_(k+2))/120.
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k)
    for (int m = 0; m < degree; ++m) values(k, wrapped(k - 2 + m)) += b_splines()(m, 0);
  const Eigen::VectorXd weights = values.ldlt().solve(Eigen::VectorXd::Unit(n, 0));
  pieces_.setZero(n, terms);
  for (int k = 0; k < n; ++k)
    for (int m = 0; m < terms; ++m) pieces_.row(k) += weights[wrapped(k - 2 + m)] * b_splines().row(m);
}

}  // namespace hauberk
