#include <hauberk/error.hpp>
#include <hauberk/load_case.hpp>

namespace hauberk {

void LoadCase::position(std::span<const double> macro, std::span<const double> e, const Vec3& X,
                        const Vec3& T, PositionMap& out) const
{
  // This call is in the innermost loops, so the checks are comparisons of sizes and one sum.
  const auto macros = static_cast<std::size_t>(macro_count());
  const auto coordinates = static_cast<std::size_t>(coordinate_count());
  if (macros > max_macro || coordinates < 1 || coordinates > max_coordinates) {
    throw PluginError("load case: declares " + std::to_string(macros) + " macroscopic unknowns (at most " +
                      std::to_string(max_macro) + ") and " + std::to_string(coordinates) +
                      " coordinates of an element (1 to " + std::to_string(max_coordinates) + ")");
  }
  if (macro.size() != macros || e.size() != coordinates) {
    throw PluginError("load case: expected " + std::to_string(macros) + " macroscopic unknowns and " +
                      std::to_string(coordinates) + " coordinates, found " + std::to_string(macro.size()) +
                      " and " + std::to_string(e.size()));
  }
  // H is large and only read when curved: whoever sets `curved` fills it.
  out.x.setZero();
  out.J.setZero();
  out.curved = false;
  do_position(macro, e, X, T, out);
  if (!out.x.allFinite() || !out.J.allFinite()) {
    throw PluginError("load case: the position of an element or its derivative is not finite");
  }
}

}  // namespace hauberk
