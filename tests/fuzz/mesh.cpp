/// Files of triangle meshes: any bytes are a closed surface or are refused in words. The first byte says
/// which format: even OBJ, odd STL.

#include "mesh.hpp"
#include "harness.hpp"

#include <hauberk/error.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace hauberk;
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    MeshFile file = data[0] % 2 == 0 ? read_obj(bytes, "a.obj") : read_stl(bytes, "a.stl");
    const int count = static_cast<int>(file.points.size());
    for (const std::array<int, 3>& triangle : file.triangles) {
      for (const int corner : triangle) {
        if (corner < 0 || corner >= count) {
          std::fprintf(stderr, "mesh: a corner that is no point\n");
          std::abort();
        }
      }
    }
    const Mesh mesh(std::move(file));
    const double scale[] = {1.0};
    static_cast<void>(mesh.primitives(scale));
  } catch (const InputError& error) {
    if (std::string(error.what()).empty()) {
      std::fprintf(stderr, "mesh: an error without a message\n");
      std::abort();
    }
  }
  return 0;
}
