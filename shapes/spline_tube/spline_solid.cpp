#include "spline_solid.hpp"

#include <hauberk/kit/jet.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace hauberk {
namespace {

constexpr double turn_around = 2.0 * std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;  ///< relative, of bounds that are sums of a few terms
constexpr int stretches_per_piece = 4, parts_per_piece = 16;

std::vector<BallSpline::Point> nodes_of(std::span<const double> sizes)
{
  std::vector<BallSpline::Point> nodes;
  for (std::size_t k = 0; k + 3 < sizes.size(); k += 4)
    nodes.emplace_back(sizes[k], sizes[k + 1], sizes[k + 2], sizes[k + 3]);
  return nodes;
}

Vec3 centre(const BallSpline::Point& p) { return p.head<3>(); }

/// The sum over i >= first of size(order + i) h^i/i!, by which Taylor's formula bounds a derivative of that
/// order within h; exact, as the sixth and all further ones are 0.
template <class Size>
double taylor_sum(int order, int first, double h, const Size& size)
{
  double sum = 0.0, term = 1.0;
  for (int i = 0; order + i <= CardinalSpline::degree; ++i) {
    if (i > 0) term *= h / i;
    if (i >= first) sum += size(order + i) * term;
  }
  return sum * (1.0 + rounding);
}

template <class J>
using Triple = std::array<J, 3>;

template <class J>
J dot(const Triple<J>& a, const Triple<J>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The circle in which a ball touches the surface: all p + cos v q + sin v w.
template <class J>
struct Circle {
  Triple<J> p, q, w;

  /// Of the centre c and its derivative, the radius and its derivative, and the reference.
  Circle(const Triple<J>& c, const Triple<J>& dc, const J& r, const J& dr, const Triple<J>& a)
  {
    const J speed2 = dot(dc, dc), along = dot(a, dc) / speed2, slope = dr / speed2;
    const J across = r * sqrt(1.0 - dr * slope);
    Triple<J> n;
    for (std::size_t i = 0; i < 3; ++i) n[i] = a[i] - along * dc[i];
    const J by = across / sqrt(dot(n, n)), by_speed = by / sqrt(speed2);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      p[i] = c[i] - r * slope * dc[i];
      q[i] = by * n[i];
      w[i] = by_speed * (n[j] * dc[k] - n[k] * dc[j]);
    }
  }
};

/// The circle as a polynomial in u about a value, from derivatives in t by order and axis: t = n u/(2 pi),
/// scale = dt/du.
template <class J, class Ball, class Reference>
Circle<J> circle_jet(double scale, const Ball& ball, const Reference& reference)
{
  constexpr int order = static_cast<int>(J::size) - 1;
  const auto jet = [scale](const auto& value, int axis, int from) {
    J x;
    double factor = 1.0;
    for (int k = 0; k <= order; ++k) {
      if (k > 0) factor *= scale / k;
      x.c[k] = value(from + k, axis) * factor;
    }
    return x;
  };
  const auto triple = [&jet](const auto& value, int from) {
    return Triple<J>{jet(value, 0, from), jet(value, 1, from), jet(value, 2, from)};
  };
  return {triple(ball, 0), triple(ball, 1), jet(ball, 3, 0), jet(ball, 3, 1), triple(reference, 0)};
}

double angle(double c, double s)
{
  const double u = std::atan2(s, c);
  return u < 0.0 ? u + turn_around : u;
}

/// |x - c| - r, its derivatives in t, and what they are made of.
struct BallDistance {
  Vec3 n;  ///< from the centre to the point, unit
  double d = 0.0, value = 0.0, slope = 0.0, bend = 0.0;

  BallDistance(const BallSpline::To<2>& b, const Vec3& x)
  {
    const Vec3 way = x - centre(b[0]), speed = centre(b[1]);
    d = std::max(way.norm(), 1e-300);
    n = d > 1e-300 ? Vec3(way / d) : speed.unitOrthogonal();
    const double along = n.dot(speed);
    value = d - b[0][3];
    slope = -along - b[1][3];
    bend = (speed.squaredNorm() - along * along) / d - n.dot(centre(b[2])) - b[2][3];
  }
};

}  // namespace

Stretch::Stretch(const BallSpline& spline, int of_piece, double middle, double half_width)
    : piece(of_piece), at(middle), half(half_width), d(spline.at(of_piece, middle))
{
  const auto of_centre = [this](int k) { return d[k].head<3>().norm(); };
  const auto of_radius = [this](int k) { return std::abs(d[k][3]); };
  for (int k = 0; k < 4; ++k) {
    centre[k] = taylor_sum(k, k == 0 ? 1 : 0, half, of_centre);
    radius[k] = taylor_sum(k, k == 0 ? 1 : 0, half, of_radius);
  }
  slowest = d[1].head<3>().norm() - taylor_sum(1, 1, half, of_centre);
  thinnest = d[0][3] - radius[0];
  thickest = d[0][3] + radius[0];
}

std::vector<Stretch> stretches(const BallSpline& spline, int to_a_piece)
{
  std::vector<Stretch> all;
  for (int k = 0; k < spline.period(); ++k)
    for (int i = 0; i < to_a_piece; ++i)
      all.emplace_back(spline, k, (i + 0.5) / to_a_piece, 0.5 / to_a_piece);
  return all;
}

SplineSolid::SplineSolid(std::vector<double> sizes, std::shared_ptr<const PeriodicSpline<3>> reference)
    : sizes_(std::move(sizes)),
      reference_(std::move(reference)),
      basis_(static_cast<int>(sizes_.size() / 4)),
      spline_(basis_, nodes_of(sizes_)),
      stretches_(stretches(spline_, stretches_per_piece)),
      thinnest_(infinity)
{
  for (const Stretch& s : stretches(spline_, fine)) {
    radius_ = std::max(radius_, s.d[0].head<3>().norm() + s.centre[0] + s.thickest);
    thinnest_ = std::min(thinnest_, s.thinnest);
  }
}

std::string SplineSolid::problem() const
{
  constexpr double steepest = 0.9;
  for (const Stretch& s : stretches(spline_, fine)) {
    const int k = s.piece, next = (k + 1) % spline_.period();
    const auto names = [k, next](const char* of) {
      return fmt::format("p{}.{} and p{}.{}", k, of, next, of);
    };
    if (!(s.thinnest > 0.0))
      return fmt::format("{}: between them the radius falls to 0; give larger or more even ones", names("r"));
    if (!(s.slowest > 0.0))
      return fmt::format("{}: between these nodes the curve has a corner; give more even ones", names("x"));
    if (!(s.radius[1] <= steepest * s.slowest))
      return fmt::format(
          "{}: between them the radius changes by more than {} of the way, so that one end swallows the "
          "other; give more even ones",
          names("r"), steepest);
    const Vec3 a = reference_->at<0>(k, s.at)[0], T = s.d[1].head<3>().normalized();
    if (!((a - a.dot(T) * T).norm() >= least_across))
      return fmt::format(
          "{}: between these nodes the curve is turned too far from the nodes of the section; give nodes "
          "nearer to the parameters, or more of them",
          names("x"));
  }
  if (meets_itself(spline_))
    return "p0.r, p1.r, ...: the tube is too thick for its curve, which bends more tightly or comes closer to "
           "itself than the tube is thick";
  return {};
}

std::vector<std::string> SplineSolid::size_names() const
{
  std::vector<std::string> names;
  for (int k = 0; k < spline_.period(); ++k)
    for (const char axis : {'x', 'y', 'z', 'r'}) names.push_back(fmt::format("p{}.{}", k, axis));
  return names;
}

ProbeDerivatives SplineSolid::probe(const ProbeAngles& at) const
{
  const double scale = spline_.period() / turn_around, t = scale * angle(at.cos_u, at.sin_u);
  const auto ball = spline_.at(t);
  const auto reference = reference_->at(t);
  using J = kit::Jet<double, 1, 2>;
  const auto of = [](const auto& d) { return [&d](int order, int axis) { return d[order][axis]; }; };
  const Circle<J> c = circle_jet<J>(scale, of(ball), of(reference));
  const auto order = [](const Triple<J>& x, std::size_t k, double factorial) {
    return Vec3(x[0].c[k] * factorial, x[1].c[k] * factorial, x[2].c[k] * factorial);
  };
  const auto ring = [&](std::size_t k, double factorial, double a, double b) {
    return Vec3(a * order(c.q, k, factorial) + b * order(c.w, k, factorial));
  };
  const double cv = at.cos_v, sv = at.sin_v;
  ProbeDerivatives out;
  out.x = order(c.p, 0, 1.0) + ring(0, 1.0, cv, sv);
  out.u = order(c.p, 1, 1.0) + ring(1, 1.0, cv, sv);
  out.uu = order(c.p, 2, 2.0) + ring(2, 2.0, cv, sv);
  out.v = ring(0, 1.0, -sv, cv);
  out.uv = ring(1, 1.0, -sv, cv);
  out.vv = ring(0, 1.0, -cv, -sv);
  return out;
}

std::vector<SplineSolid::Part> SplineSolid::parts() const
{
  std::vector<Part> parts;
  using kit::Interval;
  using J = kit::Jet<Interval, 1, 3>;
  const double scale = spline_.period() / turn_around, half = 0.5 / parts_per_piece;
  const auto ranges = [half](const auto& d) {
    return [&d, half](int order, int axis) {
      const auto size = [&](int k) { return std::abs(d[k][axis]); };
      const double x = d[order][axis], off = taylor_sum(order, 1, half, size);
      return Interval(x - off - rounding * std::abs(x), x + off + rounding * std::abs(x));
    };
  };
  for (int k = 0; k < spline_.period(); ++k) {
    for (int i = 0; i < parts_per_piece; ++i) {
      const double s = (i + 0.5) / parts_per_piece;
      const BallSpline::Derivatives ball = spline_.at(k, s);
      const PeriodicSpline<3>::Derivatives reference = reference_->at(k, s);
      const Circle<J> c = circle_jet<J>(scale, ranges(ball), ranges(reference));
      Part part;
      const std::array<const Triple<J>*, 3> all{&c.p, &c.q, &c.w};
      for (std::size_t f = 0; f < 3; ++f) {
        double factorial = 1.0;
        for (std::size_t order = 0; order < 4; ++order) {
          if (order > 1) factorial *= static_cast<double>(order);
          Vec3 off;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const Interval& range = (*all[f])[axis].c[order];
            const auto a = static_cast<Eigen::Index>(axis);
            part.center[f][order][a] = range.mid() * factorial;
            off[a] = range.is_bounded() ? range.rad() * factorial : infinity;
          }
          part.off[f][order] = off.norm() * (1.0 + rounding);
        }
      }
      parts.push_back(part);
    }
  }
  return parts;
}

ProbeBounds SplineSolid::probe_bounds(double at_u, double at_v, double half_u, double half_v) const
{
  // In v the circle turns: at most S = the root of |q|^2 + |w|^2, and by Taylor's formula about at_v.
  const double cv = std::cos(at_v), sv = std::sin(at_v), h = std::min(half_v, turn_around);
  ProbeBounds b;
  const auto largest = [&](const Part& part, std::size_t u, int v, double& out) {
    const Vec3 &q = part.center[1][u], &w = part.center[2][u];
    const double S = std::sqrt(q.squaredNorm() + w.squaredNorm());
    // The v-th derivative of cos v q + sin v w, and the next.
    const std::array<Vec3, 4> turns{cv * q + sv * w, cv * w - sv * q, -cv * q - sv * w, sv * q - cv * w};
    const Vec3 none = Vec3::Zero(), &p = v == 0 ? part.center[0][u] : none;
    const double near =
        (p + turns[v]).norm() + h * turns[static_cast<std::size_t>((v + 1) % 4)].norm() + 0.5 * h * h * S;
    const double off = (v == 0 ? part.off[0][u] : 0.0) + std::hypot(part.off[1][u], part.off[2][u]);
    out = std::max(out, (std::min(near, p.norm() + S) + off) * (1.0 + rounding));
  };
  constexpr double margin = 1e-9;  // radians, of rounded angles
  const std::vector<Part>& all = parts_.get([this] { return parts(); });
  const auto count = static_cast<std::ptrdiff_t>(all.size());
  const double per_turn = static_cast<double>(count) / turn_around;
  const auto part_at = [per_turn](double u) { return static_cast<std::ptrdiff_t>(std::floor(per_turn * u)); };
  const std::ptrdiff_t first = part_at(at_u - half_u - margin);
  const std::ptrdiff_t last = std::min(part_at(at_u + half_u + margin), first + count - 1);
  for (std::ptrdiff_t k = first; k <= last; ++k) {
    const Part& part = all[static_cast<std::size_t>(((k % count) + count) % count)];
    largest(part, 1, 0, b.u), largest(part, 0, 1, b.v);
    largest(part, 2, 0, b.uu), largest(part, 1, 1, b.uv), largest(part, 0, 2, b.vv);
    largest(part, 3, 0, b.uuu), largest(part, 2, 1, b.uuv), largest(part, 1, 2, b.uvv);
    largest(part, 0, 3, b.vvv);
  }
  return b;
}

SplineSolid::Ball SplineSolid::nearest_ball(const Vec3& x) const
{
  Ball best{0.0, infinity};
  const auto seen = [&](const Stretch& s, double at) {
    const BallDistance f(spline_.at<2>(s.piece, at), x);
    if (f.value < best.value) best = {s.piece + at, f.value};
    return f;
  };
  // The least over [from, to]: where the distance is certainly convex, by Newton's method in a bracket; else
  // the half with the lower side first, unless Taylor's formula leaves nothing to be found.
  const auto refine = [&](const auto& self, const Stretch& s, double from, double to) -> void {
    double at = 0.5 * (from + to), half = 0.5 * (to - from);
    BallDistance f = seen(s, at);
    const double bend = s.centre[2] + s.radius[2];
    const double below = 1e-15 * (std::abs(best.value) + s.thickest);
    if (f.value - half * (std::abs(f.slope) + 0.5 * half * bend) >= best.value - below) return;
    const double V = s.centre[1], A = s.centre[2], d = f.d - V * half;
    const double change =
        d > 0.0 ? 6.0 * V * A / d + 3.0 * V * V * V / (d * d) + s.centre[3] + s.radius[3] : infinity;
    if (f.bend - half * change > 0.0) {
      double low = from, high = to;
      bool low_known = false, high_known = false;
      for (int step = 0; step < 60 && f.slope != 0.0; ++step) {
        (f.slope > 0.0 ? high : low) = at;
        (f.slope > 0.0 ? high_known : low_known) = true;
        double next = at - f.slope / f.bend;
        if (next <= low) next = low_known ? 0.5 * (low + high) : low;
        if (next >= high) next = high_known ? 0.5 * (low + high) : high;
        if (std::abs(next - at) <= 0x1p-53) return;
        at = next;
        f = seen(s, at);
        if ((at == from && f.slope >= 0.0) || (at == to && f.slope <= 0.0)) return;
      }
      return;
    }
    constexpr double finest = 1e-9;  // of a piece: what is left is its square
    if (half < finest) return;
    const bool left = f.slope > 0.0;
    self(self, s, left ? from : at, left ? at : to);
    self(self, s, left ? at : from, left ? to : at);
  };
  const auto low = [&x](const Stretch& s) {
    return (x - s.d[0].head<3>()).norm() - s.centre[0] - s.thickest;
  };
  const auto nearest = std::ranges::min_element(stretches_, {}, low);
  const auto refined = [&](const Stretch& s) { refine(refine, s, s.at - s.half, s.at + s.half); };
  refined(*nearest);
  for (const Stretch& s : stretches_)
    if (&s != &*nearest && low(s) < best.value) refined(s);
  // A value that is the least to rounding is so over the root of that in t, which normals would show.
  for (int step = 0; step < 4; ++step) {
    const BallDistance f(spline_.at<2>(best.t), x);
    if (!(f.bend > 0.0)) break;
    const double move = -f.slope / f.bend;
    constexpr double rounded = 1e-6;  // of a piece: farther away it was found by the search
    if (!(std::abs(move) < rounded)) break;
    best.t += move;
    if (std::abs(move) < 1e-15) break;
  }
  best.t -= spline_.period() * std::floor(best.t / spline_.period());
  best.value = BallDistance(spline_.at<2>(best.t), x).value;
  return best;
}

SolidDistance SplineSolid::distance(const Vec3& x) const
{
  // f(x) = min over t of F = |x - c| - r has the gradient n and the Hessian F_xx - F_xt F_xt^T/F_tt, where
  // F_xx = (1 - n n^T)/d and F_xt = -(c' - n n . c')/d.
  const Ball ball = nearest_ball(x);
  const auto b = spline_.at<2>(ball.t);
  const BallDistance f(b, x);
  const Vec3 speed = centre(b[1]), across = speed - f.n.dot(speed) * f.n;
  const double slide = across.norm();
  SolidDistance out;
  out.distance = out.at_least = ball.value;
  out.normal = f.n;
  out.along = slide > 1e-12 * speed.norm() ? Vec3(across / slide) : f.n.unitOrthogonal();
  out.bend_across = 1.0 / f.d;
  out.bend_along = out.bend_across - slide * slide / (f.d * f.d * std::max(f.bend, 1e-300));
  return out;
}

SolidSmoothness SplineSolid::smoothness() const
{
  return smoothness_.get([this] {
    return SolidSmoothness{(1.0 + rounding) / thinnest_, reach_bound(spline_), change_bound(spline_)};
  });
}

void SplineSolid::distance_sizes(const Vec3& x, std::span<double> out) const
{
  const double t = nearest_ball(x).t;
  const Vec3 n = BallDistance(spline_.at<2>(t), x).n;
  for (int node = 0; node < spline_.period(); ++node) {
    const double weight = basis_.at(node, t).value;
    double* const of_node = out.data() + static_cast<std::ptrdiff_t>(4) * node;
    for (int axis = 0; axis < 3; ++axis) of_node[axis] = -weight * n[axis];
    of_node[3] = -weight;
  }
}

void SplineSolid::probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const
{
  const double t = spline_.period() / turn_around * angle(at.cos_u, at.sin_u);
  const auto ball = spline_.at<1>(t);
  const Vec3 reference = reference_->at<0>(t)[0];
  // n . x by the derivative of the centre, the radius and its derivative; by the centre itself it is n.
  using J = kit::Jet<double, 5, 1>;
  Triple<J> c, dc, a;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    c[k] = J(ball[0][axis]);
    dc[k] = J::variable(ball[1][axis], axis);
    a[k] = J(reference[axis]);
  }
  const Circle<J> circle(c, dc, J::variable(ball[0][3], 3), J::variable(ball[1][3], 4), a);
  J moves(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    moves += (circle.p[k] + circle.q[k] * at.cos_v + circle.w[k] * at.sin_v) * n[axis];
  }
  for (int node = 0; node < spline_.period(); ++node) {
    const auto [weight, slope] = basis_.at(node, t);
    double* const of_node = out.data() + static_cast<std::ptrdiff_t>(4) * node;
    for (int axis = 0; axis < 3; ++axis) of_node[axis] = weight * n[axis] + slope * moves.slope(axis);
    of_node[3] = weight * moves.slope(3) + slope * moves.slope(4);
  }
}

std::shared_ptr<const Solid> SplineSolid::with_sizes(std::span<const double> sizes) const
{
  const bool right = sizes.size() == sizes_.size() &&
                     std::all_of(sizes.begin(), sizes.end(), [](double x) { return std::isfinite(x); });
  if (!right) return nullptr;
  return std::make_shared<const SplineSolid>(std::vector<double>(sizes.begin(), sizes.end()), reference_);
}

double SplineSolid::speed(std::span<const double> sizes) const
{
  if (sizes.size() != sizes_.size()) return infinity;
  std::vector<double> change(sizes.begin(), sizes.end());
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= sizes_[k];
  double fastest = 0.0;
  for (const Stretch& s : stretches(BallSpline(basis_, nodes_of(change)), fine))
    fastest = std::max(fastest, s.d[0].head<3>().norm() + s.centre[0] + std::abs(s.d[0][3]) + s.radius[0]);
  const SplineSolid other(std::vector<double>(sizes.begin(), sizes.end()), reference_);
  return fastest < std::min(smoothness().reach, other.smoothness().reach) ? fastest : infinity;
}

std::vector<std::vector<Vec3>> SplineSolid::cores() const
{
  // A chord of a k-th of a piece leaves the curve by max |c''|/(8 k^2) at most.
  std::vector<Vec3> core;
  for (int k = 0; k < spline_.period(); ++k) {
    double bend = 0.0;
    for (int i = 0; i < stretches_per_piece; ++i)
      bend = std::max(bend, stretches_[static_cast<std::size_t>(k * stretches_per_piece + i)].centre[2]);
    const int count = std::max(2, static_cast<int>(std::ceil(std::sqrt(bend / (4.0 * thinnest_)))));
    for (int i = 0; i < count; ++i)
      core.push_back(centre(spline_.at<0>(k, static_cast<double>(i) / count)[0]));
  }
  return {core};
}

std::shared_ptr<const PeriodicSpline<3>> carried_reference(std::span<const double> sizes)
{
  constexpr int steps = 64;  // per piece
  const CardinalSpline basis(static_cast<int>(sizes.size() / 4));
  const BallSpline spline(basis, nodes_of(sizes));
  const auto tangent = [&spline](int k, int i) {
    return Vec3(centre(spline.at<1>(k, static_cast<double>(i) / steps)[1]).normalized());
  };
  const auto carried = [](const Vec3& a, const Vec3& from, const Vec3& to) {
    return Vec3(Eigen::Quaterniond::FromTwoVectors(from, to) * a);
  };
  const Vec3 first = tangent(0, 0);
  // Of a flat curve the reference is the plane's normal: across the tangent and the bend, where it bends.
  const Vec3 bend = centre(spline.at<2>(0, 0.0)[2]), normal = first.cross(bend);
  const bool bends = normal.norm() > 1e-6 * bend.norm();
  std::vector<Vec3> at_node{bends ? Vec3(normal.normalized()) : Vec3(first.unitOrthogonal())},
      tangents{first};
  for (int k = 0; k < spline.period(); ++k) {
    Vec3 a = at_node.back(), T = tangents.back();
    for (int i = 1; i <= steps; ++i) {
      const Vec3 next = tangent(k, i);
      a = carried(a, T, next);
      T = next;
    }
    at_node.push_back(a);
    tangents.push_back(T);
  }
  const Vec3 &end = at_node.back(), &start = at_node.front();
  const double twist = std::atan2(first.dot(end.cross(start)), end.dot(start));
  std::vector<Vec3> nodes;
  for (int k = 0; k < spline.period(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    nodes.push_back(rotation_exp(twist * k / spline.period() * tangents[i]) * at_node[i]);
  }
  return std::make_shared<const PeriodicSpline<3>>(basis, nodes);
}

}  // namespace hauberk
