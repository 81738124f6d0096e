#include "pictures/boundary.hpp"
#include "pictures/surface_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hauberk {

std::string boundary_svg(const RunResult& run, const PlotLabels& labels,
                         const std::vector<std::string>& macro_names)
{
  constexpr double header = 62.0, size = 380.0, footer = 30.0;
  const detail::BoundaryPoints surface = detail::boundary_points(run);
  std::array<std::string, 3> names{"1", "2", "3"};
  for (std::size_t k = 0; k < names.size() && k < macro_names.size(); ++k) names[k] = macro_names[k];
  double reach = 0.0;
  for (const detail::BoundaryPoint& p : surface.points) reach = std::max(reach, p.at.cwiseAbs().maxCoeff());

  detail::Svg svg(2.0 * size, header + 2.0 * size + footer);
  svg.text({size, 28.0}, labels.title, 18, "middle", true);
  if (!labels.subtitle.empty()) svg.text({size, 48.0}, labels.subtitle, 12, "middle");
  if (!(reach > 0.0)) {
    svg.text({size, header + 20.0}, "No direction has a limit to show.", 13, "middle");
    return svg.str();
  }
  const std::array views{detail::oblique_view(), detail::plane_view(0, 1, names),
                         detail::plane_view(0, 2, names), detail::plane_view(1, 2, names)};
  for (std::size_t k = 0; k < views.size(); ++k) {
    const detail::Point2 corner{k % 2 == 0 ? 0.0 : size, k < 2 ? header : header + size};
    detail::draw_surface(svg, corner, size, views[k], surface, 1.08 * reach, names);
  }
  const auto without = std::count_if(run.limits.begin(), run.limits.end(),
                                     [](const LimitResult& l) { return l.status != LimitStatus::locked; });
  svg.text({size, header + 2.0 * size + 16.0},
           fmt::format("{}; rest at the origin; {} directions, {} of them without a locked limit",
                       labels.unit, run.limits.size(), without),
           11, "middle");
  return svg.str();
}

}  // namespace hauberk
