#pragma once
/// Solids as authors write them, for tests of the kit.

#include <hauberk/kit/author.hpp>

namespace hauberk::test {

using kit::Point;
using kit::Turn;

/// A torus by its core circle, whose field is the distance.
struct Torus {
  static constexpr const char* kind = "test_torus";
  static constexpr std::array size_names{"R", "r"};
  static constexpr bool revolved = true;
  static constexpr bool field_is_distance = true;

  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    const S rho = q[0] + q[1] * v.c;
    return {rho * u.c, rho * u.s, q[1] * v.s};
  }
  template <class S>
  static S field(const Point<S>& x, const S* q)
  {
    return hypot(hypot(x[0], x[1]) - q[0], x[2]) - q[1];
  }
  template <class S>
  static Point<S> core(const Turn<S>& u, const S* q)
  {
    return {q[0] * u.c, q[0] * u.s, S(0.0)};
  }
  template <class S>
  static S radius(const S* q)
  {
    return q[1];
  }
  static std::vector<std::vector<Vec3>> cores(const double* q)
  {
    std::vector<Vec3> corners;
    for (int k = 0; k < 12; ++k) {
      const Turn<double> u = kit::turn(std::numbers::pi * k / 6.0);
      corners.emplace_back(q[0] * u.c, q[0] * u.s, 0.0);
    }
    return {corners};
  }
};

/// The same torus by its surface, with a field that is no distance.
struct PlainTorus {
  static constexpr const char* kind = "test_plain_torus";
  static constexpr std::array size_names{"R", "r"};

  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    return Torus::chart(u, v, q);
  }
  template <class S>
  static S field(const Point<S>& x, const S* q)
  {
    using kit::square;
    return square(hypot(x[0], x[1]) - q[0]) + square(x[2]) - square(q[1]);
  }
  static std::vector<std::vector<Vec3>> cores(const double* q) { return Torus::cores(q); }
};

/// Points within r of the segment from -h to h on the axis z; curvature jumps where the cylinder meets the
/// caps.
///
/// Of the chart's height 2 cos v the part beyond [-1, 1] is the sine e of the latitude on a cap, where the
/// cosine is sqrt(1 - e^2) = sin v sqrt(2 (1 + |e|)/(1 + |cos v|)), which is smooth at the poles.
struct Capsule {
  static constexpr const char* kind = "test_capsule";
  static constexpr std::array size_names{"h", "r"};
  static constexpr bool revolved = true;
  static constexpr bool field_is_distance = true;
  static constexpr bool curvature_jumps = true;
  static constexpr bool convex = true;
  static constexpr Fold fold = Fold::mirror;

  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    using std::abs, std::clamp, std::sqrt;
    const S height = 2.0 * v.c, middle = clamp(height, S(-1.0), S(1.0)), e = height - middle;
    const S across = clamp(v.s * sqrt(2.0 * (1.0 + abs(e)) / (1.0 + abs(v.c))), S(-1.0), S(1.0));
    return {q[1] * across * u.c, q[1] * across * u.s, q[0] * middle + q[1] * e};
  }
  template <class S>
  static S field(const Point<S>& x, const S* q)
  {
    using std::clamp, std::sqrt, kit::square;
    const S beyond = x[2] - clamp(x[2], -q[0], q[0]);
    return sqrt(square(x[0]) + square(x[1]) + square(beyond)) - q[1];
  }
  template <class S>
  static Point<S> core(const Turn<S>& u, const S* q)
  {
    return {S(0.0), S(0.0), q[0] * u.c};
  }
  template <class S>
  static S radius(const S* q)
  {
    return q[1];
  }
  static std::vector<std::vector<Vec3>> cores(const double*) { return {}; }
};

/// A ring of elliptical wire by its surface; the field is no distance.
struct OvalRing {
  static constexpr const char* kind = "test_oval_ring";
  static constexpr std::array size_names{"R", "w", "h"};
  static constexpr bool revolved = true;

  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    const S rho = q[0] + q[1] * v.c;
    return {rho * u.c, rho * u.s, q[2] * v.s};
  }
  template <class S>
  static S field(const Point<S>& x, const S* q)
  {
    using kit::square;
    return square((hypot(x[0], x[1]) - q[0]) / q[1]) + square(x[2] / q[2]) - 1.0;
  }
  static std::vector<std::vector<Vec3>> cores(const double* q) { return Torus::cores(q); }
};

/// A ring of radius R whose section is the superellipse ((rho - R)/w)^4 + (z/h)^4 = 1.
struct RoundedRing {
  static constexpr const char* kind = "test_rounded_ring";
  static constexpr std::array size_names{"R", "w", "h"};
  static constexpr bool revolved = true;

  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    using std::sqrt, kit::square;
    const S by = 1.0 / sqrt(sqrt(square(square(v.c)) + square(square(v.s))));
    const S rho = q[0] + q[1] * v.c * by;
    return {rho * u.c, rho * u.s, q[2] * v.s * by};
  }
  template <class S>
  static S field(const Point<S>& x, const S* q)
  {
    using kit::square;
    const S across = (hypot(x[0], x[1]) - q[0]) / q[1], up = x[2] / q[2];
    return square(square(across)) + square(square(up)) - 1.0;
  }
  static std::vector<std::vector<Vec3>> cores(const double* q) { return Torus::cores(q); }
};

struct Ellipsoid {
  static constexpr const char* kind = "test_ellipsoid";
  static constexpr std::array size_names{"a", "b", "c"};
  static constexpr Fold fold = Fold::pole;

  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    return {q[0] * v.s * u.c, q[1] * v.s * u.s, q[2] * v.c};
  }
  template <class S>
  static S field(const Point<S>& x, const S* q)
  {
    using kit::square;
    return square(x[0] / q[0]) + square(x[1] / q[1]) + square(x[2] / q[2]) - 1.0;
  }
  static std::vector<std::vector<Vec3>> cores(const double*) { return {}; }
};

}  // namespace hauberk::test
