/// What the kernel makes of a shape's primitives, against surfaces that are put together here from their
/// equations: only positions and sizes are taken from the plugin, so a surface that meets itself, or a kind
/// that does not fit, shows here.

#include "checks.hpp"
#include "contact/mesh.hpp"
#include "geometry/body.hpp"
#include "geometry/facets.hpp"
#include "geometry/separation.hpp"
#include "solid_checks.hpp"

#include <hauberk/triangle_surface.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::conformance {
namespace {

using std::numbers::pi;
constexpr double surface_rounding =
    1e-12;  ///< of equal lengths from different arithmetic, relative to the surface

/// Core of a tube and the plane across it: a point and two orthonormal vectors.
struct Station {
  Vec3 x, first, second;
};

/// x(u) of the core and x'(u), in the primitive's frame. Of rings a circle about z.
struct CorePoint {
  Vec3 x, derivative;
};

CorePoint core_at(const Primitive& primitive, double u)
{
  if (primitive.curve.empty())
    return {primitive.R() * Vec3(std::cos(u), std::sin(u), 0.0),
            primitive.R() * Vec3(-std::sin(u), std::cos(u), 0.0)};
  CorePoint out{Vec3::Zero(), Vec3::Zero()};
  double k = 0.0;
  for (const Harmonic& h : primitive.curve) {
    k += 1.0;
    out.x += std::cos(k * u) * h.c + std::sin(k * u) * h.s;
    out.derivative += k * (std::cos(k * u) * h.s - std::sin(k * u) * h.c);
  }
  return out;
}

/// `count` stations around the core. Rings have the radial direction and z, as paper eq. (1); along curves
/// the plane is carried by the rotation that takes each tangent to the next, and what it lacks of closing
/// after one turn is spread evenly.
std::vector<Station> stations(const Primitive& primitive, int count)
{
  std::vector<Station> out;
  out.reserve(count);
  const CorePoint start = core_at(primitive, 0.0);
  const Vec3 tangent = start.derivative.normalized();
  const bool ring = primitive.curve.empty();
  const Vec3 first = ring ? Vec3(start.x.normalized()) : Vec3(tangent.unitOrthogonal());
  Vec3 before = tangent;
  Vec3 carried = first;
  for (int i = 0; i < count; ++i) {
    const CorePoint here = core_at(primitive, 2.0 * pi * i / count);
    carried = ring ? Vec3(here.x.normalized())
                   : Vec3(Eigen::Quaterniond::FromTwoVectors(before, here.derivative) * carried);
    before = here.derivative.normalized();
    out.push_back({here.x, carried, carried.cross(before)});
  }
  if (ring) {
    for (Station& s : out) s.second = Vec3::UnitZ();
    return out;
  }
  carried = Eigen::Quaterniond::FromTwoVectors(before, tangent) * carried;
  const double lacking = std::atan2(-carried.dot(first.cross(tangent)), carried.dot(first));
  for (int i = 0; i < count; ++i) {
    Station& s = out[i];
    const double turn = lacking * i / count;
    const Vec3 a = std::cos(turn) * s.first + std::sin(turn) * s.second;
    s.second = std::cos(turn) * s.second - std::sin(turn) * s.first;
    s.first = a;
  }
  return out;
}

/// Points of the surface in the primitive's frame, n stations of n points.
std::vector<Vec3> surface_points(const Primitive& primitive, int n)
{
  if (primitive.solid) return solid_points(*primitive.solid, n);
  std::vector<Vec3> out;
  out.reserve(n * n);
  for (const Station& s : stations(primitive, n)) {
    for (int j = 0; j < n; ++j) {
      const double v = 2.0 * pi * j / n;
      out.push_back(s.x + primitive.r0() * std::cos(v) * s.first + primitive.r1() * std::sin(v) * s.second);
    }
  }
  return out;
}

/// Longest diagonal of the cells of a grid of n x n points: no point of the surface is farther from the
/// nearest of them than half of it, but for its curvature.
double longest_diagonal(const std::vector<Vec3>& points, int n)
{
  double longest = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3& here = points[i * n + j];
      for (const int side : {1, n - 1})
        longest = std::max(longest, (points[((i + 1) % n) * n + (j + side) % n] - here).norm());
    }
  }
  return longest;
}

/// Volume within the triangles of a grid of n x n points that closes both ways, by the divergence theorem.
double volume_within(const std::vector<Vec3>& points, int n)
{
  const auto at = [&](int i, int j) -> const Vec3& { return points[(i % n) * n + j % n]; };
  double six = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3 &a = at(i, j), &b = at(i + 1, j), &c = at(i + 1, j + 1), &d = at(i, j + 1);
      six += a.dot(b.cross(c)) + a.dot(c.cross(d));
    }
  }
  return six / 6.0;
}

/// Pappus: the section's area times the way of its centre, exact as long as the tube does not fold.
double exact_volume(const Primitive& primitive)
{
  const double section = pi * primitive.r0() * primitive.r1();
  if (primitive.curve.empty()) return section * 2.0 * pi * primitive.R();
  const int count = 512 * static_cast<int>(primitive.curve.size());
  double length = 0.0;  // the trapezoidal rule is spectral for periodic functions
  for (int i = 0; i < count; ++i)
    length += core_at(primitive, 2.0 * pi * i / count).derivative.norm() * 2.0 * pi / count;
  return section * length;
}

/// Nearest passes of a core by itself: the smallest distance of two of its points that are farther apart
/// along it than half the turn of a circle of the tube's radius.
double nearest_pass(const Primitive& primitive)
{
  const int count = 128 * static_cast<int>(std::max<std::size_t>(2, primitive.curve.size()));
  std::vector<Vec3> x;
  std::vector<double> way{0.0};
  for (int i = 0; i < count; ++i) {
    x.push_back(core_at(primitive, 2.0 * pi * i / count).x);
    if (i > 0) way.push_back(way.back() + (x[i] - x[static_cast<std::size_t>(i) - 1]).norm());
  }
  const double length = way.back() + (x.front() - x.back()).norm();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double along = std::min(way[i] - way[j], length - (way[i] - way[j]));
      if (along > pi * primitive.r0()) nearest = std::min(nearest, (x[i] - x[j]).norm());
    }
  }
  return nearest;
}

/// A surface of triangles is closed where its triangles, as vectors, add up to nothing, and the volume within
/// them is positive and the same from everywhere; its thickness and its ball are what the kernel says.
void check_triangles(const Primitive& primitive, Trial& trial)
{
  const TriangleSurface& surface = *primitive.surface;
  Vec3 area = Vec3::Zero();
  const Vec3 from = trial.random.vector(2.0);
  double total = 0.0, six = 0.0, six_from = 0.0, sum = 0.0, farthest = 0.0;
  for (const auto& t : surface.triangles()) {
    const Vec3 &a = surface.points()[t[0]], &b = surface.points()[t[1]], &c = surface.points()[t[2]];
    const Vec3 twice = (b - a).cross(c - a);
    area += 0.5 * twice;
    total += 0.5 * twice.norm();
    six += a.dot(b.cross(c));
    six_from += (a - from).dot((b - from).cross(c - from));
  }
  for (const Vec3& x : surface.points()) {
    sum += x.norm();
    farthest = std::max(farthest, x.norm());
  }
  const double count = static_cast<double>(surface.points().size());
  require(area.norm() <= surface_rounding * count * total &&
              std::abs(six - six_from) <= surface_rounding * count * total,
          "the triangles of '{}' are not closed: their areas add up to {:.3g} of all", primitive.name,
          area.norm() / total);
  require(six > 0.0, "the triangles of '{}' point inwards: their volume is {:.6g}", primitive.name,
          six / 6.0);
  require(std::abs(sum / count - 1.0) <= surface_rounding,
          "points of '{}' have a mean distance of {:.12g}, not 1", primitive.name, sum / count);
  require(std::abs(primitive.r0() - primitive.R() * six / (3.0 * total)) <=
              surface_rounding * count * primitive.R(),
          "'{}' is said to be {:.12g} thick; twice its volume over its area is {:.12g}", primitive.name,
          primitive.r0(), primitive.R() * six / (3.0 * total));
  const double bound = make_body(primitive, 0, 0, 1.0).bound;
  require(primitive.R() * farthest <= bound * (1.0 + surface_rounding),
          "'{}' reaches {:.6g} from its centre, its bounding sphere {:.6g}", primitive.name,
          primitive.R() * farthest, bound);
}

/// A primitive in its own frame, in the unit of its size.
Body body_of(Primitive primitive)
{
  primitive.position = Vec3::Zero();
  primitive.rotation = Mat3::Identity();
  return make_body(primitive, 0, 0, 1.0);
}

/// Of solids, between two sets of parameters that the shape accepts.
void check_motions(const Shape& shape, const Point& point, Trial& trial)
{
  std::vector<double> p = point.p;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] += trial.random.between(-1.0, 1.0) * point.margin[k];
  if (refused(shape, p, trial)) return;
  const std::vector<Primitive> from = shape.primitives(point.p), to = shape.primitives(p);
  for (std::size_t k = 0; k < from.size(); ++k)
    if (from[k].solid && to[k].solid) check_motion(from[k], to[k], trial.random);
}

}  // namespace

void check_surfaces(Trial& trial)
{
  const Object object = trial.make();
  for (int draw = 0; draw < (trial.switched ? 1 : 3); ++draw) {
    const Point point = draw_point(*object.shape, trial);
    check_motions(*object.shape, point, trial);
    for (const Primitive& primitive : object.shape->primitives(point.p)) {
      if (primitive.surface) {
        check_triangles(primitive, trial);
        continue;
      }
      if (primitive.solid) {
        check_solid(primitive, trial.random);
        continue;
      }
      const double exact = exact_volume(primitive);
      const int fine = 64 * static_cast<int>(std::max<std::size_t>(1, primitive.curve.size()));
      const std::vector<Vec3> points = surface_points(primitive, fine);
      const double error = std::abs(volume_within(points, fine) / exact - 1.0);
      const double coarse_error =
          std::abs(volume_within(surface_points(primitive, fine / 2), fine / 2) / exact - 1.0);
      const double slope = std::log2(coarse_error / error);
      require(std::abs(slope - 2.0) < 0.2,
              "the volume within triangles of '{}' goes to that of the tube with slope {:.2f} (expected 2; "
              "errors {:.3g}, {:.3g}): its surface is not closed, or folds",
              primitive.name, slope, coarse_error, error);
      if (!primitive.curve.empty()) {
        const double pass = nearest_pass(primitive);
        require(
            pass > 2.0 * primitive.r0(),
            "the tube '{}' of radius {:.6g} meets itself: its core passes itself at a distance of {:.6g}; "
            "refuse such parameters",
            primitive.name, primitive.r0(), pass);
      }
      const Body body = body_of(primitive);
      double farthest = 0.0;
      for (const Vec3& x : points) farthest = std::max(farthest, x.norm());
      require(farthest <= body.bound * (1.0 + surface_rounding),
              "'{}' reaches {:.6g} from its centre, its bounding sphere {:.6g}", primitive.name, farthest,
              body.bound);
    }
  }
}

namespace {

/// Points of a surface's triangles: n (n + 1)/2 of each.
std::vector<Vec3> triangle_points(const Primitive& primitive, int n)
{
  std::vector<Vec3> out;
  const auto at = [&primitive](int k) -> Vec3 { return primitive.R() * primitive.surface->points()[k]; };
  for (const auto& t : primitive.surface->triangles()) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j)
        out.push_back((i * at(t[0]) + j * at(t[1]) + (n - i - j) * at(t[2])) / n);
    }
  }
  return out;
}

/// The smallest distance of features of two meshes, against points of their triangles: these are never
/// nearer, and where the nearest lie within some length of the nearest points, at most that much farther.
void check_mesh_distances(const Primitive& p, const Primitive& f, Trial& trial)
{
  constexpr std::size_t most_points = 4000;
  const auto with_facets = [](const Primitive& primitive) {
    Primitive own = primitive;
    own.position = Vec3::Zero();
    own.rotation = Mat3::Identity();
    Body body = make_body(own, 0, 0, 1.0);
    body.facets = std::make_shared<const Facets>(*primitive.surface, primitive.R());
    return body;
  };
  const auto sampled = [](const Primitive& primitive, double& known_to) {
    int n = 6;
    while (n > 1 && primitive.surface->triangles().size() * static_cast<std::size_t>((n + 1) * (n + 2) / 2) >
                        most_points)
      --n;
    double longest = 0.0;
    for (const auto& t : primitive.surface->triangles()) {
      for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(
            longest,
            (primitive.surface->points()[t[k]] - primitive.surface->points()[t[(k + 1) % 3]]).norm());
    }
    known_to += primitive.R() * longest / n;
    return triangle_points(primitive, n);
  };
  const Body a = with_facets(p), b = with_facets(f);
  Pose pose;
  pose.rotation = rotation_exp(trial.random.vector(2.0));
  pose.position =
      (a.bound + b.bound) * trial.random.between(0.9, 1.2) * trial.random.vector(1.0).normalized();
  const PairFrame frame(a, {}, b, pose);
  if (facets_intersect(frame)) return;
  double known_to = 0.0, nearest = std::numeric_limits<double>::infinity();
  const std::vector<Vec3> of_p = sampled(p, known_to), of_f = sampled(f, known_to);
  for (const Vec3& x : of_p) {
    for (const Vec3& y : of_f) nearest = std::min(nearest, (x - pose.position - pose.rotation * y).norm());
  }
  const double size = a.bound + b.bound;
  const double found = smallest_feature_distance(frame, 4.0 * size);
  require(found <= nearest + surface_rounding * size && nearest <= found + known_to,
          "the gap of '{}' and '{}' is {:.6g}, says the kernel; samples of their triangles are {:.6g} apart, "
          "known to {:.2g}",
          p.name, f.name, found, nearest, known_to);
}

}  // namespace

void check_distances(Trial& trial)
{
  constexpr int n = 48;
  const Object object = trial.make();
  for (int draw = 0; draw < (trial.switched ? 1 : 2); ++draw) {
    const std::vector<Primitive> primitives = object.shape->primitives(draw_point(*object.shape, trial).p);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const Primitive &p = primitives[i], &f = primitives[(i + 1) % primitives.size()];
      if (p.surface && f.surface) check_mesh_distances(p, f, trial);
      if (p.surface || f.surface) continue;  // of tori and meshes only facets of both have a distance
      const Body a = body_of(p), b = body_of(f);
      // Turned at random, a little within or beyond the least distance at which they are certainly apart.
      Pose pose;
      pose.rotation = rotation_exp(trial.random.vector(2.0));
      pose.position =
          (a.bound + b.bound) * trial.random.between(0.9, 1.2) * trial.random.vector(1.0).normalized();
      const std::vector<Vec3> of_p = surface_points(p, n), of_f = surface_points(f, n);
      double sampled = std::numeric_limits<double>::infinity();
      for (const Vec3& x : of_p) {
        for (const Vec3& y : of_f)
          sampled = std::min(sampled, (x - pose.position - pose.rotation * y).norm());
      }
      const double known_to = longest_diagonal(of_p, n) + longest_diagonal(of_f, n);
      const Separation found = separation(a, {}, b, pose, 0.0, std::numeric_limits<double>::infinity(), 0.99);
      const double size = a.bound + b.bound;
      if (found.upper <= 0.0) continue;  // they meet
      require(found.lower <= sampled + surface_rounding * size && sampled <= found.upper + known_to,
              "the gap of '{}' and '{}' is between {:.6g} and {:.6g}, says the kernel; samples of the "
              "surfaces are {:.6g} apart, known to {:.2g}",
              p.name, f.name, found.lower, found.upper, sampled, known_to);
    }
  }
}

}  // namespace hauberk::conformance
