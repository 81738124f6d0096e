#include "pictures/svg.hpp"
#include "tasks/stability/stability_results.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

using detail::Point2;
using detail::Stroke;
using detail::Svg;

// In units of the drawing.
constexpr double cell = 30.0, gap = 2.0, method_width = 120.0, head = 26.0, foot = 34.0, margin = 16.0,
                 top = 64.0;
constexpr std::size_t columns = 2;
constexpr std::size_t longest_label = 7;  ///< that a cell has room for, in two staggered lines

struct Look {
  const char *colour, *initial, *word;
};

/// Light enough for dark text, distinct without colour by the initial.
Look look(Outcome outcome)
{
  switch (outcome) {
    case Outcome::verified:
      return {"#8fd19e", "V", "verified"};
    case Outcome::local:
      return {"#ffe08a", "L", "local: a further state is known"};
    case Outcome::honest_failure:
      return {"#b8c4d6", "F", "honest failure"};
    case Outcome::silent_wrong:
      return {"#f28b82", "W", "silently wrong"};
    case Outcome::interrupted:
      break;
  }
  return {"#ffffff", "", "not computed"};
}

void draw_cell(Svg& svg, Point2 centre, Outcome outcome)
{
  const Look as = look(outcome);
  svg.square(centre, 0.5 * (cell - gap), as.colour, Stroke{"#555", 0.6, ""});
  svg.text({centre.x, centre.y + 4.0}, as.initial, 11.0, "middle", outcome == Outcome::silent_wrong);
}

void draw_panel(Svg& svg, const StabilityMap& map, std::size_t family, Point2 corner)
{
  const StabilityFamilyResult& f = map.families[family];
  svg.text({corner.x, corner.y + 14.0}, f.name, 13.0, "start", true);
  for (std::size_t m = 0; m < map.methods.size(); ++m) {
    const double y = corner.y + head + (static_cast<double>(m) + 0.5) * cell;
    svg.text({corner.x + method_width - 8.0, y + 4.0}, map.methods[m], 11.0, "end");
    for (std::size_t k = 0; k < f.labels.size(); ++k)
      draw_cell(svg, {corner.x + method_width + (static_cast<double>(k) + 0.5) * cell, y},
                worst_outcome(map, family, k, m));
  }
  const double below = corner.y + head + static_cast<double>(map.methods.size()) * cell;
  for (std::size_t k = 0; k < f.labels.size(); ++k) {
    const double x = corner.x + method_width + (static_cast<double>(k) + 0.5) * cell;
    svg.text({x, below + (k % 2 == 0 ? 11.0 : 22.0)}, f.labels[k].substr(0, longest_label), 9.0, "middle");
  }
}

}  // namespace

std::string stability_svg(const StabilityMap& map, const std::string& title)
{
  std::size_t most = 1;
  for (const StabilityFamilyResult& f : map.families) most = std::max(most, f.labels.size());
  const double width = method_width + static_cast<double>(most) * cell + 2.0 * margin;
  const double height = head + static_cast<double>(map.methods.size()) * cell + foot;
  const std::size_t rows = (map.families.size() + columns - 1) / columns;
  Svg svg(std::max(width * static_cast<double>(columns), 720.0),
          top + height * static_cast<double>(rows) + margin);
  svg.text({margin, 24.0}, title, 16.0, "start", true);
  double x = margin;
  for (const Outcome outcome : outcomes) {
    draw_cell(svg, {x + 0.5 * cell, 46.0}, outcome);
    svg.text({x + cell + 4.0, 50.0}, look(outcome).word, 11.0);
    x += cell + 14.0 + 6.0 * static_cast<double>(std::string(look(outcome).word).size());
  }
  for (std::size_t f = 0; f < map.families.size(); ++f) {
    const std::size_t column = f % columns, row = f / columns;
    draw_panel(svg, map, f,
               {margin + width * static_cast<double>(column), top + height * static_cast<double>(row)});
  }
  return svg.str();
}

}  // namespace hauberk
