#pragma once
/// A ring of rounded rectangular wire, as a chart and a field from which the kit makes a solid.

#include <hauberk/kit/solid_shape.hpp>

namespace hauberk {

/// Sizes: R from the ring's axis z to the middle of the wire; half the wire's width w, along the radius, and
/// half its height h, along the axis; the radius c of its corners. The section is all within c of the
/// rectangle of half-width w - c and half-height h - c.
struct RoundedRing {
  static constexpr const char* kind = "rounded_ring";
  static constexpr std::array size_names{"R", "w", "h", "corner"};
  static constexpr bool field_is_distance = true;
  static constexpr bool curvature_jumps = true;
  static constexpr bool revolved = true;

  /// Half the flats' lengths.
  template <class S>
  struct Flats {
    S w, h;
    explicit Flats(const S* q) : w(q[1] - q[3]), h(q[2] - q[3]) {}
  };

  /// How far along the section's outline a point is from the middle of a side, where the cosine and sine of
  /// the angle from there are `cosine` and `sine` and `quarter` is the length up to the middle of the next
  /// side: quarter/2 (sine + sine |sine|/(1 + |cosine|)) is quarter (|sine| - |cosine| + 1)/2 up to there,
  /// odd in the
  /// sine, with a derivative that does not jump.
  template <class S>
  static S along(const S& quarter, const S& sine, const S& cosine)
  {
    using std::abs;
    return quarter * 0.5 * (sine + sine * abs(sine) / (1.0 + abs(cosine)));
  }

  /// Of the outline's quarter, flat, corner and flat, the corner is c long, too: there the normal is (1 - t,
  /// t) up to its length, t from 0 to 1, which turns by 1/c at both ends, so that the speed along the outline
  /// does not jump.
  template <class S>
  static kit::Point<S> chart(const kit::Turn<S>& u, const kit::Turn<S>& v, const S* q)
  {
    using std::clamp, std::max, std::sqrt, kit::square;
    constexpr double below = 0.49;  // the sum is at least 1/2, which ranges of its terms do not tell
    const Flats<S> flat(q);
    const S &c = q[3], quarter = flat.w + flat.h + c;
    const S x = along(quarter, v.c, v.s), z = along(quarter, v.s, v.c);
    const S on_x = clamp(x, -flat.w, flat.w), on_z = clamp(z, -flat.h, flat.h);
    const S nx = clamp((x - on_x) / c, S(-1.0), S(1.0)), nz = clamp((z - on_z) / c, S(-1.0), S(1.0));
    const S by = c / sqrt(max(square(nx) + square(nz), S(below)));
    const S rho = q[0] + on_x + nx * by;
    return {rho * u.c, rho * u.s, on_z + nz * by};
  }

  /// Beyond the rectangle its distance less c; within it how deep, and c more.
  template <class S>
  static S field(const kit::Point<S>& x, const S* q)
  {
    using std::abs, std::max, std::min, std::sqrt, kit::hypot, kit::square;
    constexpr double none = 1e-300;  // the root has no derivative at 0
    const Flats<S> flat(q);
    const S across = abs(hypot(x[0], x[1]) - q[0]) - flat.w, up = abs(x[2]) - flat.h, zero = S(0.0);
    const S beyond = sqrt(max(square(max(across, zero)) + square(max(up, zero)), S(none)));
    return beyond + min(max(across, up), zero) - q[3];
  }

  /// Middles of sides, where the second derivative of `along` jumps, and ends of flats, where quarter (|sin
  /// v| - |cos v| + 1)/2 is h - c, and c more.
  static std::vector<double> breaks(const double* q);
  /// A polygon that leaves the core circle by less than half of w.
  static std::vector<std::vector<Vec3>> cores(const double* q);
  static std::vector<ParameterInfo> parameters();
  /// Throws InputError where the wire has no such corners or leaves no hole.
  static void check(const double* q);
};

}  // namespace hauberk
