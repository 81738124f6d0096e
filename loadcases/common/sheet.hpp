#pragma once
/// What a bent sheet is no more on the scale of its elements; README.md of paraboloid_bending says why.

#include <hauberk/load_case.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <string_view>

namespace hauberk {

/// Up to where a state is a sheet: the largest curvature times the largest radius of an element, the distance
/// of linked elements along the sheet over that at rest or the mean of their radii, whichever is longer, and
/// how often a rolled sheet goes around.
inline constexpr double most_sheet_curvature = 2.0, most_sheet_stretch = 3.0, most_sheet_turns = 1.0;

/// Why a sheet whose radius of curvature `what` names is bent too tightly; empty where it is not. `curvature`
/// is the largest, in size.
inline std::string bent_too_tightly(const SheetState& state, double curvature, std::string_view what)
{
  const auto widest = std::max_element(state.radius.begin(), state.radius.end());
  if (widest == state.radius.end() || curvature * *widest < most_sheet_curvature) return {};
  return fmt::format(
      "no sheet on the scale of its elements: {} {:.3g} times that of element {}, which counts above {:g}",
      what, 1.0 / (curvature * *widest), widest - state.radius.begin(), 1.0 / most_sheet_curvature);
}

/// Why a rolled sheet, `what`, which is so long around its axis, is beside itself; empty where it is not.
inline std::string rolled_too_often(double curvature, double length, std::string_view what)
{
  const double turns = curvature * length / (2.0 * std::numbers::pi);
  if (turns < most_sheet_turns) return {};
  return fmt::format("no sheet beside itself: {} goes {:.3g} times around the roll, which counts below {:g}",
                     what, turns, most_sheet_turns);
}

/// Why linked elements parted; empty where none did. `along(i, j, T)` is the distance along the sheet, which
/// `what` names, of i and the image of j that is displaced by T at rest.
template <class Along>
std::string parted(const SheetState& state, std::string_view what, const Along& along)
{
  for (std::size_t n = 0; n < state.linked.size(); ++n) {
    const std::size_t i = state.linked[n][0], j = state.linked[n][1];
    const Vec3 T = state.translations.empty() ? Vec3::Zero() : state.translations[n];
    const double unit =
        std::max((state.X[j] + T - state.X[i]).norm(), 0.5 * (state.radius[i] + state.radius[j]));
    const double apart = along(i, j, T);
    if (apart < most_sheet_stretch * unit) continue;
    return fmt::format(
        "no sheet on the scale of its elements: along the {} the linked elements {} and {} are {:.3g} times as far "
        "apart as at rest or as their mean radius, whichever is longer, which counts below {:g}",
        what, i, j, apart / unit, most_sheet_stretch);
  }
  return {};
}

}  // namespace hauberk
