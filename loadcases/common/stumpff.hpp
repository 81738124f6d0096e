#pragma once
/// The entire functions that sines and cosines of an angle are made of, for sheets that roll up.

#include <array>
#include <cmath>

namespace hauberk {

/// c_n(q) = sum over j of (-q)^j/(2 j + n)! for n = 0 .. 7 and q = a^2 >= 0 (Stumpff's functions): cos a, sin
/// a/a, (1 - cos a)/a^2, (a - sin a)/a^3, and so on. As c_n = 1/n! - q c_(n+2), each follows from the one two
/// below divided by q, or the one two above times q: large and small q lose no digits that way.
class Stumpff {
 public:
  explicit Stumpff(double q)
  {
    constexpr double small = 4.0;
    if (q < small) {
      for (const int n : {count - 1, count - 2}) c_[n] = series(q, n);
      for (int n = count - 3; n >= 0; --n) c_[n] = 1.0 / factorial[n] - q * c_[n + 2];
    } else {
      const double a = std::sqrt(q);
      c_[0] = std::cos(a);
      c_[1] = std::sin(a) / a;
      for (int n = 2; n < count; ++n) c_[n] = (1.0 / factorial[n - 2] - c_[n - 2]) / q;
    }
  }

  /// Taylor coefficients of c_n, n <= 3, at q up to the second: c_n' = (n c_(n+2) - c_(n+1))/2, termwise.
  std::array<double, 3> taylor(int n) const
  {
    return {c_[n], slope(n), 0.25 * (n * slope(n + 2) - slope(n + 1))};
  }

 private:
  static constexpr int count = 8;
  static constexpr std::array<double, count> factorial{1, 1, 2, 6, 24, 120, 720, 5040};

  static double series(double q, int n)
  {
    constexpr int terms = 20;  // 4^20/46! is far below rounding
    double term = 1.0 / factorial[n], sum = term;
    for (int j = 1; j <= terms; ++j) sum += term *= -q / ((2 * j + n - 1) * (2 * j + n));
    return sum;
  }
  double slope(int n) const { return 0.5 * (n * c_[n + 2] - c_[n + 1]); }

  std::array<double, count> c_;
};

}  // namespace hauberk
