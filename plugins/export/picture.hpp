#pragma once
/// Pictures of an assembly: shaded, in parallel projection.

#include "export/fabric.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hauberk::exporting {

/// Where one looks from, degrees: azimuth counter-clockwise from -y (0: from the front), elevation above the
/// xy-plane.
struct View {
  double azimuth = 0.0, elevation = 90.0;
};

/// "top", "front", "side", "iso", or "AZIMUTH,ELEVATION". Throws InputError naming the option --view.
View view_of(const std::string& text);

/// Red, green, blue of each pixel, rows from the top.
struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Pixels per unit of length with which all of the assembly is in the picture, with a margin.
double scale_that_fits(const Assembly& assembly, const View& view, int width, int height);

/// The assembly about its middle, on white; what is beyond the picture is cut off. `scale`: pixels per unit
/// of length. Light comes over the left shoulder; depth dims. Each pixel is the mean of four. Deterministic
/// and thread safe.
Raster render(const Assembly& assembly, const View& view, int width, int height, double scale);

/// A PNG file. Throws InputError where the program was built without libpng.
std::string png(const Raster& raster);

}  // namespace hauberk::exporting
