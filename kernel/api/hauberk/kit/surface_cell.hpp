#pragma once
/// Bounds of where a part of a surface lies and of how it bends, from Taylor models of chart and field.

#include <hauberk/kit/chart_bounds.hpp>
#include <hauberk/kit/foot.hpp>

namespace hauberk::kit {

/// The part of a surface whose coordinates are within half_u and half_v of u and v.
struct SurfaceCell {
  double u, v, half_u, half_v;
  Vec3 x;             ///< the point in the middle
  Mat3 frame;         ///< two tangents and the normal there
  double path = 0.0;  ///< each point is joined to x by a path in the cell, not longer than this
  double turn = 0.0;  ///< no unit normal differs by more from that at x
  double side_u = 0.0, side_v = 0.0;    ///< half the sides' lengths
  double twist_u = 0.0, twist_v = 0.0;  ///< how far the gradient's direction turns along half a side, about
  double most_at = 0.0, least_at = 0.0, change_at = 0.0;  ///< principal curvatures and change at x
  double most = 0.0, least = 0.0, change = 0.0;           ///< and their bounds over the cell

  double bend_at() const { return std::max(std::abs(most_at), std::abs(least_at)); }
  /// Whether normals turn over it as they do in its middle; they do not where curvature jumps.
  bool is_told_by_middle() const { return turn <= 3.0 * (twist_u + twist_v); }
  /// Across which side it is halved where places as well as normals count, these as seen from `far`.
  bool is_wider_in_u(double far) const
  {
    const double u = side_u + far * twist_u, v = side_v + far * twist_v;
    return is_told_by_middle() && u != v ? u > v : half_u > half_v;
  }
  /// The same where normals count.
  bool is_bent_in_u() const
  {
    return is_told_by_middle() && twist_u != twist_v ? twist_u > twist_v : half_u > half_v;
  }
  double bend() const { return std::max(std::abs(most), std::abs(least)); }
};

/// Derivatives of a field at a point or over a cell, in a frame of the surface: V is double or OverCell.
template <class V>
struct FieldTensors {
  std::array<V, 3> d1;
  std::array<std::array<V, 3>, 3> d2;
  std::array<std::array<std::array<V, 3>, 3>, 3> d3;
};

/// Second fundamental form b and derivative c of the normal curvature along geodesics, in an orthonormal
/// basis e1, e2 of the tangents: with g = |grad f| and n = grad f/g,
///   b(w,w) = D2f[w,w]/g,   c(w,w,w) = D3f[w,w,w]/g - 3 D2f[w,n] D2f[w,w]/g^2.
/// The second is the first's derivative along x' = w, x'' = -b(w,w) n.
template <class V>
struct SurfaceForms {
  std::array<V, 3> n;
  V b11, b12, b22;
  V c111, c112, c122, c222;
};

template <class V>
V dot(const std::array<V, 3>& a, const std::array<V, 3>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class V>
std::array<V, 3> times(const std::array<std::array<V, 3>, 3>& m, const std::array<V, 3>& w)
{
  return {dot(m[0], w), dot(m[1], w), dot(m[2], w)};
}
/// sum_k t_ijk w_k of a symmetric t.
template <class V>
std::array<std::array<V, 3>, 3> times(const std::array<std::array<std::array<V, 3>, 3>, 3>& t,
                                      const std::array<V, 3>& w)
{
  std::array<std::array<V, 3>, 3> m;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) m[j][i] = m[i][j] = dot(t[i][j], w);
  return m;
}

/// The forms in the basis that the shortest rotation from e_z to the normal makes of e_x and e_y.
template <bool with_change, class V>
SurfaceForms<V> surface_forms(const FieldTensors<V>& f)
{
  using std::sqrt;
  const V by = 1.0 / sqrt(square(f.d1[0]) + square(f.d1[1]) + square(f.d1[2]));
  const std::array<V, 3> n{f.d1[0] * by, f.d1[1] * by, f.d1[2] * by};
  const V lean = 1.0 / (n[2] + 1.0), p0 = n[0] * lean, p1 = n[1] * lean, cross = -(n[0] * p1);
  const std::array<V, 3> e1{1.0 - n[0] * p0, cross, -n[0]}, e2{cross, 1.0 - n[1] * p1, -n[1]};
  const std::array<V, 3> h1 = times(f.d2, e1), h2 = times(f.d2, e2);
  SurfaceForms<V> s{n, dot(e1, h1) * by, dot(e2, h1) * by, dot(e2, h2) * by, V(0.0), V(0.0), V(0.0), V(0.0)};
  if constexpr (with_change) {
    const V a1 = dot(n, h1) * by, a2 = dot(n, h2) * by;
    const auto q1 = times(f.d3, e1), q2 = times(f.d3, e2);
    const std::array<V, 3> q11 = times(q1, e1), q12 = times(q1, e2), q22 = times(q2, e2);
    s.c111 = dot(e1, q11) * by - a1 * s.b11 * 3.0;
    s.c112 = dot(e2, q11) * by - (a1 * s.b12 * 2.0 + a2 * s.b11);
    s.c122 = dot(e2, q12) * by - (a2 * s.b12 * 2.0 + a1 * s.b22);
    s.c222 = dot(e2, q22) * by - a2 * s.b22 * 3.0;
  }
  return s;
}

/// The largest |c(w,w,w)| of unit w, at most 2 % too large: a trigonometric polynomial of degree m that is
/// sampled at N equal steps of a turn exceeds its largest sample by at most 1/cos(pi m/N) (Ehlich and Zeller
/// 1964, Schwankung von Polynomen zwischen Gitterpunkten). Opposite w have opposite values.
inline double largest_cubic(double c111, double c112, double c122, double c222)
{
  constexpr int half_turn = 24;
  static const std::array<std::array<double, 2>, half_turn> directions = [] {
    std::array<std::array<double, 2>, half_turn> list{};
    for (int k = 0; k < half_turn; ++k) {
      const double t = std::numbers::pi * k / half_turn;
      list[k] = {std::cos(t), std::sin(t)};
    }
    return list;
  }();
  double most = 0.0;
  for (const auto& [c, s] : directions)
    most =
        std::max(most, std::abs(c * c * (c * c111 + 3.0 * s * c112) + s * s * (3.0 * c * c122 + s * c222)));
  return most / 0.98078528040323043;  // cos(3 pi/48)
}

/// Derivatives of a field as they stand in its jet, up to the second or the third.
template <bool with_third, class S, int order>
FieldTensors<S> tensors(const Jet<S, 3, order>& f)
{
  FieldTensors<S> t;
  for (int i = 0; i < 3; ++i) {
    t.d1[i] = f.derivative(i);
    for (int j = i; j < 3; ++j) {
      t.d2[i][j] = t.d2[j][i] = f.derivative(i, j);
      if constexpr (with_third)
        for (int k = j; k < 3; ++k) {
          const S d = f.derivative(i, j, k);
          t.d3[i][j][k] = t.d3[i][k][j] = t.d3[j][i][k] = t.d3[j][k][i] = t.d3[k][i][j] = t.d3[k][j][i] = d;
        }
    }
  }
  return t;
}

/// Bounds of forms over a cell: a form is within form.c + form.a s + form.b t + e, where |e| <= form.r.
/// The largest eigenvalue and the largest |c| are convex functions of the form, the least eigenvalue is
/// concave, so that they are extreme at the four corners of (s, t). Of entries within radii r_ij of b_ij the
/// largest eigenvalue is at most that of [[b_11 + r_11, |b_12| + r_12], [|b_12| + r_12, b_22 + r_22]].
template <bool with_change>
void bound_forms(SurfaceCell& cell, const SurfaceForms<OverCell>& over)
{
  const struct {
    Affine b11, b12, b22, c111, c112, c122, c222;
  } f{Affine(over.b11),  Affine(over.b12),  Affine(over.b22), Affine(over.c111),
      Affine(over.c112), Affine(over.c122), Affine(over.c222)};
  const double off_c =
      std::sqrt(square(f.c111.r) + 3.0 * square(f.c112.r) + 3.0 * square(f.c122.r) + square(f.c222.r));
  cell.most = cell.most_at, cell.least = cell.least_at;
  if (!std::isfinite(f.b11.r + f.b12.r + f.b22.r)) {
    cell.most = std::numeric_limits<double>::infinity(), cell.least = -cell.most;
    cell.change = with_change ? cell.most : 0.0;
    return;
  }
  for (const double s : {-1.0, 1.0})
    for (const double t : {-1.0, 1.0}) {
      const auto at = [&](const Affine& x) { return x.c + s * x.a + t * x.b; };
      const double b11 = at(f.b11), b12 = at(f.b12), b22 = at(f.b22);
      const double across = std::abs(b12) + f.b12.r;
      cell.most = std::max(cell.most, SymmetricPair(b11 + f.b11.r, across, b22 + f.b22.r).larger);
      cell.least = std::min(cell.least, SymmetricPair(b11 - f.b11.r, across, b22 - f.b22.r).smaller);
      if constexpr (with_change)
        cell.change =
            std::max(cell.change, off_c + largest_cubic(at(f.c111), at(f.c112), at(f.c122), at(f.c222)));
    }
}

/// Two tangents and the unit normal n, the first tangent along `side` if that has a direction across n: lines
/// of u often are lines of curvature, and second fundamental forms whose parts are bounded apart are tighter
/// there.
inline Mat3 frame_along(const Vec3& n, const Vec3& side)
{
  const Vec3 across = side - side.dot(n) * n;
  Mat3 frame = frame_of(n);
  if (!(across.norm() > 1e-9 * (1.0 + side.norm()))) return frame;
  frame.col(0) = across.normalized();
  frame.col(1) = n.cross(frame.col(0));
  return frame;
}

/// Makes a cell. Bounds are infinite where Taylor models over it are too wide to tell.
template <class Author, bool with_change>
SurfaceCell surface_cell(const double* q, double u, double v, double half_u, double half_v)
{
  constexpr int order = with_change ? 3 : 2;
  constexpr double unknown = std::numeric_limits<double>::infinity();
  SurfaceCell cell;
  cell.u = u, cell.v = v, cell.half_u = half_u, cell.half_v = half_v;
  cell.x = chart_point<Author>(turn(u), turn(v), q);
  const FieldAt f(field_jet<Author, 2>(cell.x, q));
  const auto x =
      Chart<Author, false>::template jet<1>(turn_range(u, half_u, false), turn_range(v, half_v, true), q);
  cell.frame =
      frame_along(f.gradient / f.steep, {x[0].c[1].center(), x[1].c[1].center(), x[2].c[1].center()});
  const auto center = field_jet<Author, order, double>({cell.x[0], cell.x[1], cell.x[2]}, cell.frame, q);
  const auto at = surface_forms<with_change>(tensors<with_change>(center));
  const SymmetricPair k(at.b11, at.b12, at.b22);
  cell.most_at = k.larger, cell.least_at = k.smaller;
  cell.change_at = largest_cubic(at.c111, at.c112, at.c122, at.c222);

  const Point<OverCell> place{x[0].c[0], x[1].c[0], x[2].c[0]};
  const auto twist = [&](int side_of, double half) {
    const Vec3 side =
        half * Vec3(x[0].c[side_of].center(), x[1].c[side_of].center(), x[2].c[side_of].center());
    return f.hessian_times(side).norm() / f.steep + 0.3 * cell.bend_at() * side.norm();
  };
  cell.twist_u = twist(1, half_u), cell.twist_v = twist(2, half_v);
  cell.side_u = half_u * longest({x[0].c[1], x[1].c[1], x[2].c[1]});
  cell.side_v = half_v * longest({x[0].c[2], x[1].c[2], x[2].c[2]});
  const auto along = [&](double sign, int i) { return x[i].c[1] * half_u + x[i].c[2] * (sign * half_v); };
  cell.path = std::max(longest({along(1.0, 0), along(1.0, 1), along(1.0, 2)}),
                       longest({along(-1.0, 0), along(-1.0, 1), along(-1.0, 2)}));
  const auto over = field_jet<Author, order, OverCell>(place, cell.frame, q);
  const auto forms = surface_forms<with_change>(tensors<with_change>(over));
  bound_forms<with_change>(cell, forms);
  cell.turn = std::min(cell.bend() * cell.path, longest({forms.n[0], forms.n[1], forms.n[2] - 1.0}));
  if (!std::isfinite(cell.turn)) cell.turn = unknown;
  if (!std::isfinite(cell.path)) cell.path = unknown;
  if (!std::isfinite(cell.most + cell.least)) cell.most = unknown, cell.least = -unknown;
  if (!std::isfinite(cell.change)) cell.change = unknown;
  return cell;
}

}  // namespace hauberk::kit
