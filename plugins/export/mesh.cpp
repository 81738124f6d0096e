#include "export/mesh.hpp"

#include "export/chart_mesh.hpp"
#include "export/distance_field.hpp"
#include "geometry/closed_curve.hpp"
#include "geometry/facets.hpp"
#include "geometry/joined.hpp"
#include "geometry/thinnest_wall.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>
#include <hauberk/triangle_surface.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace hauberk::exporting {
namespace {

/// Rays through a surface of triangles.
constexpr double rays_of_surface = 200.0, most_tests = 1e8;

double thinnest_wall(const TriangleSurface& surface)
{
  const double triangles = static_cast<double>(surface.triangles().size());
  return hauberk::thinnest_wall(
      surface.points(), surface.triangles(),
      static_cast<std::size_t>(std::clamp(most_tests / triangles, 1.0, rays_of_surface)));
}

constexpr double pi = std::numbers::pi;
constexpr double most_triangles = 5e6;  ///< of one element

/// Number of chords of a circle of this radius that leave it by at most `chord`.
int chords_of_circle(double radius, double chord)
{
  const double half = std::acos(std::max(-1.0, 1.0 - chord / radius));
  return std::max(6, static_cast<int>(std::min(1e6, std::ceil(pi / std::max(half, 1e-6)))));
}

/// Rings around u, each of points around v, closed both ways.
void add_torus(Mesh& mesh, const Primitive& p, double chord)
{
  const double outer = p.R() + p.r0(), tube = std::max(p.r0(), p.r1());
  const int nu = chords_of_circle(outer, 0.5 * chord), nv = chords_of_circle(tube, 0.5 * chord);
  if (2.0 * nu * nv > most_triangles) refuse_chord(2.0 * nu * nv, chord);
  const int first = static_cast<int>(mesh.points.size());
  for (int i = 0; i < nu; ++i) {
    const double u = 2.0 * pi * i / nu;
    for (int j = 0; j < nv; ++j) {
      const double v = 2.0 * pi * j / nv, rho = p.R() + p.r0() * std::cos(v);
      mesh.points.push_back(p.position +
                            p.rotation * Vec3(rho * std::cos(u), rho * std::sin(u), p.r1() * std::sin(v)));
    }
  }
  close_both_ways(mesh, first, nu, nv);
}

/// What the kernel's contact of meshes takes for the surface.
Mesh from_facets(const Facets& facets)
{
  Mesh mesh;
  mesh.points = facets.points();
  mesh.triangles.reserve(facets.triangles().size());
  for (const Facets::Triangle& t : facets.triangles()) mesh.triangles.push_back(t.points);
  turn_outwards(mesh);
  return mesh;
}

void add_facets(Mesh& mesh, const Primitive& p, double chord)
{
  if (p.surface) return append(mesh, from_facets(Facets(*p.surface, p.R())), p.rotation, p.position);
  const ClosedCurve curve(p.curve, 1.0);
  const double length = 2.0 * pi * curve.first(), bend = std::max(1e-9, curve.tightest_bend() + p.r0());
  const int n = std::max(chords_of_circle(p.r0(), 0.5 * chord),
                         static_cast<int>(std::min(1e6, std::ceil(length / std::sqrt(4.0 * chord * bend)))));
  if (2.0 * n * n > most_triangles) refuse_chord(2.0 * n * n, chord);
  append(mesh, from_facets(Facets(curve, p.r0(), n)), p.rotation, p.position);
}

/// Groups of primitives that hang together.
std::vector<std::vector<Primitive>> overlapping_groups(std::span<const Primitive> primitives)
{
  std::vector<std::vector<Primitive>> groups;
  for (const std::vector<int>& group : joined_primitives(primitives)) {
    auto& of = groups.emplace_back();
    for (const int k : group) of.push_back(primitives[k]);
  }
  return groups;
}

}  // namespace

double volume(const Mesh& mesh)
{
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    sum += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]]));
  return sum / 6.0;
}

void append(Mesh& mesh, const Mesh& other, const Mat3& rotation, const Vec3& position)
{
  const int first = static_cast<int>(mesh.points.size());
  for (const Vec3& x : other.points) mesh.points.push_back(position + rotation * x);
  for (const auto& t : other.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

std::vector<Vec3> point_normals(const Mesh& mesh)
{
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3 n = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    for (const int k : t) normals[k] += n;
  }
  for (Vec3& n : normals) n = n.norm() > 0.0 ? Vec3(n.normalized()) : Vec3::UnitZ();
  return normals;
}

void close_both_ways(Mesh& mesh, int first, int nu, int nv)
{
  const auto at = [&](int i, int j) { return first + (i % nu) * nv + j % nv; };
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
}

void turn_outwards(Mesh& mesh)
{
  if (volume(mesh) >= 0.0) return;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

void refuse_chord(double triangles, double chord)
{
  throw InputError(fmt::format(
      "--chord {:g}: one element would take {:.2g} triangles, more than {:.0g}; give a larger chord", chord,
      triangles, most_triangles));
}

double wire_radius(std::span<const Primitive> primitives)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Primitive& p : primitives) {
    const double r = p.surface ? 0.5 * thinnest_wall(*p.surface) * p.R()
                     : p.solid ? 0.5 * thinnest_wall(*p.solid)
                               : std::min(p.r0(), p.r1());
    least = std::min(least, r);
  }
  return least;
}

double sharpest_radius(std::span<const Primitive> primitives)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Primitive& p : primitives)
    least = std::min(least, p.solid ? p.solid->thickness() : std::min(p.r0(), p.r1()));
  return least;
}

Mesh element_mesh(std::span<const Primitive> primitives, double chord)
{
  Mesh mesh;
  for (const std::vector<Primitive>& group : overlapping_groups(primitives)) {
    const Primitive& first = group.front();
    const std::optional<Mesh> by_chart =
        group.size() == 1 && first.solid ? chart_mesh(*first.solid, chord, most_triangles) : std::nullopt;
    if (group.size() == 1 && first.kind <= PrimitiveKind::revolved_ellipse)
      add_torus(mesh, first, chord);
    else if (by_chart)
      append(mesh, *by_chart, first.rotation, first.position);
    else if (group.size() == 1 && !first.solid)
      add_facets(mesh, first, chord);
    else
      append(mesh, zero_set(group, chord, most_triangles), Mat3::Identity(), Vec3::Zero());
  }
  return mesh;
}

}  // namespace hauberk::exporting
