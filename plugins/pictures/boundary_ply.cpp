#include "document/json_text.hpp"
#include "pictures/boundary.hpp"
#include "pictures/boundary_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hauberk {
namespace {

using detail::BoundaryPoint;

std::string header(const detail::BoundaryPoints& surface, const std::string& unit,
                   const std::vector<std::string>& names)
{
  std::string out = "ply\nformat ascii 1.0\n";
  out += fmt::format("comment limits of hauberk: x y z are {}, unit {}\n", fmt::join(names, " "), unit);
  out +=
      "comment status: 0 locked, 1 unbounded, 2 not attained, 3 stalled, 4 failed, 5 interrupted, 6 not a "
      "sheet\n";
  out += "comment dx dy dz: direction of the load; limit: index in results.json\n";
  out += fmt::format("element vertex {}\n", surface.points.size());
  for (const char* name : {"x", "y", "z", "value"}) out += fmt::format("property double {}\n", name);
  out += "property uchar status\n";
  for (const char* name : {"dx", "dy", "dz"}) out += fmt::format("property double {}\n", name);
  out += "property int limit\n";
  out += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                     surface.triangles.size());
  return out;
}

}  // namespace

std::string boundary_ply(const RunResult& run, const std::string& unit,
                         const std::vector<std::string>& macro_names)
{
  const detail::BoundaryPoints surface = detail::boundary_points(run);
  std::string out = header(surface, unit, macro_names);
  for (const BoundaryPoint& p : surface.points) {
    for (const double x : {p.at.x(), p.at.y(), p.at.z(), p.value}) out += number_text(x) + ' ';
    out += fmt::format("{} ", static_cast<int>(p.status));
    for (const double x : p.direction) out += number_text(x) + ' ';
    out += fmt::format("{}\n", p.limit);
  }
  for (const Triangle& t : surface.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return out;
}

}  // namespace hauberk
