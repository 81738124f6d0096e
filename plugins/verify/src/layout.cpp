#include "layout.hpp"

#include "read.hpp"

#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// More would be a slip, and an experiment's numbers are only numbers here.
constexpr double most_cells = 1e6;
/// A cell at the very edge of a disk belongs to it.
constexpr double disk_edge = 1e-9;

std::vector<double> numbers(const json::value& v, const std::string& where)
{
  std::vector<double> out;
  for (const json::value& x : array(v, where)) out.push_back(number(x, where));
  return out;
}

Vec3 three_numbers(const json::value& v, const std::string& where)
{
  const std::vector<double> x = numbers(v, where);
  if (x.size() != 3) throw Malformed(where + ": three numbers expected");
  return {x[0], x[1], x[2]};
}

std::vector<Vec3> read_vectors(const json::value& v, const std::string& where)
{
  std::vector<Vec3> out;
  for (const json::value& item : array(v, where)) {
    std::vector<double> x = numbers(item, where);
    x.resize(3, 0.0);
    out.emplace_back(x[0], x[1], x[2]);
  }
  if (out.empty() || out.size() > 3) throw Malformed(where + ": one to three vectors expected");
  return out;
}

/// Cosine and sine, exact at multiples of 90 degrees, as a scene written in such angles means them.
Mat3 turned_about(const Vec3& axis, double degrees)
{
  const double quarter = std::round(std::remainder(degrees, 360.0) / 90.0);
  const double rest = (std::remainder(degrees, 360.0) - 90.0 * quarter) * std::numbers::pi / 180.0;
  const Mat3 fine = Eigen::AngleAxisd(rest, axis.normalized()).toRotationMatrix();
  return Eigen::AngleAxisd(quarter * std::numbers::pi / 2.0, axis.normalized()).toRotationMatrix() * fine;
}

void overlay(const json::value& section, const std::string& where, std::map<std::string, double>& parameters)
{
  const json::value* map = section.is_object() ? section.as_object().if_contains("parameters") : nullptr;
  if (map == nullptr) return;
  if (!map->is_object()) throw Malformed(where + "/parameters: an object expected");
  for (const auto& [name, value] : map->as_object())
    parameters[std::string(name)] = number(value, where + "/parameters/" + std::string(name));
}

/// The elements of one cell.
std::vector<LaidElement> read_places(const json::value& experiment, const json::value& cell)
{
  const json::value& types = member(experiment, "elements", "/experiment");
  std::vector<LaidElement> out;
  for (const json::value& entry :
       array(member(cell, "place", "/experiment/cell"), "/experiment/cell/place")) {
    const std::string where = "/experiment/cell/place/" + std::to_string(out.size());
    LaidElement element;
    element.type = text(member(entry, "element", where), where + "/element");
    element.tile = element.place = static_cast<int>(out.size());
    overlay(member(types, element.type.c_str(), "/experiment/elements"),
            "/experiment/elements/" + element.type, element.parameters);
    overlay(entry, where, element.parameters);
    element.rest.position = three_numbers(member(entry, "position", where), where + "/position");
    element.rest.rotation = read_turn(entry.as_object().if_contains("rotation"), where + "/rotation");
    out.push_back(std::move(element));
  }
  return out;
}

/// Rows of cells beside each other, turned so that the lattice vector along them is along x and alone left.
/// Of the vectors that span the lattice together with it, those with the determinant 1, the next row is
/// displaced by the one that lies least along it.
std::vector<LaidElement> strip_of(const json::value& strip, const std::vector<LaidElement>& placed,
                                  std::vector<Vec3>& v)
{
  const std::string where = "/experiment/cell/strip";
  const std::vector<double> axis = numbers(member(strip, "axis", where), where + "/axis");
  const double rows = number(member(strip, "rows", where), where + "/rows");
  if (v.size() != 2 || axis.size() != 2 || !(std::abs(axis[0]) <= 1e3 && std::abs(axis[1]) <= 1e3) ||
      !(rows >= 1.0 && rows <= most_cells))
    throw Malformed(where + ": an axis of two vectors and a count of rows expected");
  const Vec3 along = axis[0] * v[0] + axis[1] * v[1], forward = along.normalized();
  const Vec3 left = Vec3::UnitZ().cross(forward);
  std::optional<Vec3> across;
  const double most = std::abs(axis[0]) + std::abs(axis[1]) + 1.0;
  for (double k = -most; k <= most; ++k)
    for (double l = -most; l <= most; ++l) {
      if (std::abs(axis[0] * l - axis[1] * k) != 1.0) continue;
      Vec3 there = k * v[0] + l * v[1];
      if (there.dot(left) < 0.0) there = -there;
      there -= std::round(there.dot(forward) / along.norm()) * along;
      if (!across || std::abs(there.dot(forward)) < std::abs(across->dot(forward))) across = there;
    }
  if (!across) throw Malformed(where + "/axis: no common factor expected");
  Mat3 turn;
  turn << forward.transpose(), left.transpose(), Vec3::UnitZ().transpose();
  std::vector<LaidElement> out;
  Vec3 mean = Vec3::Zero();
  for (double row = 0.0; row < rows; ++row)
    for (LaidElement element : placed) {
      element.rest.position = turn * (element.rest.position + row * *across);
      element.rest.rotation = turn * element.rest.rotation;
      mean += Vec3(element.rest.position.x(), element.rest.position.y(), 0.0);
      out.push_back(std::move(element));
    }
  for (LaidElement& element : out) element.rest.position -= mean / static_cast<double>(out.size());
  v = {along.norm() * Vec3::UnitX()};
  return out;
}

Layout repeated(const json::value& cell, std::vector<LaidElement> placed)
{
  const std::string where = "/experiment/cell";
  Layout out;
  std::vector<Vec3> v = read_vectors(member(cell, "vectors", where), where + "/vectors");
  if (const json::value* strip = cell.as_object().if_contains("strip")) placed = strip_of(*strip, placed, v);
  std::array<int, 3> repeat{1, 1, 1};
  if (const json::value* counts = cell.as_object().if_contains("repeat")) {
    const std::vector<double> n = numbers(*counts, where + "/repeat");
    for (std::size_t k = 0; k < std::min<std::size_t>(n.size(), 3); ++k) {
      if (!(n[k] >= 1.0 && n[k] <= most_cells)) throw Malformed(where + "/repeat: counts expected");
      repeat[k] = static_cast<int>(n[k]);
    }
  }
  for (std::size_t k = 0; k < v.size(); ++k) out.cell.emplace_back(repeat[k] * v[k]);
  v.resize(3, Vec3::Zero());
  for (int l = 0; l < repeat[2]; ++l)
    for (int j = 0; j < repeat[1]; ++j)
      for (int i = 0; i < repeat[0]; ++i)
        for (LaidElement element : placed) {
          element.rest.position += i * v[0] + j * v[1] + l * v[2];
          element.tile = static_cast<int>(out.elements.size());
          out.elements.push_back(std::move(element));
        }
  return out;
}

/// Whether the outline holds the cell (i, j), and how far indices go.
struct Outline {
  std::string kind;
  double size = 0.0;
  std::array<int, 2> from{}, to{};

  bool holds(int i, int j, const std::vector<Vec3>& v) const
  {
    // Of a triangular lattice the third pair of neighbours is at (1, -1) or at (1, 1).
    const int third = v[0].dot(v[1]) > 0.0 ? 1 : -1;
    if (kind == "hexagon") return std::abs(i + third * j) <= to[0];
    if (kind == "disk") return (i * v[0] + j * v[1]).norm() <= size * (1.0 + disk_edge);
    return true;
  }
};

Outline read_outline(const json::value& outline, const std::vector<Vec3>& v, const std::string& where)
{
  if (!outline.is_object() || outline.as_object().size() != 1)
    throw Malformed(where + ": one of disk, hexagon, rectangle expected");
  Outline out;
  out.kind = std::string(outline.as_object().begin()->key());
  const json::value& size = outline.as_object().begin()->value();
  const std::string at = where + "/" + out.kind;
  std::array<double, 2> to{};
  if (out.kind == "rectangle") {
    const std::vector<double> n = numbers(size, at);
    if (n.size() != 2) throw Malformed(at + ": two numbers expected");
    to = {n[0] - 1.0, n[1] - 1.0};
  } else {
    out.size = number(size, at);
    to.fill(out.kind == "hexagon"
                ? out.size
                : std::ceil(std::max(v[0].norm(), v[1].norm()) / v[0].cross(v[1]).norm() * out.size));
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (!(to[k] >= 0.0 && to[k] <= 1e3)) throw Malformed(at + ": a smaller number expected");
    out.to[k] = static_cast<int>(to[k]);
    if (out.kind != "rectangle") out.from[k] = -out.to[k];
  }
  return out;
}

Layout patched(const json::value& patch, const std::vector<LaidElement>& placed)
{
  const std::string where = "/experiment/cell/patch";
  const std::vector<Vec3> v = read_vectors(member(patch, "vectors", where), where + "/vectors");
  const Outline outline = read_outline(member(patch, "outline", where), v, where + "/outline");
  std::array<int, 2> tile{1, 1};
  if (const json::value* period = patch.as_object().if_contains("tile")) {
    const std::vector<double> n = numbers(*period, where + "/tile");
    for (std::size_t k = 0; k < 2; ++k) {
      if (n.size() != 2 || !(n[k] >= 1.0 && n[k] <= most_cells))
        throw Malformed(where + "/tile: two counts expected");
      tile[k] = static_cast<int>(n[k]);
    }
  }
  const auto within = [](int index, int period) { return (index % period + period) % period; };
  Layout out;
  Vec3 mean = Vec3::Zero();
  for (int j = outline.from[1]; j <= outline.to[1]; ++j)
    for (int i = outline.from[0]; i <= outline.to[0]; ++i) {
      if (!outline.holds(i, j, v)) continue;
      const int first = (within(j, tile[1]) * tile[0] + within(i, tile[0])) * static_cast<int>(placed.size());
      for (LaidElement element : placed) {
        element.tile += first;
        element.rest.position += i * v[0] + j * v[1];
        mean += element.rest.position;
        out.elements.push_back(std::move(element));
      }
    }
  if (out.elements.empty()) return out;
  mean /= static_cast<double>(out.elements.size());
  mean.z() = 0.0;
  for (LaidElement& element : out.elements) element.rest.position -= mean;
  return out;
}

}  // namespace

Mat3 read_turn(const json::value* v, const std::string& where)
{
  if (v == nullptr) return Mat3::Identity();
  if (v->is_object() && v->as_object().contains("quaternion")) {
    const std::vector<double> q = numbers(member(*v, "quaternion", where), where + "/quaternion");
    if (q.size() != 4) throw Malformed(where + "/quaternion: four numbers expected");
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
  return turned_about(three_numbers(member(*v, "axis", where), where + "/axis"),
                      number(member(*v, "degrees", where), where + "/degrees"));
}

std::optional<Layout> laid_out(const json::value& experiment)
{
  const json::value* cell = experiment.is_object() ? experiment.as_object().if_contains("cell") : nullptr;
  if (cell == nullptr || !cell->is_object() || !cell->as_object().contains("place")) return std::nullopt;
  const std::vector<LaidElement> placed = read_places(experiment, *cell);
  const json::value* patch = cell->as_object().if_contains("patch");
  const json::value* repeat = cell->as_object().if_contains("repeat");
  if (patch != nullptr && repeat != nullptr)
    for (const double count : numbers(*repeat, "/experiment/cell/repeat"))
      if (count != 1.0) throw Malformed("/experiment/cell/repeat: a patch is not repeated");
  return patch != nullptr ? patched(*patch, placed) : repeated(*cell, placed);
}

std::vector<AskedVariable> asked_variables(const json::value& design, const Layout& layout)
{
  std::vector<AskedVariable> out;
  std::size_t index = 0;
  const std::string all = "/experiment/design/variables";
  for (const json::value& entry : array(member(design, "variables", "/experiment/design"), all)) {
    const std::string where = all + "/" + std::to_string(index++);
    const json::value& given = member(entry, "parameters", where);
    const json::value* per = entry.as_object().if_contains("per");
    const json::value* tied = entry.as_object().if_contains("tied");
    const std::string scope = per != nullptr ? text(*per, where + "/per") : "element";
    std::vector<std::string> names;
    if (given.is_string())
      names.push_back(text(given, where));
    else
      for (const json::value& name : array(given, where + "/parameters")) names.push_back(text(name, where));
    std::vector<AskedVariable> found;
    for (const std::string& name : names) {
      for (std::size_t k = 0; k < layout.elements.size(); ++k) {
        const LaidElement& element = layout.elements[k];
        if (!element.parameters.contains(name)) continue;
        const std::string group = scope == "all"    ? "*"
                                  : scope == "type" ? element.type
                                                    : std::to_string(element.tile);
        const bool joined = tied != nullptr && tied->is_bool() && tied->get_bool() && name != names.front();
        const auto same = std::find_if(found.begin(), found.end(), [&](const AskedVariable& v) {
          return joined ? v.name.starts_with(group + "/") : v.name == group + "/" + name;
        });
        AskedVariable& variable =
            same != found.end() ? *same : found.emplace_back(AskedVariable{group + "/" + name, {}, 0.0, 0.0});
        if (joined && !variable.name.ends_with("=" + name)) variable.name += "=" + name;
        variable.parameters.emplace_back(k, name);
      }
    }
    for (AskedVariable& variable : found) {
      variable.lower = number(member(entry, "lower", where), where + "/lower");
      variable.upper = number(member(entry, "upper", where), where + "/upper");
      out.push_back(std::move(variable));
    }
  }
  return out;
}

}  // namespace hauberk::verification
