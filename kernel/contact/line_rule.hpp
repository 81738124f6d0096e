#pragma once
/// Gauss's rule along lines of a probe set, on the parts of them where a barrier acts.

#include "geometry/angle.hpp"
#include "geometry/meridian.hpp"

#include <hauberk/solid.hpp>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace hauberk {

/// Relative radius of curvature that makes sqrt(2 r g) a length of order of the contact zone; it only
/// scales the stiffness, so that the three barriers push alike (see barrier.hpp). Unit: L.
inline constexpr double reference_radius = 0.5;

/// Half-width of panels that are not halved again, radians.
inline constexpr double smallest_part = 1e-12;
/// Evaluations that the integral of one pair is worth, some seconds. Blades, with thousands of radii of
/// curvature around them, would take hours.
inline constexpr int most_integral_evaluations = 30000000;

template <int n>
struct GaussRule {
  std::array<double, n> x, w;
};

template <int n>
const GaussRule<n>& gauss_rule()
{
  static const GaussRule<n> rule = [] {
    GaussRule<n> r{};
    const auto& a = boost::math::quadrature::gauss<double, n>::abscissa();
    const auto& w = boost::math::quadrature::gauss<double, n>::weights();
    std::size_t k = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      r.x[k] = a[i];
      r.w[k++] = w[i];
      if (a[i] != 0.0) {
        r.x[k] = -a[i];
        r.w[k++] = w[i];
      }
    }
    return r;
  }();
  return rule;
}

/// The rule's places on an interval about `middle`, in pairs on either side of it.
template <int n>
std::array<Angle, n> rule_angles(const Angle& middle, double half)
{
  const auto& x = gauss_rule<n>().x;
  std::array<Angle, n> out;
  std::size_t k = 0;
  if (n % 2 == 1) out[k++] = middle;
  for (; k < n; k += 2) {
    const Angle by(half * x[k]);
    out[k] = middle.turned(by);
    out[k + 1] = middle.turned(by.reversed());
  }
  return out;
}

/// Half-width of the largest panels in each probe coordinate, radians.
inline constexpr double widest_panel = 0.15;

/// The same of a solid, by the larger of both curvatures and by how fast the surface's changes anywhere.
inline double solid_level_length(const Body& F, const FieldValue& f)
{
  const double bend = std::max({std::abs(f.m.k), std::abs(f.k_azimuth), 1e-300});
  const double change = F.solid->smoothness().change * F.unit * F.unit;
  // The change C of the curvature k along a surface lets it grow by itself over k/C.
  const double length = 0.2 / bend;
  return std::isfinite(change) && change > 0.0 ? std::min(length, 0.3 / std::sqrt(change)) : length;
}

/// A length over which the curvature of F's field changes little at the place of `f`: a part of
/// the radius of curvature of the level surface, and of the arc of F's profile over which that changes, both
/// seen from where the place is. With w = a^2 sin^2 v + b^2 cos^2 v the curvature a b/w^(3/2) of an ellipse
/// changes over the arc w/sqrt|a^2 - b^2|: its smallest radius at a sharp end, its length along a flat side.
inline double level_length(const Body& F, const FieldValue& f)
{
  if (F.solid) return solid_level_length(F, f);
  const double radius = 1.0 / std::max(f.m.k, 1e-300);
  double length = 0.2 * radius;
  if (F.is_ellipse()) {
    const double a = F.r0 * f.m.s, b = F.r1 * f.m.c, w = a * a + b * b;
    const double eccentric = std::sqrt(std::abs(F.r0 * F.r0 - F.r1 * F.r1));
    const double closer = f.m.k * f.m.phi < 0.5 ? 1.0 / (1.0 - f.m.k * f.m.phi) : 2.0;  // 1 + kappa phi
    length = std::min(length, 0.15 * closer * w / std::max(eccentric, 1e-300));
  }
  return length;
}

/// A place on a line of integration: the gap less g_hat there, and its derivative.
struct LinePoint {
  double t = 0.0, beyond = 0.0, slope = 0.0;

  bool inside() const { return beyond < 0.0; }
};

/// The cubic through two places with their slopes, over s in [0, 1] from one to the other.
struct LineCubic {
  double c0, c1, c2, c3;

  LineCubic(const LinePoint& a, const LinePoint& b)
  {
    const double h = b.t - a.t, rise = b.beyond - a.beyond;
    c0 = a.beyond;
    c1 = h * a.slope;
    c2 = 3.0 * rise - h * (2.0 * a.slope + b.slope);
    c3 = h * (a.slope + b.slope) - 2.0 * rise;
  }
  double at(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
  double slope(double s) const { return c1 + s * (2.0 * c2 + s * 3.0 * c3); }
  double second(double s) const { return 2.0 * c2 + 6.0 * c3 * s; }
};

/// The root of f in [0, 1], f of different signs there, by Newton steps kept between the ends; to about 1e-6.
template <typename F, typename D>
double root_in_unit(F&& f, D&& derivative)
{
  double low = 0.0, high = 1.0, s = 0.5;
  const bool rises = f(0.0) < f(1.0);
  for (int k = 0; k < 30; ++k) {
    const double value = f(s), d = derivative(s);
    ((value < 0.0) == rises ? low : high) = s;
    double next = d != 0.0 ? s - value / d : -1.0;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - s);
    s = next;
    if (step < 1e-6) break;
  }
  return s;
}

/// Width, in parts of the line, to which the place is found where the barrier sets in: what is cut off is of
/// fourth order in it, as the barrier begins with a third power.
inline constexpr double onset_width = 1e-4;

/// Where the barrier sets in between a and b, one inside and one not: by cubics through both ends, then by
/// Newton's step from a place so close that what the step leaves is within onset_width. `at` evaluates a
/// place.
template <typename At>
double onset_between(At&& at, LinePoint a, LinePoint b)
{
  const double width = std::abs(b.t - a.t);
  for (;;) {
    const double h = b.t - a.t;
    const LineCubic cubic(a, b);
    const double s =
        root_in_unit([&](double x) { return cubic.at(x); }, [&](double x) { return cubic.slope(x); });
    const LinePoint m = at(a.t + s * h);
    const double step = m.slope != 0.0 ? -m.beyond / m.slope : width;
    // The step leaves g'' step^2/(2 g').
    const double left = std::abs(0.5 * cubic.second(s) / (h * h) * step * step / m.slope);
    if (left < onset_width * width) return std::clamp(m.t + step, std::min(a.t, b.t), std::max(a.t, b.t));
    (m.inside() == a.inside() ? a : b) = m;
    if (std::abs(b.t - a.t) < onset_width * width) return m.t;
  }
}

/// Between a and b, on the same side of the onset and with the gap turning between them: a place on the other
/// side, if the gap gets there.
template <typename At>
std::optional<LinePoint> beyond_turn(At&& at, LinePoint a, LinePoint b)
{
  const double width = std::abs(b.t - a.t);
  while (std::abs(b.t - a.t) > onset_width * width) {
    const LineCubic cubic(a, b);
    const double s =
        root_in_unit([&](double x) { return cubic.slope(x); }, [&](double x) { return cubic.second(x); });
    const LinePoint m = at(a.t + s * (b.t - a.t));
    if (m.inside() != a.inside()) return m;
    // How much further the gap may still go, from its slope there over the rest of the way.
    if (std::abs(m.beyond) > 2.0 * std::abs(m.slope) * std::abs(b.t - a.t)) return std::nullopt;
    ((m.slope < 0.0) == (a.slope < 0.0) ? a : b) = m;
  }
  return std::nullopt;
}

/// Calls piece(from, to) for the parts of a line on which the gap is below g_hat. The barrier is a power of
/// (1 - x) there, and no more than twice differentiable at g_hat: Gauss's rule across that point has an error
/// of 1e-5 of the energy, on the parts up to it one of 1e-7. The line is so short that the gap turns at most
/// once on it.
template <typename At, typename Piece>
void inside_pieces(At&& at, double from, double to, Piece&& piece)
{
  const auto monotone = [&](const LinePoint& a, const LinePoint& b) {
    if (a.inside() == b.inside()) {
      if (a.inside()) piece(a.t, b.t);
      return;
    }
    const double onset = onset_between(at, a, b);
    if (a.inside())
      piece(a.t, onset);
    else
      piece(onset, b.t);
  };
  const LinePoint a = at(from), b = at(to);
  const bool turns = a.inside() == b.inside() &&
                     (a.inside() ? a.slope > 0.0 && b.slope < 0.0 : a.slope < 0.0 && b.slope > 0.0);
  if (turns) {
    if (const auto m = beyond_turn(at, a, b)) {
      monotone(a, *m);
      monotone(*m, b);
      return;
    }
  }
  monotone(a, b);
}

}  // namespace hauberk
