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

  /// Value and derivative at t of that spline.
  struct Weight {
    double value = 0.0, slope = 0.0;
  };
  Weight at(int node, double t) const
  {
    const Place place(t, nodes());
    const auto c = coefficients(node, place.piece);
    Weight w;
    for (int j = degree; j >= 0; --j) {
      w.slope = w.slope * place.s + w.value;
      w.value = w.value * place.s + c[j];
    }
    return w;
  }

  /// A value of t, whichever turn it is on, as piece + s.
  struct Place {
    int piece = 0;
    double s = 0.0;

    Place(double t, int period)
    {
      const double turn = t - period * std::floor(t / period);
      piece = std::min(static_cast<int>(turn), period - 1);
      s = turn - piece;
    }
  };

 private:
  Eigen::Matrix<double, Eigen::Dynamic, degree + 1> pieces_;  ///< by k - node, modulo n
};

/// A closed curve in D dimensions through nodes: the cardinal splines times their places. Immutable, thread
/// safe.
template <int D>
class PeriodicSpline {
 public:
  using Point = Eigen::Matrix<double, D, 1>;
  /// Derivatives of order 0, 1, ..., `order`.
  template <int order>
  using To = std::array<Point, order + 1>;
  using Derivatives = To<CardinalSpline::degree>;  ///< all that are not 0

  PeriodicSpline(const CardinalSpline& basis, std::span<const Point> nodes)
  {
    const int n = basis.nodes();
    for (int k = 0; k < n; ++k) {
      pieces_.push_back(Piece::Zero());
      for (int i = 0; i < n; ++i) pieces_.back() += nodes[i] * basis.coefficients(i, k);
    }
  }

  int period() const { return static_cast<int>(pieces_.size()); }

  /// At t = piece + s, of the polynomial of that piece. A call of its own, as compilers unroll these loops
  /// there and not where they are inlined: evaluations take two thirds of the time.
  template <int most = CardinalSpline::degree>
  [[gnu::noinline]] To<most> at(int piece, double s) const
  {
    const Piece& p = pieces_[piece];
    To<most> d;
    for (int order = 0; order <= most; ++order) {
      Point sum = Point::Zero();
      for (int j = CardinalSpline::degree; j >= order; --j) {
        double factor = 1.0;
        for (int k = 0; k < order; ++k) factor *= j - k;
        sum = sum * s + factor * p.col(j);
      }
      d[order] = sum;
    }
    return d;
  }
  template <int most = CardinalSpline::degree>
  To<most> at(double t) const
  {
    const CardinalSpline::Place place(t, period());
    return at<most>(place.piece, place.s);
  }

 private:
  using Piece = Eigen::Matrix<double, D, CardinalSpline::degree + 1>;
  std::vector<Piece> pieces_;
};

}  // namespace hauberk
