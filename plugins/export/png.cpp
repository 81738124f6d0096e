#include "export/picture.hpp"

#include <hauberk/error.hpp>

#ifdef HAUBERK_LIBPNG
#include <png.h>
#endif

namespace hauberk::exporting {

#ifdef HAUBERK_LIBPNG
std::string png(const Raster& raster)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(raster.width);
  image.height = static_cast<png_uint_32>(raster.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  const auto write = [&](void* memory) {
    if (png_image_write_to_memory(&image, memory, &size, 0, raster.rgb.data(), 0, nullptr) == 0)
      throw ComputationError(std::string("PNG: ") + image.message);
  };
  write(nullptr);
  std::string out(size, '\0');
  write(out.data());
  out.resize(size);
  return out;
}
#else
std::string png(const Raster&)
{
  throw InputError(
      "this program was built without libpng, which pictures need; install libpng-dev and build again, or export GLB");
}
#endif

}  // namespace hauberk::exporting
