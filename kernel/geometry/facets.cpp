#include "geometry/facets.hpp"

#include "geometry/box_tree.hpp"
#include "geometry/closed_curve.hpp"
#include "geometry/solid_chart.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>
#include <hauberk/triangle_surface.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace hauberk {
namespace {

using std::numbers::pi;

/// Angles of section i of n, and of point j of n in a section.
double section_angle(int i, int n) { return 2.0 * pi * (i + 0.5) / n; }
double corner_angle(int j, int n) { return pi + 2.0 * pi * (j + 0.5) / n; }

/// A vector with its derivatives in the harmonics of a curve, columns.
struct Varied {
  Vec3 x;
  Eigen::Matrix3Xd d;
};

Varied normalized(const Varied& v)
{
  const double length = v.x.norm();
  const Vec3 n = v.x / length;
  return {n, (v.d - n * (n.transpose() * v.d)) / length};
}

Varied cross(const Varied& a, const Varied& b)
{
  Varied out{a.x.cross(b.x), Eigen::Matrix3Xd(3, a.d.cols())};
  for (Eigen::Index k = 0; k < a.d.cols(); ++k)
    out.d.col(k) = Vec3(a.d.col(k)).cross(b.x) + a.x.cross(Vec3(b.d.col(k)));
  return out;
}

/// What of v is across the unit vector t, of length 1.
Varied across(const Varied& v, const Varied& t)
{
  const double along = v.x.dot(t.x);
  const Eigen::RowVectorXd by = v.x.transpose() * t.d + t.x.transpose() * v.d;
  return normalized({v.x - along * t.x, v.d - along * t.d - t.x * by});
}

/// a, which is across s, turned as s turns to t (unit vectors).
Varied turned(const Varied& a, const Varied& s, const Varied& t)
{
  const double both = 1.0 + s.x.dot(t.x), part = t.x.dot(a.x) / both;
  const Eigen::RowVectorXd by = (a.x.transpose() * t.d + t.x.transpose() * a.d -
                                 part * (t.x.transpose() * s.d + s.x.transpose() * t.d)) /
                                both;
  return {a.x - part * (s.x + t.x), a.d - part * (s.d + t.d) - (s.x + t.x) * by};
}

/// Core's point and unit tangent in a section.
struct CoreSection {
  Varied x, t;
};

CoreSection core_section(const ClosedCurve& curve, double u)
{
  const auto count = static_cast<Eigen::Index>(harmonic_dofs * curve.size());
  Varied x{Vec3::Zero(), Eigen::Matrix3Xd::Zero(3, count)}, xu = x;
  for (std::size_t h = 0; h < curve.size(); ++h) {
    const Harmonic& harmonic = curve.harmonics()[h];
    const auto k = static_cast<double>(h + 1);
    const double c = std::cos(k * u), s = std::sin(k * u);
    const auto at = static_cast<Eigen::Index>(harmonic_dofs * h);
    x.x += c * harmonic.c + s * harmonic.s;
    x.d.middleCols<3>(at).diagonal().setConstant(c);
    x.d.middleCols<3>(at + 3).diagonal().setConstant(s);
    xu.x += k * (c * harmonic.s - s * harmonic.c);
    xu.d.middleCols<3>(at).diagonal().setConstant(-k * s);
    xu.d.middleCols<3>(at + 3).diagonal().setConstant(k * c);
  }
  return {x, normalized(xu)};
}

/// The first section's a: what of x is across t, or of a coordinate axis where x is along t.
Varied first_across(const CoreSection& section)
{
  constexpr double nearly_along = 1e-3;  // sine of an angle
  if (section.x.x.cross(section.t.x).norm() > nearly_along * section.x.x.norm())
    return across(section.x, section.t);
  Eigen::Index axis = 0;
  section.t.x.cwiseAbs().minCoeff(&axis);
  return across({Vec3::Unit(axis), Eigen::Matrix3Xd::Zero(3, section.x.d.cols())}, section.t);
}

/// Gives every point and edge to the first triangle that has it.
void give_features(std::vector<Facets::Triangle>& triangles, std::vector<std::array<int, 2>>& edges,
                   std::size_t point_count)
{
  std::vector<bool> owned(point_count, false);
  std::map<std::array<int, 2>, int> numbers;
  for (Facets::Triangle& t : triangles) {
    t.own_points.fill(-1);
    t.own_edges.fill(-1);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t point = t.points[k];
      if (!owned[point]) t.own_points[k] = t.points[k];
      owned[point] = true;
      const int a = t.points[k], b = t.points[(k + 1) % 3];
      const auto [at, added] =
          numbers.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(edges.size()));
      if (!added) continue;
      t.own_edges[k] = at->second;
      edges.push_back({a, b});
    }
  }
}

}  // namespace

Facets::Facets(double R, double r0, double r1, int n)
{
  const std::size_t size = n;
  points_.reserve(size * size);
  by_size_.reserve(size * size);
  for (int i = 0; i < n; ++i) {
    const double u = section_angle(i, n), cu = std::cos(u), su = std::sin(u);
    for (int j = 0; j < n; ++j) {
      const double v = corner_angle(j, n), cv = std::cos(v), sv = std::sin(v);
      Mat3 by;
      by << cu, cv * cu, 0.0, su, cv * su, 0.0, 0.0, 0.0, sv;
      points_.emplace_back(by * Vec3(R, r0, r1));
      by_size_.push_back(by);
    }
  }
  add_quadrilaterals(n);
  loops_.emplace_back();
  for (int i = 0; i < n; ++i) {
    const double u = section_angle(i, n);
    loops_[0].emplace_back(R * std::cos(u), R * std::sin(u), 0.0);
  }
  parts_ = {0};
  complete();
}

Facets::Facets(const ClosedCurve& curve, double r, int n)
{
  const std::size_t size = n;
  std::vector<CoreSection> core;
  std::vector<Varied> a;
  core.reserve(size);
  a.reserve(size + 1);
  for (int i = 0; i < n; ++i) core.push_back(core_section(curve, section_angle(i, n)));
  a.push_back(first_across(core[0]));
  for (std::size_t i = 0; i < size; ++i) {
    const Varied &s = core[i].t, &t = core[(i + 1) % size].t;
    constexpr double turns_back = 1e-2;
    if (1.0 + s.x.dot(t.x) < turns_back) {
      throw InputError("solver.facets " + std::to_string(n) +
                       " are so few that a tube's curve turns back between two sections; use more");
    }
    a.push_back(turned(a[i], s, t));
  }
  // a comes back turned by phi in the first section.
  const Varied b = cross(a[0], core[0].t), &back = a.back();
  const double along = back.x.dot(a[0].x), beside = back.x.dot(b.x), phi = std::atan2(beside, along);
  const Eigen::RowVectorXd by_phi = along * (back.x.transpose() * b.d + b.x.transpose() * back.d) -
                                    beside * (back.x.transpose() * a[0].d + a[0].x.transpose() * back.d);

  points_.reserve(size * size);
  by_size_.reserve(size * size);
  sections_.reserve(size);
  loops_.emplace_back();
  for (int i = 0; i < n; ++i) {
    const CoreSection& here = core[i];
    const Varied &ai = a[i], bi = cross(ai, here.t);
    const double part = -static_cast<double>(i) / n, c = std::cos(part * phi), s = std::sin(part * phi);
    const Varied e{c * ai.x + s * bi.x, c * ai.d + s * bi.d + (c * bi.x - s * ai.x) * (part * by_phi)};
    const Varied f = cross(e, here.t);
    for (int j = 0; j < n; ++j) {
      const double v = corner_angle(j, n);
      Mat3 by = Mat3::Zero();
      by.col(1) = std::cos(v) * e.x + std::sin(v) * f.x;
      points_.emplace_back(here.x.x + r * by.col(1));
      by_size_.push_back(by);
    }
    loops_[0].push_back(here.x.x);
    sections_.push_back({here.x.d, r * e.d, r * f.d});
  }
  add_quadrilaterals(n);
  parts_ = {0};
  complete();
}

namespace {

/// Derivatives of points of a solid's chart in its sizes, by central differences over other solids of its
/// kind: charts are smooth, so the error is that of rounding and of the third derivative, some 1e-10. At an
/// end of the sizes that there are, it is one-sided, with an error of 1e-5.
class ChartBySizes {
 public:
  explicit ChartBySizes(const Solid& solid)
  {
    constexpr double part = 1e-5;
    std::vector<double> sizes = solid.sizes();
    const std::shared_ptr<const Solid> itself = solid.with_sizes(sizes);
    for (double& size : sizes) {
      const double own = size, step = part * (own != 0.0 ? std::abs(own) : 1.0);
      Between& pair = between_.emplace_back();
      size = own + step;
      pair.above = solid.with_sizes(sizes);
      if (!pair.above) pair.above = itself, size = own;
      pair.width = size;
      size = own - step;
      pair.below = solid.with_sizes(sizes);
      if (!pair.below) pair.below = itself, size = own;
      pair.width -= size;
      size = own;
      if (!itself || pair.width == 0.0)
        throw InputError("contact \"mesh\" needs solids that know other sizes, and '" + solid.kind() +
                         "' does not: use another solver.contact");
    }
  }

  Eigen::Matrix3Xd at(const ProbeAngles& angles) const
  {
    Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(between_.size()));
    for (Eigen::Index k = 0; k < out.cols(); ++k) {
      const Between& pair = between_[k];
      out.col(k) = (pair.above->surface_point(angles) - pair.below->surface_point(angles)) / pair.width;
    }
    return out;
  }

 private:
  struct Between {
    std::shared_ptr<const Solid> below, above;
    double width = 0.0;
  };
  std::vector<Between> between_;
};

}  // namespace

Facets::Facets(const Solid& solid, double unit, int n)
{
  const ChartBySizes by_sizes(solid);
  const ChartCover cover = chart_cover(solid);
  if (cover == ChartCover::other)
    throw InputError("contact \"mesh\": the chart of '" + solid.kind() +
                     "' has poles elsewhere than at v = 0 and v = pi; use another solver.contact");
  const bool poles = cover == ChartCover::between_poles;
  const int rows = poles ? std::max(1, (n + 1) / 2 - 1) : n;
  const auto add = [&](double u, double v) {
    const ProbeAngles angles = chart_angles(u, v);
    points_.emplace_back(solid.surface_point(angles) / unit);
    by_size_.emplace_back(Mat3::Zero());
    by_own_.push_back(by_sizes.at(angles));
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < rows; ++j)
      add(section_angle(i, n), poles ? pi * (j + 1) / (rows + 1) : corner_angle(j, n));
  }
  if (poles) {
    add(0.0, 0.0);
    add(0.0, pi);
    add_rows(n, rows);
  } else {
    add_quadrilaterals(n);
  }
  for (const std::vector<Vec3>& core : solid.cores()) {
    std::vector<Vec3>& loop = loops_.emplace_back();
    for (const Vec3& x : core) loop.emplace_back(x / unit);
  }
  parts_ = {0};
  complete();
}

void Facets::add_own_sizes(int point, const Vec3& n, std::vector<double>& out) const
{
  if (!by_own_.empty()) {
    const Eigen::RowVectorXd by = n.transpose() * by_own_[point];
    out.resize(static_cast<std::size_t>(by.size()), 0.0);
    Eigen::Map<Eigen::RowVectorXd>(out.data(), by.size()) += by;
    return;
  }
  if (sections_.empty()) return;
  const auto count = static_cast<int>(sections_.size());
  const Section& section = sections_[static_cast<std::size_t>(point / count)];
  const double v = corner_angle(point % count, count), c = std::cos(v), s = std::sin(v);
  out.resize(section.x.cols(), 0.0);
  Eigen::Map<Eigen::RowVectorXd>(out.data(), section.x.cols()) +=
      n.transpose() * section.x + c * n.transpose() * section.a + s * n.transpose() * section.b;
}

void Facets::add_quadrilaterals(int n)
{
  triangles_.reserve(2 * static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int i1 = (i + 1) % n, j1 = (j + 1) % n;
      const int a = i * n + j, b = i1 * n + j, c = i1 * n + j1, d = i * n + j1;
      triangles_.push_back({{a, b, c}, {}, {}});
      triangles_.push_back({{a, c, d}, {}, {}});
    }
  }
}

void Facets::add_rows(int n, int rows)
{
  const int first_pole = n * rows, second_pole = first_pole + 1;
  for (int i = 0; i < n; ++i) {
    const int here = i * rows, next = (i + 1) % n * rows;
    triangles_.push_back({{first_pole, here, next}, {}, {}});
    for (int j = 0; j + 1 < rows; ++j) {
      triangles_.push_back({{here + j, next + j + 1, next + j}, {}, {}});
      triangles_.push_back({{here + j, here + j + 1, next + j + 1}, {}, {}});
    }
    triangles_.push_back({{second_pole, next + rows - 1, here + rows - 1}, {}, {}});
  }
}

Facets::Facets(const TriangleSurface& surface, double R) : parts_(surface.parts())
{
  points_.reserve(surface.points().size());
  by_size_.reserve(surface.points().size());
  for (const Vec3& x : surface.points()) {
    points_.emplace_back(R * x);
    Mat3 by = Mat3::Zero();
    by.col(0) = x;
    by_size_.push_back(by);
  }
  triangles_.reserve(surface.triangles().size());
  for (const auto& t : surface.triangles()) triangles_.push_back({t, {}, {}});
  loops_.reserve(surface.loops().size());
  for (const std::vector<int>& loop : surface.loops()) {
    std::vector<Vec3>& corners = loops_.emplace_back();
    corners.reserve(loop.size());
    for (const int k : loop) corners.push_back(points_[k]);
  }
  complete();
}

void Facets::complete()
{
  edges_.reserve(3 * triangles_.size() / 2);
  give_features(triangles_, edges_, points_.size());
  double sum = 0.0;
  for (const auto& [a, b] : edges_) sum += (points_[a] - points_[b]).norm();
  mean_edge_ = sum / static_cast<double>(edges_.size());

  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  for (const Triangle& t : triangles_) boxes.push_back(box_around(corners(t)));
  tree_ = std::make_unique<const Tree>(boxes);
}

Facets::~Facets() = default;

}  // namespace hauberk
