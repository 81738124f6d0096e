#pragma once
/// The signed distance from the surface of a field, with its first and second derivatives.

#include <hauberk/kit/author.hpp>

namespace hauberk::kit {

/// Two unit vectors that make a right-handed frame with the unit vector n: its columns are t1, t2, n.
/// Duff et al. 2017, Building an orthonormal basis, revisited.
inline Mat3 frame_of(const Vec3& n)
{
  const double sign = std::copysign(1.0, n.z()), a = -1.0 / (sign + n.z()), b = n.x() * n.y() * a;
  Mat3 frame;
  frame << 1.0 + sign * n.x() * n.x() * a, b, n.x(),  //
      sign * b, sign + n.y() * n.y() * a, n.y(),      //
      -sign * n.x(), -n.y(), n.z();
  return frame;
}

/// Eigenvalues of [[a, b], [b, d]], the larger first, and the larger one's unit eigenvector (cosine, sine).
struct SymmetricPair {
  double larger, smaller, cosine, sine;

  SymmetricPair(double a, double b, double d)
  {
    const double mean = 0.5 * (a + d), half = 0.5 * (a - d), r = std::sqrt(half * half + b * b);
    larger = mean + r, smaller = mean - r;
    cosine = 1.0, sine = 0.0;
    if (!(r > 0.0)) return;
    // cos 2t = half/r and sin 2t = b/r; the larger of cos t and sin t comes first, as the other divides by
    // it.
    const double big = std::sqrt(0.5 + 0.5 * std::abs(half) / r), small = 0.5 * b / (r * big);
    if (half >= 0.0)
      cosine = big, sine = small;
    else
      cosine = std::abs(small), sine = std::copysign(big, b);
  }
};

/// A field's value, gradient and second derivatives at a point.
struct FieldAt {
  double value, steep;  ///< the value, and the gradient's length
  Vec3 gradient;
  double xx, xy, xz, yy, yz, zz;

  explicit FieldAt(const Jet<double, 3, 2>& f)
      : value(f.c[0]),
        gradient(f.c[1], f.c[2], f.c[3]),
        xx(2.0 * f.c[4]),
        xy(f.c[5]),
        xz(f.c[6]),
        yy(2.0 * f.c[7]),
        yz(f.c[8]),
        zz(2.0 * f.c[9])
  {
    steep = std::sqrt(gradient.squaredNorm());
  }
  Vec3 hessian_times(const Vec3& w) const
  {
    return {xx * w.x() + xy * w.y() + xz * w.z(), xy * w.x() + yy * w.y() + yz * w.z(),
            xz * w.x() + yz * w.y() + zz * w.z()};
  }
  bool is_regular() const { return steep > 0.0 && std::isfinite(steep) && std::isfinite(xx + yy + zz); }
};

/// Normal, principal directions and curvatures of the level surface through the point, P D2f P/|grad f|.
inline SolidDistance level_surface(const FieldAt& f)
{
  SolidDistance s;
  const double by = 1.0 / f.steep;
  s.normal = by * f.gradient;
  const Mat3 frame = frame_of(s.normal);
  const Vec3 t1 = frame.col(0), t2 = frame.col(1), h1 = f.hessian_times(t1), h2 = f.hessian_times(t2);
  const SymmetricPair k(by * t1.dot(h1), by * t2.dot(h1), by * t2.dot(h2));
  s.bend_along = k.larger, s.bend_across = k.smaller;
  s.along = k.cosine * t1 + k.sine * t2;
  return s;
}

/// The field at x, or beside x where the field has no derivatives at x, as on the axis of a torus.
template <class Author>
FieldAt regular_field(const Vec3& x, const double* q, double size)
{
  const FieldAt f(field_jet<Author, 2>(x, q));
  if (f.is_regular()) [[likely]]
    return f;
  FieldAt beside(field_jet<Author, 2>(x + 1e-9 * size * Vec3(0.48, 0.6, 0.64), q));
  beside.value = f.value;
  return beside;
}

/// A point of the surface where the normal leads to x.
struct Foot {
  Vec3 y;
  bool found = false;
};

/// Solves y + l grad f(y) = x, f(y) = 0 by Newton's method, from where f's parabola along its gradient is 0.
///
/// At each y the multiplier is l = (x - y) . grad f/|grad f|^2. With M = 1 + l D2f and the tangents T at y, a
/// step y' has the part -f/|grad f| along the normal n, and its tangential part solves T^t M y' = T^t (x -
/// y). Where T^t M T is not positive definite, x lies beyond a center of curvature and 1 stands for it. A
/// step that does not shrink the residual is halved, up to six times.
template <class Author>
class FootSearch {
 public:
  FootSearch(const Vec3& x, const double* q, double size) : x_(x), q_(q), size_(size) {}

  /// `at_x` is the field at x. Found means: to rounding, on the side of the surface that the field tells.
  Foot from(const FieldAt& at_x) const { return from(at_x, x_ - along_gradient(at_x) * at_x.gradient); }

  /// The same from a point near the surface.
  Foot from(const FieldAt& at_x, const Vec3& begin) const
  {
    State s = state(begin);
    for (int k = 0; k < 30 && s.f.is_regular(); ++k) {
      const Step step = newton_step(s);
      const double moves = step.y.norm();
      if (moves <= 1e-8 * size_) {
        // One more step from so near is exact to rounding.
        const bool same_side = s.l * at_x.value >= 0.0 || std::abs(at_x.value) <= 1e-10 * at_x.steep * size_;
        return {s.y + step.y, same_side && step.whole};
      }
      s = shortened(s, step.y, std::min(1.0, 0.5 * size_ / moves));
    }
    return {};
  }

 private:
  struct State {
    Vec3 y, away;  ///< the point, and x - y
    FieldAt f;
    double l;
    double residual;  ///< squared distance of x from the normal, and of y from the surface
  };
  struct Step {
    Vec3 y;
    bool whole;  ///< with M itself
  };

  /// The l at which f is 0 along x - l grad f, by f's parabola there; by its tangent where that has no root.
  static double along_gradient(const FieldAt& f)
  {
    const double square = f.steep * f.steep, bend = f.gradient.dot(f.hessian_times(f.gradient));
    const double root = square * square - 2.0 * f.value * bend;
    return 2.0 * f.value / (square + (root >= 0.0 ? std::sqrt(root) : square));
  }

  State state(const Vec3& y) const
  {
    const FieldAt f(field_jet<Author, 2>(y, q_));
    const Vec3 away = x_ - y;
    const double l = away.dot(f.gradient) / (f.steep * f.steep), height = f.value / f.steep;
    return {y, away, f, l, (away - l * f.gradient).squaredNorm() + height * height};
  }

  static Step newton_step(const State& s)
  {
    const FieldAt& f = s.f;
    const Mat3 frame = frame_of(f.gradient / f.steep);
    const Vec3 t1 = frame.col(0), t2 = frame.col(1), n = frame.col(2);
    const Vec3 h1 = s.l * f.hessian_times(t1), h2 = s.l * f.hessian_times(t2);
    double m11 = 1.0 + t1.dot(h1), m12 = t1.dot(h2), m22 = 1.0 + t2.dot(h2);
    const bool whole = m11 > 1e-3 && m11 * m22 - m12 * m12 > 1e-3 * m11;
    if (!whole) m11 = m22 = 1.0, m12 = 0.0;
    const double b = -f.value / f.steep;
    const double r1 = t1.dot(s.away) - b * n.dot(h1), r2 = t2.dot(s.away) - b * n.dot(h2);
    const double by = 1.0 / (m11 * m22 - m12 * m12);
    return {by * (m22 * r1 - m12 * r2) * t1 + by * (m11 * r2 - m12 * r1) * t2 + b * n, whole};
  }

  State shortened(const State& s, const Vec3& step, double share) const
  {
    State next = state(s.y + share * step);
    for (int k = 0; k < 6 && !(next.residual < s.residual); ++k) {
      share *= 0.5;
      next = state(s.y + share * step);
    }
    return next;
  }

  Vec3 x_;
  const double* q_;
  double size_;
};

/// Distance and derivatives at x of a surface that is near `y`: by y's tangent plane, which is exact to
/// second order, and with the curvatures k/(1 + d k) of the parallel surface through x.
inline SolidDistance parallel_surface(const Vec3& x, const Vec3& y, const FieldAt& at_y)
{
  SolidDistance s = level_surface(at_y);
  const Vec3 away = x - y;
  s.distance = away.dot(s.normal) + at_y.value / at_y.steep;
  s.bend_along /= 1.0 + s.distance * s.bend_along;
  s.bend_across /= 1.0 + s.distance * s.bend_across;
  return s;
}

}  // namespace hauberk::kit
