#pragma once
/// What an author of a solid writes, and its evaluation on numbers, jets and Taylor models.
///
///     struct Torus {
///       static constexpr const char* kind = "my_torus";
///       static constexpr std::array size_names{"R", "r"};
///       template <class S>
///       static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q);
///       template <class S>
///       static S field(const Point<S>& x, const S* q);  // negative inside, 0 on the surface
///       static std::vector<std::vector<Vec3>> cores(const double* q);
///     };
///
/// q points at the sizes, in the order of their names. The chart covers the surface over [0, 2 pi]^2, is
/// periodic, and has continuous first derivatives, which beside a `core` are not needed: there the chart says
/// where the surface is, and its pieces may meet at different speeds. Optional members:
///
///     template <class S>
///     static Point<S> core(const Turn<S>& u, const S* q);
///     template <class S>
///     static S radius(const S* q);  // constant distance of the surface from the core
///     static constexpr bool field_is_distance = true;
///     static constexpr Fold fold = Fold::mirror;  // of the probe
///     static constexpr bool curvature_jumps = true;
///     static std::vector<double> breaks(const double* q);
///     static constexpr bool convex = true;
///     static constexpr bool revolved = true;
///
/// Without `core` the surface itself is probed. Of a field that is no distance feet are found by Newton's
/// method. Where curvature does not jump the field has three derivatives; where it jumps along lines of
/// constant v alone, `breaks` gives these v, between which the chart has three. Where convexity is not stated
/// the kit finds out, see curvature_bounds.hpp. Of a surface of revolution, whose chart u turns about the
/// axis z, bounds are made along one meridian; of others all over, which takes some 20 times as long.

#include <hauberk/kit/taylor_model.hpp>
#include <hauberk/solid.hpp>

namespace hauberk::kit {

/// Cosine and sine of a coordinate.
template <class S>
struct Turn {
  S c, s;
};

template <class S>
using Point = std::array<S, 3>;

/// What an author states beyond chart and field.
template <class Author>
struct Statements {
  static constexpr std::size_t sizes = Author::size_names.size();
  static constexpr bool has_core = requires(const Turn<double>& u, const double* q)
  {
    Author::template core<double>(u, q);
  };
  static constexpr bool has_breaks = requires(const double* q) { Author::breaks(q); };
  static constexpr bool field_is_distance = [] {
    if constexpr (requires { Author::field_is_distance; })
      return Author::field_is_distance;
    else
      return false;
  }();
  static constexpr bool curvature_jumps = [] {
    if constexpr (requires { Author::curvature_jumps; })
      return Author::curvature_jumps;
    else
      return false;
  }();
  static constexpr bool convex = [] {
    if constexpr (requires { Author::convex; })
      return Author::convex;
    else
      return false;
  }();
  static constexpr bool revolved = [] {
    if constexpr (requires { Author::revolved; })
      return Author::revolved;
    else
      return false;
  }();
  static constexpr Fold fold = [] {
    if constexpr (requires { Author::fold; })
      return Author::fold;
    else
      return Fold::none;
  }();
};

/// cos and sin of the angle whose cosine and sine at the center are c and s, as polynomials of unknown k.
template <class J, class S>
Turn<J> turn_jet(const S& c, const S& s, int k)
{
  Turn<J> t{J(c), J(s)};
  S dc = c, ds = s;
  for (std::size_t m = 1; m < J::size; ++m) {
    if (J::M::all[m][k] != J::M::degree(J::M::all[m])) continue;
    const S next = -ds * (1.0 / J::M::all[m][k]);
    ds = dc * (1.0 / J::M::all[m][k]);
    dc = next;
    t.c.c[m] = dc;
    t.s.c[m] = ds;
  }
  return t;
}

/// Sizes as constants of the scalar type J.
template <class Author, class J>
std::array<J, Statements<Author>::sizes> constants(const double* q)
{
  std::array<J, Statements<Author>::sizes> list;
  for (std::size_t k = 0; k < list.size(); ++k) list[k] = J(q[k]);
  return list;
}

/// The surface or, of dimension 1, the core: what a chart table and a probe are made of.
template <class A, bool core>
struct Chart {
  using Author = A;
  static constexpr int dimension = core ? 1 : 2;
  /// Second derivatives of a chart may jump where those of the field do, at places that are stated or not; a
  /// core is smooth.
  static constexpr bool jumps =
      !core && Statements<Author>::curvature_jumps && !Statements<Author>::has_breaks;

  static std::vector<double> breaks(const double* q)
  {
    if constexpr (Statements<Author>::has_breaks)
      return Author::breaks(q);
    else
      return {};
  }

  template <class S>
  static Point<S> at(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    if constexpr (core)
      return Author::template core<S>(u, q);
    else
      return Author::template chart<S>(u, v, q);
  }

  /// The chart's polynomial in (u, v), or in u alone, about a point or over a box.
  template <int order, class S>
  static Point<Jet<S, dimension, order>> jet(const Turn<S>& u, const Turn<S>& v, const double* q)
  {
    using J = Jet<S, dimension, order>;
    const auto sizes = constants<Author, J>(q);
    const Turn<J> ju = turn_jet<J>(u.c, u.s, 0);
    if constexpr (core)
      return Author::template core<J>(ju, sizes.data());
    else
      return Author::template chart<J>(ju, turn_jet<J>(v.c, v.s, 1), sizes.data());
  }
};

/// The field's polynomial about `x` in coordinates along the columns of `frame`.
template <class Author, int order, class S>
Jet<S, 3, order> field_jet(const Point<S>& x, const Mat3& frame, const double* q)
{
  using J = Jet<S, 3, order>;
  Point<J> at;
  for (int i = 0; i < 3; ++i) {
    at[i].c[0] = x[i];
    for (int k = 0; k < 3; ++k) at[i].c[1 + k] = frame(i, k);
  }
  const auto sizes = constants<Author, J>(q);
  return Author::template field<J>(at, sizes.data());
}

/// The same in the coordinates themselves.
template <class Author, int order, class S>
Jet<S, 3, order> field_jet(const Point<S>& x, const double* q)
{
  using J = Jet<S, 3, order>;
  const Point<J> at{J::variable(x[0], 0), J::variable(x[1], 1), J::variable(x[2], 2)};
  const auto sizes = constants<Author, J>(q);
  return Author::template field<J>(at, sizes.data());
}
template <class Author, int order>
Jet<double, 3, order> field_jet(const Vec3& x, const double* q)
{
  return field_jet<Author, order, double>({x.x(), x.y(), x.z()}, q);
}

template <class Author>
Vec3 chart_point(const Turn<double>& u, const Turn<double>& v, const double* q)
{
  const Point<double> x = Author::template chart<double>(u, v, q);
  return {x[0], x[1], x[2]};
}

inline Turn<double> turn(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// What part of [0, 2 pi]^2 a grid of cells has to cover. Where (u, v) and (u + pi, -v) mean the same point,
/// as they do of a chart with poles at v = 0 and v = pi, v from 0 to pi covers the surface once. Of a surface
/// of revolution the line u = 0 tells all that does not depend on axes. Both are what samples do not refute.
struct ChartDomain {
  static constexpr int columns = 16;  ///< of the coarsest grid around u
  bool poles = false, revolved = false;

  int rows() const { return poles ? 8 : 16; }
  double half_u() const { return std::numbers::pi / columns; }
  double half_v() const { return std::numbers::pi / 16; }

  template <class Author>
  static ChartDomain of(const double* q)
  {
    double size = 0.0, apart = 0.0, turned = 0.0;
    for (int k = 0; k < 32; ++k) {
      const Turn<double> u = turn(0.37 + 2.39996322972865 * k), v = turn(0.11 + 0.7548776662 * k);
      const Vec3 x = chart_point<Author>(u, v, q), at_0 = chart_point<Author>(turn(0.0), v, q);
      size = std::max(size, x.norm());
      apart = std::max(apart, (x - chart_point<Author>({-u.c, -u.s}, {v.c, -v.s}, q)).norm());
      turned = std::max(turned, (x - about_z(u) * at_0).norm());
    }
    const double rounding = 1e-12 * size;
    return {apart <= rounding, Statements<Author>::revolved && turned <= rounding};
  }

  /// The rotation by u about the axis z.
  static Mat3 about_z(const Turn<double>& u)
  {
    Mat3 r;
    r << u.c, -u.s, 0.0, u.s, u.c, 0.0, 0.0, 0.0, 1.0;
    return r;
  }
};

/// A number over a cell of the chart, whose coordinates are u and v.
using OverCell = TaylorModel<3>;

/// Cosine and sine over |angle - center| <= half: by Taylor's theorem, whose rest is at most |d|^n/n! with n
/// the next power of d = angle - center.
inline Turn<OverCell> turn_range(double center, double half, bool is_v)
{
  using P = OverCell::Polynomial;
  const Turn<double> t = turn(center);
  const Turn<P> p = turn_jet<P>(t.c, t.s, is_v ? 1 : 0);
  Turn<OverCell> range{{p.c, 1e-15, 0.0}, {p.s, 1e-15, 0.0}};
  double scale = 1.0;
  double rest = half;
  for (int k = 1; k <= OverCell::kept; ++k) {
    typename P::M::Exponents e{};
    e[is_v ? 1 : 0] = k;
    scale *= half;
    rest *= half / (k + 1);
    range.c.p.c[P::M::index(e)] *= scale, range.s.p.c[P::M::index(e)] *= scale;
  }
  range.c.r += rest, range.s.r += rest;
  range.c.size = range.s.size = 1.0 + std::exp(half);
  return range;
}

}  // namespace hauberk::kit
