#include "pictures/svg.hpp"

#include "document/markup.hpp"

#include <fmt/format.h>

namespace hauberk::detail {
namespace {

std::string attributes(const Stroke& stroke)
{
  std::string out = fmt::format(R"( stroke="{}" stroke-width="{:.2f}")", stroke.colour, stroke.width);
  if (!stroke.dash.empty()) out += fmt::format(R"( stroke-dasharray="{}")", stroke.dash);
  return out;
}

}  // namespace

Svg::Svg(double width, double height)
{
  body_ = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Helvetica, Arial, sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height);
}

void Svg::line(Point2 a, Point2 b, const Stroke& stroke)
{
  body_ += fmt::format(R"(<line x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}"{}/>)", a.x, a.y, b.x, b.y,
                       attributes(stroke)) +
           '\n';
}

void Svg::circle(Point2 centre, double radius, const std::string& fill, const Stroke& stroke)
{
  body_ += fmt::format(R"(<circle cx="{:.2f}" cy="{:.2f}" r="{:.2f}" fill="{}"{}/>)", centre.x, centre.y,
                       radius, fill, attributes(stroke)) +
           '\n';
}

void Svg::square(Point2 centre, double half, const std::string& fill, const Stroke& stroke)
{
  body_ += fmt::format(R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="{}"{}/>)",
                       centre.x - half, centre.y - half, 2.0 * half, 2.0 * half, fill, attributes(stroke)) +
           '\n';
}

void Svg::polygon(std::span<const Point2> points, const std::string& fill, const Stroke& stroke)
{
  std::string list;
  for (const Point2& p : points) list += fmt::format("{}{:.2f},{:.2f}", list.empty() ? "" : " ", p.x, p.y);
  body_ += fmt::format(R"(<polygon points="{}" fill="{}" stroke-linejoin="round"{}/>)", list, fill,
                       attributes(stroke)) +
           '\n';
}

void Svg::path(std::span<const Point2> points, bool closed, const Stroke& stroke)
{
  std::string d;
  for (const Point2& p : points) d += fmt::format("{}{:.2f},{:.2f}", d.empty() ? "M" : " L", p.x, p.y);
  if (closed) d += " Z";
  body_ +=
      fmt::format(R"(<path d="{}" fill="none" stroke-linejoin="round"{}/>)", d, attributes(stroke)) + '\n';
}

void Svg::text(Point2 at, std::string_view content, double size, const std::string& anchor, bool bold,
               bool halo, const std::string& colour)
{
  const std::string common =
      fmt::format(R"(<text x="{:.2f}" y="{:.2f}" font-size="{:.0f}" text-anchor="{}"{})", at.x, at.y, size,
                  anchor, bold ? R"( font-weight="bold")" : "");
  const std::string escaped = xml_escape(content);
  if (halo)
    body_ += fmt::format("{} fill=\"#fff\" stroke=\"#fff\" stroke-width=\"4\">{}</text>\n", common, escaped);
  body_ += fmt::format("{} fill=\"{}\">{}</text>\n", common, colour, escaped);
}

}  // namespace hauberk::detail
