#pragma once
/// Readers of triangle meshes.

#include <hauberk/linalg.hpp>
#include <hauberk/triangle_surface.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// Points in the file's unit, and triangles of their indices from 0; indices are valid. No two points are the
/// same.
struct MeshFile {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

/// What is too large to be read.
struct MeshLimits {
  int megabytes = 64;
  std::size_t triangles = TriangleSurface::most_triangles;
};

/// Reads a file whose name ends in .obj or .stl, in any case. Throws InputError that begins with the path,
/// and the line where there is one.
MeshFile read_mesh_file(const std::string& path, const MeshLimits& limits = {});

/// Wavefront OBJ: lines `v` and `f`; everything else is passed over. Faces of more than three corners are cut
/// from their first corner on, which suits convex ones. Points at the same place are one, and triangles that
/// have one twice are left out. `name`: for messages.
MeshFile read_obj(std::string_view text, const std::string& name, const MeshLimits& limits = {});

/// STL, binary or text; normals are not read. Corners at the same place are one point; if edges stay without
/// partner then, also corners that are nearer to each other than 1e-6 of the diagonal of the mesh's box.
MeshFile read_stl(std::string_view bytes, const std::string& name, const MeshLimits& limits = {});

namespace detail {

/// Joins points at the same place, in order of first mention; leaves out triangles that have one twice.
void join_equal_points(MeshFile& mesh);

/// Joins points nearer to each other than `distance`, each to the first such.
void join_near_points(MeshFile& mesh, double distance);

/// True if every edge of a triangle is that of another one in the opposite sense.
bool has_pairs_of_edges(const MeshFile& mesh);

}  // namespace detail

}  // namespace hauberk
