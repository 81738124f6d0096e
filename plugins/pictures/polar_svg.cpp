#include "pictures/polar_svg.hpp"

#include "pictures/profile_panels.hpp"

#include <algorithm>

namespace hauberk {

using detail::Panel;

std::string polar_svg(const RunResult& run, const PlotLabels& labels)
{
  const detail::ProfilePanels both = detail::profile_panels(run, labels);
  std::vector<const Panel*> panels;
  for (const Panel* panel : {&both.eta, &both.limits})
    if (!panel->curves.empty()) panels.push_back(panel);

  constexpr double header = 62.0, margin = 16.0;
  double height = header + 40.0;
  for (const Panel* panel : panels)
    height = std::max(height, header + detail::panel_height(panel->curves.size()));
  const double width = detail::panel_width * static_cast<double>(std::max<std::size_t>(panels.size(), 1));
  detail::Svg svg(width, height + margin);
  svg.text({width / 2.0, 28.0}, labels.title, 18, "middle", true);
  if (!labels.subtitle.empty()) svg.text({width / 2.0, 48.0}, labels.subtitle, 12, "middle");
  if (panels.empty())
    svg.text({width / 2.0, header + 20.0}, "No direction has a limit to show.", 13, "middle");
  double x = 0.0;
  for (const Panel* panel : panels) {
    detail::draw_panel(svg, {x, header}, *panel);
    x += detail::panel_width;
  }
  return svg.str();
}

}  // namespace hauberk
