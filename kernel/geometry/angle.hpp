#pragma once
/// Angles by their cosine and sine.

#include <cmath>

namespace hauberk {

/// An angle by its cosine and sine.
struct Angle {
  double c = 1.0, s = 0.0;

  Angle() = default;
  /// To a few units of rounding, by a table and series: a third of the time of the library's functions.
  explicit Angle(double radians);

  /// This angle and `by` more; for |by| <= 1/4 by series of which nothing above rounding is left out.
  Angle turned(double by) const
  {
    Angle t;
    if (std::abs(by) > 0.25) {
      t = Angle(by);
    } else {
      const double q = by * by;
      const auto term = [q](double rest, double n) { return 1.0 - q / n * rest; };
      t.s = by * term(term(term(term(term(term(1.0, 156.0), 110.0), 72.0), 42.0), 20.0), 6.0);
      t.c = term(term(term(term(term(term(1.0, 132.0), 90.0), 56.0), 30.0), 12.0), 2.0);
    }
    return turned(t);
  }
  Angle reversed() const { return {c, -s}; }
  Angle turned(const Angle& by) const { return {c * by.c - s * by.s, s * by.c + c * by.s}; }

 private:
  Angle(double cosine, double sine) : c(cosine), s(sine) {}
};

}  // namespace hauberk
