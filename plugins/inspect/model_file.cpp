#include "inspect/model_file.hpp"

#include "common/mesh_file.hpp"
#include "common/text_file.hpp"
#include "inspect/disjoint_sets.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace hauberk::inspecting {
void append_parts(const Part& mesh, std::vector<Part>& parts)
{
  DisjointSets together(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    together.join(t[0], t[1]);
    together.join(t[0], t[2]);
  }
  const std::size_t before = parts.size();
  std::vector<int> part_of(mesh.points.size(), -1), number(mesh.points.size(), -1);
  for (const auto& t : mesh.triangles) {
    int& part = part_of[together.root(t[0])];
    if (part < 0) {
      part = static_cast<int>(parts.size() - before);
      parts.push_back({mesh.name, {}, {}, mesh.object});
    }
    Part& into = parts[before + part];
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      int& own = number[t[k]];
      if (own < 0) {
        own = static_cast<int>(into.points.size());
        into.points.push_back(mesh.points[t[k]]);
      }
      corners[k] = own;
    }
    into.triangles.push_back(corners);
  }
}

ModelFile read_model_file(const std::string& path)
{
  const std::string extension = detail::ending_of(path);
  if (extension != ".stl" && extension != ".obj" && extension != ".3mf")
    throw InputError(fmt::format("{}: expected a file .stl, .obj or .3mf", path));
  std::error_code unknown;  // then reading tells
  if (!std::filesystem::exists(path, unknown))
    throw InputError(fmt::format("{}: there is no such file", path));
  ModelFile out;
  if (extension == ".3mf") {
    out = read_three_mf(detail::read_bytes(path, most_megabytes), path);
  } else {
    MeshFile mesh = read_mesh_file(path, {most_megabytes, most_triangles});
    append_parts({"", std::move(mesh.points), std::move(mesh.triangles)}, out.parts);
  }
  std::size_t triangles = 0;
  for (const Part& part : out.parts) triangles += part.triangles.size();
  if (triangles == 0) throw InputError(fmt::format("{}: has no triangles", path));
  if (triangles > most_triangles)
    throw InputError(fmt::format("{}: has {} triangles, more than {}; make the mesh coarser", path, triangles,
                                 most_triangles));
  return out;
}

}  // namespace hauberk::inspecting
