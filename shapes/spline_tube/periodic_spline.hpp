#pragma once
/// Closed splines through nodes, with four continuous derivatives.

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace hauberk {

/// The cardinal spline of degree 5 and period n: 1 at its own node, 0 at the others, nodes at t = 0, 1, ...
///
/// Between nodes it is a sum of uniform B-splines (de Boor, A Practical Guide to Splines, 2001, chapter IX),
/// whose weights solve a circulant system; at nodes B-splines are 1, 26, 66, 26, 1 over 120, so that there is
/// always one solution. Immutable, thread safe.
class CardinalSpline {
 public:
  static constexpr int degree = 5;

  /// n >= 1
  explicit CardinalSpline(int n);

  int nodes() const { return static_cast<int>(pieces_.rows()); }
  /// Coefficients of 1, s, ..., s^5 at t = k + s, 0 <= s <= 1, of the spline that is 1 at `node`.
  auto coefficients(int node, int k) const { return pieces_.row(((k - node) % nodes() + nodes()) % nodes()); }

 private:
  Eigen::Matrix<double, Eigen::Dynamic, degree + 1> pieces_;  ///< by k - node, modulo n
};

/// A closed curve in D dimensions through nodes: the cardinal splines times their places. Immutable, thread
/// safe.
template <int D>
class PeriodicSpline {
 public:
  using Point = Eigen::Matrix<double, D, 1>;
  using Derivatives = std::array<Point, CardinalSpline::degree + 1>;  ///< of order 0, 1, ..., 5

  PeriodicSpline(const CardinalSpline& basis, std::span<const Point> nodes)
  {
    const int n = basis.nodes();
    for (int k = 0; k < n; ++k) {
      pieces_.push_back(Piece::Zero());
      for (int i = 0; i < n; ++i)
        pieces_.back() += nodes[static_cast<std::size_t>(i)] * basis.coefficients(i, k);
    }
  }

  int period() const { return static_cast<int>(pieces_.size()); }

  /// At t = piece + s, of the polynomial of that piece.
  Derivatives at(int piece, double s) const
  {
    const Piece& p = pieces_[static_cast<std::size_t>(piece)];
    Derivatives d;
    for (int order = 0; order <= CardinalSpline::degree; ++order) {
      Point sum = Point::Zero();
      for (int j = CardinalSpline::degree; j >= order; --j) {
        double factor = 1.0;
        for (int k = 0; k < order; ++k) factor *= j - k;
        sum = sum * s + factor * p.col(j);
      }
      d[static_cast<std::size_t>(order)] = sum;
    }
    return d;
  }
  Derivatives at(double t) const
  {
    const double turn = t - period() * std::floor(t / period());
    const int piece = std::min(static_cast<int>(turn), period() - 1);
    return at(piece, turn - piece);
  }

 private:
  using Piece = Eigen::Matrix<double, D, CardinalSpline::degree + 1>;
  std::vector<Piece> pieces_;
};

}  // namespace hauberk
