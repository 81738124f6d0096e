#include "geometry/facets.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Edges whose angle has a smaller squared sine than this are taken for parallel: their two coordinates
/// cannot be told apart in double precision (their Gram determinant is a difference of such size), and the
/// mollifier leaves 2e-10 of them.
constexpr double parallel = 1e-13;

double norm_or(const Vec3& x, const Vec3& fallback, Vec3& unit)
{
  const double length = x.norm();
  unit = length > 0.0 ? Vec3(x / length) : fallback;
  return length;
}

/// Completes what follows from the points: the distance and its direction. With two free coordinates the
/// normal is that of both tangents, with one it is perpendicular to it: sharper than the difference of points
/// that nearly touch.
void finish(NearestFeatures& n)
{
  Vec3 r = n.on_p - n.on_f;
  std::array<Vec3, 2> t;
  for (int k = 0; k < n.free; ++k) {
    const std::size_t i = k;
    t[i] = n.tangent_p[i] - n.tangent_f[i];
  }
  if (n.free == 2) {
    Vec3 across;
    norm_or(t[0].cross(t[1]), Vec3::UnitZ(), across);
    n.normal = r.dot(across) < 0.0 ? Vec3(-across) : across;
    n.distance = std::abs(r.dot(across));
    return;
  }
  if (n.free == 1) r -= (r.dot(t[0]) / t[0].squaredNorm()) * t[0];
  n.distance = norm_or(r, Vec3::UnitZ(), n.normal);
}

/// Nearest point of a triangle to x, as weights of its corners; a weight of 0 is a bound (Ericson 2005,
/// section 5.1.5).
std::array<double, 3> triangle_weights(const Vec3& x, const std::array<Vec3, 3>& t)
{
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0];
  const Vec3 ax = x - t[0], bx = x - t[1], cx = x - t[2];
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 / (d1 - d3);
    return {1.0 - v, v, 0.0};
  }
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return {1.0 - w, 0.0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

/// The point of a triangle with these weights, and the tangents along which it is free.
struct OnTriangle {
  Vec3 at;
  int free = 0;
  std::array<Vec3, 2> tangents;
};

OnTriangle on_triangle(const std::array<Vec3, 3>& t, const std::array<double, 3>& w)
{
  OnTriangle out;
  out.at = w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
  int first = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    if (w[k] <= 0.0) continue;
    if (first < 0) {
      first = static_cast<int>(k);
      continue;
    }
    out.tangents[out.free++] = t[k] - t[first];
  }
  return out;
}

FacetPoint weighted(const std::array<int, 3>& points, const std::array<double, 3>& weights, int count)
{
  FacetPoint out;
  out.points = points;
  out.weights = weights;
  out.count = count;
  return out;
}

NearestFeatures point_triangle(const FeaturePair& pair, const Vec3& x, const std::array<Vec3, 3>& t,
                               bool point_on_p)
{
  const std::array<double, 3> w = triangle_weights(x, t);
  const OnTriangle on = on_triangle(t, w);
  NearestFeatures n;
  n.free = on.free;
  n.on_p = point_on_p ? x : on.at;
  n.on_f = point_on_p ? on.at : x;
  n.p = point_on_p ? weighted(pair.p, {1.0, 0.0, 0.0}, 1) : weighted(pair.p, w, 3);
  n.f = point_on_p ? weighted(pair.f, w, 3) : weighted(pair.f, {1.0, 0.0, 0.0}, 1);
  for (std::size_t k = 0; k < 2; ++k) {
    n.tangent_p[k] = point_on_p ? Vec3(Vec3::Zero()) : on.tangents[k];
    n.tangent_f[k] = point_on_p ? on.tangents[k] : Vec3(Vec3::Zero());
  }
  finish(n);
  return n;
}

/// Nearest points p0 + s d1, q0 + t d2 of two segments (Ericson 2005, section 5.1.9).
std::array<double, 2> segment_coordinates(const Vec3& d1, const Vec3& d2, const Vec3& r, bool& skew)
{
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), b = d1.dot(d2);
  const double c = d1.dot(r), f = d2.dot(r);
  const double det = d1.cross(d2).squaredNorm();
  skew = det > parallel * a * e;
  double s = skew ? std::clamp((b * f - c * e) / det, 0.0, 1.0) : 0.0;
  double t = (b * s + f) / e;
  if (t < 0.0) {
    t = 0.0;
    s = std::clamp(-c / a, 0.0, 1.0);
  } else if (t > 1.0) {
    t = 1.0;
    s = std::clamp((b - c) / a, 0.0, 1.0);
  }
  return {s, t};
}

NearestFeatures edge_edge(const FeaturePair& pair, const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& f)
{
  const Vec3 d1 = p[1] - p[0], d2 = f[1] - f[0];
  bool skew = false;
  const auto [s, t] = segment_coordinates(d1, d2, p[0] - f[0], skew);
  NearestFeatures n;
  n.on_p = p[0] + s * d1;
  n.on_f = f[0] + t * d2;
  n.p = weighted(pair.p, {1.0 - s, s, 0.0}, 2);
  n.f = weighted(pair.f, {1.0 - t, t, 0.0}, 2);
  const auto inside = [](double x) { return x > 0.0 && x < 1.0; };
  // Of parallel edges any pair of opposite points is nearest: one coordinate is enough.
  if (inside(t)) {
    n.tangent_p[0].setZero();
    n.tangent_f[0] = d2;
    n.free = 1;
  }
  if (inside(s) && (skew || n.free == 0)) {
    const std::size_t k = n.free++;
    n.tangent_p[k] = d1;
    n.tangent_f[k].setZero();
  }
  finish(n);
  return n;
}

}  // namespace

NearestFeatures nearest_features(const FeaturePair& pair, const std::array<Vec3, 3>& p,
                                 const std::array<Vec3, 3>& f)
{
  if (pair.edges()) return edge_edge(pair, p, f);
  return pair.p_count == 1 ? point_triangle(pair, p[0], f, true) : point_triangle(pair, f[0], p, false);
}

}  // namespace hauberk
