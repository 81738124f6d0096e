#pragma once
/// Files of triangles from any program.

#include <hauberk/linalg.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk::inspecting {

/// Triangles that hang together, which may still be no closed surface.
struct Part {
  std::string name;  ///< that of the file, if it has names; may be empty
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::size_t object = 0;  ///< number of the object that it is part of
};

struct ModelFile {
  std::string unit;  ///< empty where the format does not name it
  std::vector<Part> parts;
  std::size_t objects =
      1;  ///< that a slicer moves as one each: meshes that the items of a 3MF place, numbered from 0
};

/// Reads a file whose name ends in .stl, .obj or .3mf, in any case. Corners at the same place are one point;
/// parts are what hangs together by points, in the order of their first triangles. Throws InputError that
/// begins with the path, where it cannot be read, holds no triangles, or is larger than `most_megabytes` or
/// `most_triangles`.
ModelFile read_model_file(const std::string& path);

inline constexpr int most_megabytes = 512;
inline constexpr std::size_t most_triangles = 10000000;

/// The model of a 3MF archive: its items, each with its objects and their components placed. Throws
/// InputError that begins with `name`; also where the program was built without libzip and expat.
ModelFile read_three_mf(std::string_view bytes, const std::string& name);

/// Cuts a mesh into what hangs together, and appends that.
void append_parts(const Part& mesh, std::vector<Part>& parts);

}  // namespace hauberk::inspecting
