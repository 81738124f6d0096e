#include "mesh.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <utility>

namespace hauberk {
namespace {

constexpr double smallest_scale = 1e-12;
constexpr double largest_scale = 1e12;

/// Middle of the box around all points that triangles have.
Vec3 middle(const MeshFile& file)
{
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  bool first = true;
  for (const auto& t : file.triangles) {
    for (const int k : t) {
      const Vec3& x = file.points.at(static_cast<std::size_t>(k));
      low = first ? x : Vec3(low.cwiseMin(x));
      high = first ? x : Vec3(high.cwiseMax(x));
      first = false;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

Mesh::Mesh(MeshFile file)
    : parameters_{{"scale", "1", 1.0, smallest_scale, largest_scale, "length of a unit of the file", true}},
      center_(middle(file))
{
  for (Vec3& x : file.points) x -= center_;
  surface_ = std::make_shared<const TriangleSurface>(std::move(file.points), std::move(file.triangles));
}

void Mesh::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  Primitive mesh;
  mesh.name = "mesh";
  mesh.kind = PrimitiveKind::triangle_mesh;
  mesh.position = p[0] * center_;
  mesh.size.fill(p[0] * surface_->mean_distance());
  mesh.surface = surface_;
  out.assign(1, std::move(mesh));
}

void Mesh::do_jacobians(std::span<const double> /*p*/, std::vector<PrimitiveJacobian>& out) const
{
  out.assign(1, {center_.x(), center_.y(), center_.z(), surface_->mean_distance(), 0.0, 0.0});
}

void mesh_fields(std::vector<Field>& out)
{
  Field file;
  file.name = "file";
  file.kind = Field::Kind::string;
  file.unit = "file";
  file.required = true;
  file.doc =
      "A closed surface of triangles: Wavefront OBJ (.obj) or STL (.stl), relative to the experiment's "
      "folder. The solver's contact must be mesh.";
  out.push_back(std::move(file));
}

std::unique_ptr<Shape> make_mesh(const Node& section, Problems& problems)
{
  const Node& file = section.at("file");
  try {
    return std::make_unique<Mesh>(read_mesh_file(file.string));
  } catch (const InputError& error) {
    const std::string what = error.what();
    // Readers name the file and the line, surfaces do not know them.
    problems.add(file, what.starts_with(file.string) ? what : file.string + ": " + what);
  }
  return nullptr;
}

}  // namespace hauberk
