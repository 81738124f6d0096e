#include "scene_reader.hpp"

#include "document/json_writer.hpp"
#include "document/jsonc.hpp"
#include "document/node_access.hpp"
#include "rotation.hpp"

#include <hauberk/error.hpp>
#include <hauberk/suggestion.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>

namespace hauberk {

namespace {

/// Placed elements: of periodic sheets, 67 kB each, 20 GB. More are a slip of the keyboard.
constexpr double largest_scene = 300000;

class SceneReader {
 public:
  SceneReader(Node& root, PluginResolver& plugins, Problems& problems)
      : root_(root), plugins_(plugins), problems_(problems)
  {
  }

  ReadScene read()
  {
    if (const Node* unit = find_typed(root_, "length_unit", Node::Type::string))
      spec_.length_unit = unit->string;
    if (Node* elements = find_mutable(root_, "elements")) {
      for (auto& [name, element] : elements->members) read_type(name, element);
    }
    if (const Node* cell = find_typed(root_, "cell", Node::Type::object)) read_cell(*cell);
    return {std::move(spec_), std::move(tile_of_)};
  }

 private:
  Node& root_;
  PluginResolver& plugins_;
  Problems& problems_;
  SceneSpec spec_;
  std::vector<int> tile_of_;
  std::vector<std::vector<double>> type_parameters_;
  std::vector<const Node*> type_nodes_;
  std::set<std::pair<const Node*, std::size_t>> reported_;  ///< parameters without a value

  void read_type(const std::string& name, Node& element)
  {
    if (!is_name(name)) {
      problems_.add(element,
                    "expected a name that starts with a letter and has only letters, digits, '_', '-' and "
                    "'.', found '" +
                        name + "'");
    }
    std::shared_ptr<const Shape> shape = plugins_.shape(element, problems_);
    std::vector<double> values;
    if (shape) {
      for (const ParameterInfo& info : shape->parameters()) values.push_back(info.default_value);
      const bool good = read_parameters(element, *shape, values);
      if (good) check_geometry(element, *shape, values);
      complete_parameters(element, *shape, values);
    }
    spec_.types.push_back({name, std::move(shape)});
    type_parameters_.push_back(std::move(values));
    type_nodes_.push_back(&element);
  }

  /// Such names keep variable names ("link/ring.R", "3/ring.R", "*/ring.R") and pointers unambiguous.
  static bool is_name(const std::string& name)
  {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto other = [](char c) { return (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.'; };
    return !name.empty() && letter(name[0]) &&
           std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || other(c); });
  }

  /// Values in `section`/parameters over `values`. True when all are usable.
  bool read_parameters(const Node& section, const Shape& shape, std::vector<double>& values)
  {
    const Node* map = find_typed(section, "parameters", Node::Type::object);
    if (map == nullptr) return true;
    bool good = true;
    for (const auto& [name, value] : map->members) {
      const int index = parameter_index(shape, name);
      if (index < 0) {
        problems_.add(value, "unknown parameter '" + name + "'" + suggestion(name, parameter_names(shape)));
        good = false;
        continue;
      }
      const ParameterInfo& info = shape.parameters()[index];
      if (!value.is(Node::Type::number)) continue;
      if (value.number < info.lower || value.number > info.upper) {
        Field range;
        range.minimum = info.lower;
        range.maximum = info.upper;
        problems_.add(value, "expected " + describe_expected(range) + ", found " + describe_found(value));
        good = false;
        values[index] = std::numeric_limits<double>::quiet_NaN();
        continue;
      }
      values[index] = value.number;
    }
    return good;
  }

  /// The shape's own say on a complete set of values.
  void check_geometry(const Node& section, const Shape& shape, const std::vector<double>& values)
  {
    if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) return;
    const Node* map = section.find("parameters");
    try {
      shape.primitives(values);
    } catch (const InputError& error) {
      problems_.add(map != nullptr ? *map : section, error.what());
    } catch (const PluginError& error) {
      problems_.add(section, error.what());
    }
  }

  static void complete_parameters(Node& element, const Shape& shape, const std::vector<double>& values)
  {
    set_default(element, "parameters", object_node());
    Node& map = *find_mutable(element, "parameters");
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (!std::isnan(values[k])) set_default(map, shape.parameters()[k].name, number_node(values[k]));
    }
  }

  void read_cell(const Node& cell)
  {
    if (const Node* patch = cell.find("patch")) {
      read_patch(cell, *patch);
    } else {
      read_periodic(cell);
    }
  }

  void read_periodic(const Node& cell)
  {
    if (cell.find("vectors") == nullptr) {
      // Also absent when it was wrong; then it has been reported below its own pointer.
      const std::string pointer = cell.pointer + "/vectors";
      const auto& list = problems_.list();
      const auto about_vectors = [&](const Problem& problem) {
        return pointer_within(problem.pointer, pointer);
      };
      if (std::none_of(list.begin(), list.end(), about_vectors)) {
        problems_.add(cell, "missing key 'vectors': expected an array of 2 arrays of 2 numbers");
      }
    }
    std::vector<Vec3> v = read_vectors(cell.find("vectors"));
    std::array<int, 3> repeat{1, 1, 1};
    std::vector<PlacedElement> placed = read_place(cell);
    if (const Node* strip = cell.find("strip")) cut_strip(*strip, v, placed);
    const Node* counts = cell.find("repeat");
    if (counts != nullptr) {
      for (std::size_t k = 0; k < counts->items.size(); ++k)
        repeat[k] = static_cast<int>(counts->items[k].number);
      // The default of two is that of a sheet.
      const bool beyond = std::any_of(repeat.begin() + static_cast<std::ptrdiff_t>(v.size()), repeat.end(),
                                      [](int count) { return count != 1; });
      const std::size_t given = counts->items.size();
      if (!v.empty() && (beyond || given > std::max<std::size_t>(v.size(), 2) ||
                         given < std::min<std::size_t>(v.size(), 2)))
        problems_.add(*counts, fmt::format("expected one number for each of the {} vectors, found {}",
                                           v.size(), counts->items.size()));
    }
    const double total =
        static_cast<double>(repeat[0]) * repeat[1] * repeat[2] * static_cast<double>(placed.size());
    if (total > largest_scene) {
      problems_.add(*counts, "expected at most " + format_number(largest_scene) + " placed elements, found " +
                                 format_number(total));
      return;
    }
    if (placed.empty()) return;
    for (std::size_t k = 0; k < v.size(); ++k) spec_.lattice.emplace_back(repeat[k] * v[k]);
    v.resize(3, Vec3::Zero());
    spec_.repeat = repeat;
    // Element k = ((l n + j) m + i) |place| + index in place.
    for (int cell_index = 0; cell_index < repeat[0] * repeat[1] * repeat[2]; ++cell_index) {
      const int i = cell_index % repeat[0], j = cell_index / repeat[0] % repeat[1],
                l = cell_index / (repeat[0] * repeat[1]);
      {
        for (std::size_t k = 0; k < placed.size(); ++k) {
          PlacedElement element = placed[k];
          element.rest.position += i * v[0] + j * v[1] + l * v[2];
          if (cell_index > 0) element.copy_of = static_cast<int>(k);
          tile_of_.push_back(static_cast<int>(spec_.elements.size()));
          spec_.elements.push_back(std::move(element));
        }
      }
    }
  }

  /// Leaves of two vectors the one along the strip, turned to x, and of the cells `rows` beside each other.
  void cut_strip(const Node& strip, std::vector<Vec3>& v, std::vector<PlacedElement>& placed)
  {
    const Node *axis = find_typed(strip, "axis", Node::Type::array),
               *rows = find_typed(strip, "rows", Node::Type::number);
    if (axis == nullptr || rows == nullptr || v.empty()) return;
    if (v.size() != 2) {
      problems_.add(strip, fmt::format("a strip is cut from a sheet, with two vectors; there {} {}",
                                       v.size() == 1 ? "is" : "are", v.size()));
      return;
    }
    const auto i = static_cast<int>(axis->items[0].number), j = static_cast<int>(axis->items[1].number);
    if (std::gcd(i, j) != 1) {
      problems_.add(*axis, fmt::format("expected two whole numbers without a common factor, found {} and {}; "
                                       "cell.repeat makes the strip's cell longer",
                                       i, j));
      return;
    }
    if (rows->number * static_cast<double>(placed.size()) > largest_scene) {
      problems_.add(*rows, "expected at most " + format_number(largest_scene) + " placed elements");
      return;
    }
    const Vec3 along = i * v[0] + j * v[1];
    const Vec3 across = across_strip(i, j, v);
    const double c = along.x() / along.norm(), s = along.y() / along.norm();
    Mat3 turn = Mat3::Identity();
    turn.topLeftCorner<2, 2>() << c, s, -s, c;
    std::vector<PlacedElement> out;
    Vec3 mean = Vec3::Zero();
    for (int row = 0; row < static_cast<int>(rows->number); ++row) {
      for (PlacedElement element : placed) {
        element.rest.position = turn * (element.rest.position + row * across);
        element.rest.rotation = turn * element.rest.rotation;
        mean += element.rest.position;
        out.push_back(std::move(element));
      }
    }
    for (PlacedElement& element : out)
      element.rest.position.head<2>() -= mean.head<2>() / static_cast<double>(out.size());
    v = {along.norm() * Vec3::UnitX()};
    placed = std::move(out);
  }

  /// The lattice vector that spans the lattice together with i v1 + j v2, to its left, and that none of its
  /// multiples shortens.
  static Vec3 across_strip(int i, int j, const std::vector<Vec3>& v)
  {
    // i l - j k = 1, by Euclid's algorithm on (i, j).
    long r0 = i, r1 = j, k0 = 1, k1 = 0, l0 = 0, l1 = 1;
    while (r1 != 0) {
      const long quotient = r0 / r1;
      std::tie(r0, r1) = std::pair(r1, r0 - quotient * r1);
      std::tie(k0, k1) = std::pair(k1, k0 - quotient * k1);
      std::tie(l0, l1) = std::pair(l1, l0 - quotient * l1);
    }
    const Vec3 along = i * v[0] + j * v[1];  // k0 i + l0 j = r0 = +-1
    Vec3 across = -l0 * v[0] + k0 * v[1];
    if (along.cross(across).z() < 0.0) across = -across;
    return across - std::round(across.dot(along) / along.squaredNorm()) * along;
  }

  /// Cells (i, j) of the outline by rows; empty when something is wrong with it.
  std::vector<std::array<int, 2>> outlined(const Node& outline, const std::vector<Vec3>& v)
  {
    std::vector<std::array<int, 2>> cells;
    if (outline.members.size() != 1) {
      problems_.add(outline, "expected exactly one of disk, hexagon and rectangle");
      return cells;
    }
    const auto& [kind, node] = outline.members.front();
    std::array<int, 2> from{}, to{};
    if (kind == "rectangle") {
      to = {static_cast<int>(node.items[0].number) - 1, static_cast<int>(node.items[1].number) - 1};
    } else if (kind == "hexagon") {
      to.fill(static_cast<int>(node.number));
    } else {
      // |i v1 + j v2| >= |i| area/|v2|, and likewise for j.
      const double area = v[0].cross(v[1]).norm();
      const double far = std::max(v[0].norm(), v[1].norm()) / area * node.number;
      if (far > largest_scene) {
        problems_.add(node, "expected at most " + format_number(largest_scene) + " cells in the patch");
        return cells;
      }
      to.fill(static_cast<int>(std::ceil(far)));
    }
    if (kind != "rectangle") from = {-to[0], -to[1]};
    const double asked = (to[0] - from[0] + 1.0) * (to[1] - from[1] + 1.0);
    if (asked > largest_scene) {
      problems_.add(node, "expected at most " + format_number(largest_scene) + " cells in the patch");
      return cells;
    }
    // Around the middle cell of a lattice whose vectors are 60 (120) degrees apart, the third pair of
    // neighbours is at +-(1, -1) (at +-(1, 1)).
    const int third = v[0].dot(v[1]) > 0.0 ? 1 : -1;
    for (int j = from[1]; j <= to[1]; ++j) {
      for (int i = from[0]; i <= to[0]; ++i) {
        if (kind == "hexagon" && std::abs(i + third * j) > to[0]) continue;
        if (kind == "disk" && (i * v[0] + j * v[1]).norm() > node.number * (1.0 + 1e-9)) continue;
        cells.push_back({i, j});
      }
    }
    return cells;
  }

  /// A patch is laid out and moved so that the mean of its elements is above the origin.
  void read_patch(const Node& cell, const Node& patch)
  {
    if (const Node* vectors = cell.find("vectors"))
      problems_.add(*vectors, "a patch has its own vectors; remove these");
    if (const Node* strip = cell.find("strip"))
      problems_.add(*strip, "a patch has an outline instead; remove this, or the patch");
    const Node* repeat = cell.find("repeat");
    if (repeat != nullptr && repeat->numbers() != std::vector<double>{1.0, 1.0})
      problems_.add(*repeat, "a patch has an outline instead; remove this");
    const Node* outline = find_typed(patch, "outline", Node::Type::object);
    const std::vector<Vec3> v = read_vectors(patch.find("vectors"));
    if (v.empty() || outline == nullptr) return;
    const std::vector<PlacedElement> placed = read_place(cell);
    const std::vector<std::array<int, 2>> cells = outlined(*outline, v);
    const double total = static_cast<double>(cells.size()) * static_cast<double>(placed.size());
    if (total > largest_scene) {
      problems_.add(*outline, "expected at most " + format_number(largest_scene) +
                                  " placed elements, found " + format_number(total));
      return;
    }
    std::array<int, 2> tile{1, 1};
    if (const Node* period = patch.find("tile")) {
      for (std::size_t k = 0; k < 2; ++k) tile[k] = static_cast<int>(period->items[k].number);
    }
    if (static_cast<double>(tile[0]) * tile[1] * static_cast<double>(placed.size()) > largest_scene) {
      problems_.add(*patch.find("tile"), "expected at most " + format_number(largest_scene) +
                                             " placed elements in a tile; make it smaller");
      return;
    }
    const auto within = [](int index, int period) { return (index % period + period) % period; };
    Vec3 mean = Vec3::Zero();
    for (const auto& [i, j] : cells) {
      const int first = (within(j, tile[1]) * tile[0] + within(i, tile[0])) * static_cast<int>(placed.size());
      for (std::size_t k = 0; k < placed.size(); ++k) {
        PlacedElement element = placed[k];
        tile_of_.push_back(first + static_cast<int>(k));
        element.rest.position += i * v[0] + j * v[1];
        mean += element.rest.position / total;
        spec_.elements.push_back(std::move(element));
      }
    }
    mean.z() = 0.0;
    for (PlacedElement& element : spec_.elements) element.rest.position -= mean;
  }

  /// Two vectors in the plane, or three in space; none where they are missing.
  std::vector<Vec3> read_vectors(const Node* node)
  {
    std::vector<Vec3> v;
    if (node == nullptr) return v;
    for (const Node& item : node->items) {
      std::vector<double> x = item.numbers();
      if (x.size() != node->items.size()) {
        problems_.add(
            item,
            "expected as many numbers as there are vectors: one of x, two of x and y, or three of x, "
            "y and z");
      }
      x.resize(3, 0.0);
      v.emplace_back(x[0], x[1], x[2]);
    }
    const bool space = v.size() == 3;
    if (v.size() == 1) {
      if (!(v[0].x() > 0.0) || !std::isfinite(v[0].x()))
        problems_.add(*node, "expected one vector along x, of a length above 0");
      return v;
    }
    const double size =
        space ? std::abs(v[0].dot(v[1].cross(v[2]))) : std::abs(v[0].x() * v[1].y() - v[0].y() * v[1].x());
    double product = 1.0;
    for (const Vec3& x : v) product *= x.norm();
    // Below an angle of 1e-9 rounding decides about the cell.
    if (!(size > 1e-9 * product) || !std::isfinite(size)) {
      problems_.add(*node, space ? std::string("expected three vectors that span space, found linearly "
                                               "dependent ones")
                                 : "expected two vectors that span the plane, found " +
                                       write_json(node->items[0]) + " and " + write_json(node->items[1]) +
                                       ", which are linearly dependent");
    }
    return v;
  }

  std::vector<PlacedElement> read_place(const Node& cell)
  {
    std::vector<PlacedElement> placed;
    const Node* place = find_typed(cell, "place", Node::Type::array);
    if (place == nullptr) return placed;
    for (const Node& entry : place->items) {
      if (std::optional<PlacedElement> element = read_placement(entry)) placed.push_back(std::move(*element));
    }
    return placed;
  }

  std::optional<PlacedElement> read_placement(const Node& entry)
  {
    PlacedElement element;
    element.rest.rotation = read_rotation(entry.find("rotation"), problems_);
    if (const Node* position = entry.find("position")) {
      const std::vector<double> x = position->numbers();
      element.rest.position = Vec3(x[0], x[1], x[2]);
    }
    const Node* name = entry.find("element");
    if (name == nullptr) return std::nullopt;
    element.type = find_type(*name);
    if (element.type < 0) return std::nullopt;
    const std::size_t type = element.type;
    const Shape* shape = spec_.types[type].shape.get();
    if (shape == nullptr) return std::nullopt;
    element.parameters = type_parameters_[type];
    const bool good = read_parameters(entry, *shape, element.parameters);
    check_complete(entry, *type_nodes_[type], *shape, element.parameters);
    if (good && entry.find("parameters") != nullptr) check_geometry(entry, *shape, element.parameters);
    return element;
  }

  int find_type(const Node& name)
  {
    std::vector<std::string> names;
    for (const ElementType& type : spec_.types) names.push_back(type.name);
    const auto found = std::find(names.begin(), names.end(), name.string);
    if (found != names.end()) return static_cast<int>(found - names.begin());
    problems_.add(name, "unknown element '" + name.string + "'" + suggestion(name.string, names));
    return -1;
  }

  void check_complete(const Node& entry, const Node& type, const Shape& shape,
                      const std::vector<double>& values)
  {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::string& name = shape.parameters()[k].name;
      if (!std::isnan(values[k]) || is_reported(type, name) || is_reported(entry, name)) continue;
      if (!reported_.insert({&type, k}).second) continue;
      problems_.add(entry, "parameter '" + name + "' has no value and no default: give it in " +
                               type.pointer + "/parameters");
    }
  }

  /// True when something is wrong with the value that `section` gives to a parameter.
  bool is_reported(const Node& section, const std::string& parameter) const
  {
    const std::string map = section.pointer + "/parameters";
    const std::string value = map + "/" + pointer_token(parameter);
    return std::any_of(problems_.list().begin(), problems_.list().end(), [&](const Problem& problem) {
      return problem.pointer == map || pointer_within(problem.pointer, value);
    });
  }
};

}  // namespace

ReadScene read_scene(Node& root, PluginResolver& plugins, Problems& problems)
{
  return SceneReader(root, plugins, problems).read();
}

std::vector<std::string> parameter_names(const Shape& shape)
{
  std::vector<std::string> names;
  for (const ParameterInfo& info : shape.parameters()) names.push_back(info.name);
  return names;
}

int parameter_index(const Shape& shape, std::string_view name)
{
  const std::vector<ParameterInfo>& list = shape.parameters();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const ParameterInfo& info) { return info.name == name; });
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

}  // namespace hauberk
