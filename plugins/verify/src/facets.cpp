#include "facets.hpp"

#include "surface.hpp"

#include <hauberk/solid.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hauberk::verification {
namespace {

using Triangle = std::array<Vec3, 3>;

struct Ball {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;
};

Ball ball_of(const std::vector<Vec3>& points)
{
  Ball out;
  for (const Vec3& p : points) out.center += p / static_cast<double>(points.size());
  for (const Vec3& p : points) out.radius = std::max(out.radius, (p - out.center).norm());
  return out;
}

/// Triangles that lie together: of a tube those between two neighbouring sections of its tube.
struct Sector {
  std::vector<Triangle> triangles;
  std::vector<Ball> balls;  ///< of the triangles
  Ball ball;
};

Sector sector_of(std::vector<Triangle> triangles)
{
  Sector out;
  std::vector<Vec3> all;
  for (const Triangle& t : triangles) {
    out.balls.push_back(ball_of({t[0], t[1], t[2]}));
    all.insert(all.end(), t.begin(), t.end());
  }
  out.ball = ball_of(all);
  out.triangles = std::move(triangles);
  return out;
}

/// Unit vectors across a curve in the middle of each of n parts of it: the first as much along the core's
/// point as it can, carried on by the smallest rotation of one tangent to the next, which leaves an angle at
/// the end that all share.
std::vector<std::array<Vec3, 2>> frames_along(const Primitive& tube)
{
  const int n = tube.facets;
  const auto angle = [n](int i) { return 2.0 * std::numbers::pi * (i + 0.5) / n; };
  const auto tangent = [&](int i) -> Vec3 { return core_tangent(tube, angle(i % n)).normalized(); };
  const Vec3 first = tangent(0), from_middle = core_point(tube, angle(0)) - tube.place.position;
  Vec3 start = from_middle - from_middle.dot(first) * first;
  if (!(start.norm() > 1e-3 * from_middle.norm())) {
    Eigen::Index axis = 0;
    (tube.place.rotation.transpose() * first).cwiseAbs().minCoeff(&axis);
    const Vec3 other = tube.place.rotation.col(axis);
    start = other - other.dot(first) * first;
  }
  std::vector<Vec3> carried{start.normalized()};
  for (int i = 0; i < n; ++i)
    carried.emplace_back(Eigen::Quaterniond::FromTwoVectors(tangent(i), tangent(i + 1)) * carried.back());
  const double missed =
      std::atan2(carried.back().dot(carried.front().cross(first)), carried.back().dot(carried.front()));
  std::vector<std::array<Vec3, 2>> out;
  for (int i = 0; i < n; ++i) {
    // A positive angle turns the first vector to the second one, against the tangent.
    const Vec3 a = Eigen::AngleAxisd(missed * i / n, tangent(i)) * carried[i];
    out.push_back({a, a.cross(tangent(i))});
  }
  return out;
}

std::vector<Sector> tube_sectors(const Primitive& torus)
{
  const int n = torus.facets;
  const double step = 2.0 * std::numbers::pi / n;
  const auto frames = torus.curve.empty() ? std::vector<std::array<Vec3, 2>>() : frames_along(torus);
  const auto corner = [&](int i, int j) -> Vec3 {
    const double u = (i + 0.5) * step, v = std::numbers::pi + (j + 0.5) * step;
    if (torus.curve.empty()) return surface_point(torus, u, v);
    const auto& [a, b] = frames[i % n];
    return core_point(torus, u) + torus.r0 * (std::cos(v) * a + std::sin(v) * b);
  };
  std::vector<Sector> out;
  for (int i = 0; i < n; ++i) {
    std::vector<Triangle> triangles;
    for (int j = 0; j < n; ++j) {
      const Vec3 a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
    out.push_back(sector_of(std::move(triangles)));
  }
  return out;
}

/// Strips of a solid's chart between two neighbouring values of u. A row of points that are all one is a
/// pole: of a chart with two, at v = 0 and pi, the half between them is the surface, cut into n/2 rows.
std::vector<Sector> chart_sectors(const Primitive& body)
{
  const int n = body.facets;
  const double step = 2.0 * std::numbers::pi / n;
  const auto at = [&](double u, double v) -> Vec3 {
    return body.place.position + body.place.rotation * body.solid->surface_point({std::cos(u), std::sin(u),
                                                                                  std::cos(v), std::sin(v)});
  };
  double spread = 0.0;
  for (int i = 1; i < n; ++i) spread = std::max(spread, (at(i * step, 0.0) - at(0.0, 0.0)).norm());
  const bool poles = spread <= 1e-9 * body.solid->radius();
  std::vector<double> rows;
  if (poles) {
    const int count = std::max(2, (n + 1) / 2);
    for (int j = 0; j <= count; ++j) rows.push_back(std::numbers::pi * j / count);
  } else {
    for (int j = 0; j <= n; ++j) rows.push_back(std::numbers::pi + (j + 0.5) * step);
  }
  std::vector<Sector> out;
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) * step, next = (i + 1.5) * step;
    std::vector<Triangle> triangles;
    const std::size_t last = rows.size() - 1;
    for (std::size_t j = poles ? 1 : 0; j < (poles ? last - 1 : last); ++j) {
      const Vec3 a = at(u, rows[j]), b = at(next, rows[j]), c = at(next, rows[j + 1]), d = at(u, rows[j + 1]);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
    if (poles) {
      triangles.push_back({at(0.0, 0.0), at(next, rows[1]), at(u, rows[1])});
      triangles.push_back({at(0.0, rows[last]), at(u, rows[last - 1]), at(next, rows[last - 1])});
    }
    out.push_back(sector_of(std::move(triangles)));
  }
  return out;
}

/// Halves a list across the longest side of its box until few triangles are left.
void add_sectors(std::vector<Triangle> triangles, std::vector<Sector>& out)
{
  constexpr std::size_t few = 24;
  if (triangles.size() <= few) {
    out.push_back(sector_of(std::move(triangles)));
    return;
  }
  Vec3 low = triangles[0][0], high = low;
  for (const Triangle& t : triangles) {
    for (const Vec3& x : t) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  std::sort(triangles.begin(), triangles.end(), [axis](const Triangle& a, const Triangle& b) {
    return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
  });
  const auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
  add_sectors({triangles.begin(), middle}, out);
  add_sectors({middle, triangles.end()}, out);
}

std::vector<Sector> sectors(const Primitive& torus)
{
  if (torus.solid) return chart_sectors(torus);
  if (!torus.surface) return tube_sectors(torus);
  std::vector<Triangle> triangles;
  for (const auto& t : torus.surface->triangles) {
    Triangle& placed = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      placed[k] = torus.place.position + torus.place.rotation * (torus.R * torus.surface->points[t[k]]);
  }
  std::vector<Sector> out;
  add_sectors(std::move(triangles), out);
  return out;
}

double apart(const Ball& a, const Ball& b) { return (a.center - b.center).norm() - a.radius - b.radius; }

double point_segment(const Vec3& x, const Vec3& a, const Vec3& b)
{
  const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - t * (b - a)).norm();
}

/// The foot of the perpendicular if it lies inside, else the nearest side.
double point_triangle(const Vec3& x, const Triangle& t)
{
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = t[k], &b = t[(k + 1) % 3];
    inside = inside && normal.dot((b - a).cross(x - a)) >= 0.0;
    nearest = std::min(nearest, point_segment(x, a, b));
  }
  return inside ? std::abs(normal.dot(x - t[0])) : nearest;
}

/// The common perpendicular if both its feet lie inside, else the nearest of the four ends.
double segment_segment(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const double ends = std::min(
      {point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b), point_segment(d, a, b)});
  const Vec3 p = b - a, q = d - c, n = p.cross(q), r = c - a;
  const double nn = n.squaredNorm();
  if (nn < 1e-24 * p.squaredNorm() * q.squaredNorm()) return ends;
  const double s = r.cross(q).dot(n) / nn, t = r.cross(p).dot(n) / nn;
  return s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 ? std::abs(r.dot(n)) / std::sqrt(nn) : ends;
}

/// How far the nearer end of a segment is behind the plane of a triangle that it goes through, else 0.
double piercing(const Vec3& a, const Vec3& b, const Triangle& t)
{
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  const double ha = normal.dot(a - t[0]), hb = normal.dot(b - t[0]);
  if (ha * hb >= 0.0) return 0.0;
  const Vec3 x = a + ha / (ha - hb) * (b - a);
  for (std::size_t k = 0; k < 3; ++k)
    if (normal.dot((t[(k + 1) % 3] - t[k]).cross(x - t[k])) < 0.0) return 0.0;
  return std::min(std::abs(ha), std::abs(hb));
}

double triangle_separation(const Triangle& a, const Triangle& b)
{
  double nearest = std::numeric_limits<double>::infinity(), deepest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t k1 = (k + 1) % 3;
    nearest = std::min({nearest, point_triangle(a[k], b), point_triangle(b[k], a)});
    deepest = std::max({deepest, piercing(a[k], a[k1], b), piercing(b[k], b[k1], a)});
    for (std::size_t l = 0; l < 3; ++l)
      nearest = std::min(nearest, segment_segment(a[k], a[k1], b[l], b[(l + 1) % 3]));
  }
  return deepest > 0.0 ? -deepest : nearest;
}

/// True if x is inside of a closed mesh: its triangles, seen from x, fill the whole sphere (van Oosterom,
/// Strackee 1983).
bool inside(const std::vector<Sector>& mesh, const Vec3& x)
{
  double angle = 0.0;
  for (const Sector& sector : mesh) {
    for (const Triangle& t : sector.triangles) {
      const Vec3 a = t[0] - x, b = t[1] - x, c = t[2] - x;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      angle +=
          2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
  }
  return std::abs(angle) > 2.0 * std::numbers::pi;
}

}  // namespace

double mesh_separation(const Primitive& a, const Primitive& b)
{
  const std::vector<Sector> first = sectors(a), second = sectors(b);
  struct Candidate {
    double bound;
    const Sector *a, *b;
  };
  std::vector<Candidate> candidates;
  for (const Sector& p : first)
    for (const Sector& q : second) candidates.push_back({apart(p.ball, q.ball), &p, &q});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& x, const Candidate& y) { return x.bound < y.bound; });
  double nearest = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    if (c.bound > std::max(nearest, 0.0)) break;
    for (std::size_t i = 0; i < c.a->triangles.size(); ++i)
      for (std::size_t j = 0; j < c.b->triangles.size(); ++j)
        if (apart(c.a->balls[i], c.b->balls[j]) <= std::max(nearest, 0.0))
          nearest = std::min(nearest, triangle_separation(c.a->triangles[i], c.b->triangles[j]));
  }
  const bool within =
      nearest > 0.0 && (inside(second, first[0].triangles[0][0]) || inside(first, second[0].triangles[0][0]));
  return within ? -nearest : nearest;
}

double mesh_distance(const Primitive& torus, const Vec3& x)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const Sector& sector : sectors(torus)) {
    if ((x - sector.ball.center).norm() - sector.ball.radius > nearest) continue;
    for (const Triangle& t : sector.triangles) nearest = std::min(nearest, point_triangle(x, t));
  }
  return nearest;
}

double mesh_excess(const Primitive& torus)
{
  return (torus.R + torus.r0) * (1.0 - std::cos(std::numbers::pi / torus.facets));
}

}  // namespace hauberk::verification
