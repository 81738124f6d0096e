#include "inspect/inspection.hpp"

#include <fmt/format.h>
#include <boost/json/array.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace hauberk::inspecting {
namespace {

namespace json = boost::json;

/// More lines than anybody reads.
constexpr std::size_t most_lines = 20;

std::string counted(std::size_t count, const char* one, const char* many)
{
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// Up to `most_lines` lines, and how many more there are.
template <class Items, class Line>
std::string lines(const Items& items, const Line& line)
{
  std::string out;
  std::size_t shown = 0;
  for (const auto& item : items) {
    if (shown++ == most_lines) break;
    out += "  " + line(item) + "\n";
  }
  if (items.size() > most_lines)
    out += fmt::format("  and {} more: --json has all\n", items.size() - most_lines);
  return out;
}

std::string size_text(const std::array<Vec3, 2>& box, const std::string& unit)
{
  const Vec3 size = box[1] - box[0];
  return fmt::format("{:.4g} x {:.4g} x {:.4g}{}", size.x(), size.y(), size.z(), unit);
}

/// Bodies that look alike, as one line: rings of one size are many.
std::string bodies_text(const Inspection& inspection, const std::string& unit)
{
  struct Kind {
    std::size_t count = 0;
    const InspectedBody* first = nullptr;
  };
  std::vector<Kind> kinds;
  std::map<std::string, std::size_t> known;
  for (const InspectedBody& body : inspection.bodies) {
    if (!body.problem.empty()) continue;
    const std::string look =
        fmt::format("{} {} {:.4g} {:.3g}", body.triangles, body.handles, body.volume, body.thinnest_wall);
    const auto [entry, is_new] = known.try_emplace(look, kinds.size());
    if (is_new) kinds.push_back({0, &body});
    ++kinds[entry->second].count;
  }
  return lines(kinds, [&unit](const Kind& kind) {
    const InspectedBody& body = *kind.first;
    return fmt::format("{} of {} triangles: {}, volume {:.6g}{}, thinnest wall seen {:.4g}{}; {}: {}",
                       counted(kind.count, "body", "bodies"), body.triangles,
                       body.handles == 0 ? "no hole" : counted(body.handles, "hole", "holes"), body.volume,
                       unit.empty() ? "" : unit + "^3", body.thinnest_wall, unit,
                       kind.count == 1 ? body.name : "the first, " + body.name, size_text(body.box, unit));
  });
}

std::string links_text(const Inspection& inspection)
{
  std::vector<const InspectedBody*> loose;
  std::size_t closed = 0, least = std::numeric_limits<std::size_t>::max(), most = 0;
  for (const InspectedBody& body : inspection.bodies) {
    if (!body.problem.empty() || body.hollow) continue;
    ++closed;
    if (body.linked.empty()) loose.push_back(&body);
    least = std::min(least, body.linked.size());
    most = std::max(most, body.linked.size());
  }
  if (closed == 0) return "";
  std::string out = fmt::format("links: {}; ", counted(inspection.links.size(), "pair", "pairs"));
  out += least == most ? fmt::format("every body is linked with {}", most)
                       : fmt::format("a body is linked with {} to {}", least, most);
  out += inspection.pieces == 1
             ? "; all hang together\n"
             : fmt::format("; falls into {} pieces, unless they clasp each other without links\n",
                           inspection.pieces);
  if (closed > 1 && !loose.empty()) {
    out += fmt::format("linked with nothing: {}\n", counted(loose.size(), "body", "bodies"));
    out += lines(loose, [](const InspectedBody* body) { return body->name; });
  }
  std::vector<LinkedBodies> twisted;
  for (const LinkedBodies& link : inspection.links)
    if (link.number > 1) twisted.push_back(link);
  if (!twisted.empty()) {
    out += "linked more than once:\n";
    out += lines(twisted, [&](const LinkedBodies& link) {
      return fmt::format("{} and {}: {} times", inspection.bodies[link.bodies[0]].name,
                         inspection.bodies[link.bodies[1]].name, link.number);
    });
  }
  return out;
}

std::string gaps_text(const Inspection& inspection, double gap, const std::string& unit)
{
  if (!inspection.nearest) return "";
  const auto line = [&](const NearBodies& pair) {
    const std::string names =
        inspection.bodies[pair.bodies[0]].name + " and " + inspection.bodies[pair.bodies[1]].name;
    return pair.distance > 0.0 ? fmt::format("{:.6g}{}: {}", pair.distance, unit, names) : names + " meet";
  };
  std::string out = "smallest gap: " + line(*inspection.nearest) + "\n";
  if (!inspection.too_near.empty()) {
    out += gap > 0.0 ? fmt::format("nearer than {:g}{}: {}\n", gap, unit,
                                   counted(inspection.too_near.size(), "pair", "pairs"))
                     : fmt::format("meet: {}\n", counted(inspection.too_near.size(), "pair", "pairs"));
    out += lines(inspection.too_near, line);
  }
  if (!inspection.within.empty()) {
    out += "one within the other:\n";
    out += lines(inspection.within, [&](const std::array<int, 2>& pair) {
      return inspection.bodies[pair[0]].name + " and " + inspection.bodies[pair[1]].name;
    });
  }
  return out;
}

}  // namespace

std::string inspection_text(const Inspection& inspection, double gap)
{
  const std::string unit = inspection.unit.empty() ? "" : " " + inspection.unit;
  std::size_t triangles = 0;
  std::vector<const InspectedBody*> damaged, inside_out;
  for (const InspectedBody& body : inspection.bodies) {
    triangles += body.triangles;
    if (!body.problem.empty()) damaged.push_back(&body);
    if (body.inside_out) inside_out.push_back(&body);
  }
  std::string out =
      fmt::format("{}: {}, {}{}\n", inspection.file, counted(inspection.bodies.size(), "body", "bodies"),
                  counted(triangles, "triangle", "triangles"),
                  inspection.unit.empty() ? "; its format names no unit" : "");
  out += bodies_text(inspection, unit);
  if (!damaged.empty()) {
    out += fmt::format("no closed surface: {}, and nothing below is of {}\n",
                       counted(damaged.size(), "body", "bodies"), damaged.size() == 1 ? "it" : "these");
    out += lines(damaged, [](const InspectedBody* body) { return body->name + ": " + body->problem; });
  }
  if (!inside_out.empty()) {
    out += "inside out:\n";
    out += lines(inside_out, [](const InspectedBody* body) {
      return body->name + (body->hollow ? ", the wall of a hollow" : "");
    });
  }
  out += gaps_text(inspection, gap, unit);
  out += links_text(inspection);
  const std::size_t closed = inspection.bodies.size() - damaged.size();
  if (closed > 0)
    out += fmt::format(
        "as it lies, {}: {} of {} stand on its lowest z, {:.6g}{}, which a slicer puts on the bed; {:.0f} % of the "
        "surface hangs over, steeper than 45 degrees\n",
        size_text(inspection.box, unit), inspection.on_bed, counted(closed, "body", "bodies"),
        inspection.box[0].z(), unit, 100.0 * inspection.overhang);
  if (inspection.linked_apart)
    out += fmt::format(
        "the file places {} objects, which slicers lay on the bed one by one: merge them into one before slicing, or "
        "bodies that are linked here are printed apart\n",
        inspection.objects);
  return out;
}

json::object inspection_json(const Inspection& inspection, double gap)
{
  json::array bodies, near, within, links;
  const auto vector = [](const Vec3& x) { return json::array{x.x(), x.y(), x.z()}; };
  for (const InspectedBody& body : inspection.bodies) {
    const bool closed = body.problem.empty();
    json::object one{{"name", body.name},
                     {"triangles", body.triangles},
                     {"box", json::array{vector(body.box[0]), vector(body.box[1])}},
                     {"problem", closed ? json::value(nullptr) : json::value(body.problem)}};
    if (closed) {
      one["volume"] = body.volume;
      one["holes"] = body.handles;
      one["inside_out"] = body.inside_out;
      one["hollow"] = body.hollow;
      one["thinnest_wall"] = body.thinnest_wall;
      one["linked"] = json::array(body.linked.begin(), body.linked.end());
      one["piece"] = body.piece;
    }
    bodies.push_back(std::move(one));
  }
  const auto pair_json = [](const NearBodies& pair) {
    return json::object{{"bodies", json::array{pair.bodies[0], pair.bodies[1]}}, {"distance", pair.distance}};
  };
  for (const NearBodies& pair : inspection.too_near) near.push_back(pair_json(pair));
  for (const auto& pair : inspection.within) within.push_back(json::array{pair[0], pair[1]});
  for (const LinkedBodies& link : inspection.links)
    links.push_back(
        json::object{{"bodies", json::array{link.bodies[0], link.bodies[1]}}, {"number", link.number}});
  return {
      {"file", inspection.file},
      {"unit", inspection.unit.empty() ? json::value(nullptr) : json::value(inspection.unit)},
      {"gap", gap},
      {"failed", inspection.failed()},
      {"bodies", std::move(bodies)},
      {"nearest", inspection.nearest ? json::value(pair_json(*inspection.nearest)) : json::value(nullptr)},
      {"too_near", std::move(near)},
      {"within", std::move(within)},
      {"links", std::move(links)},
      {"pieces", inspection.pieces},
      {"printing", json::object{{"box", json::array{vector(inspection.box[0]), vector(inspection.box[1])}},
                                {"lowest", inspection.box[0].z()},
                                {"objects", inspection.objects},
                                {"linked_apart", inspection.linked_apart},
                                {"on_bed", inspection.on_bed},
                                {"overhang", inspection.overhang}}}};
}

}  // namespace hauberk::inspecting
