#include "torus_union.hpp"

#include <hauberk/kit/fields.hpp>
#include <hauberk/suggestion.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace hauberk {
namespace {

/// Names become parts of variable names such as 3/ring.R and */ring.R, so '/', '*' and '.' must not be in
/// them.
bool usable_name(const std::string& name)
{
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-';
  });
}

class Reader {
 public:
  Reader(const Node& list, Problems& problems) : list_(list), problems_(problems) {}

  std::unique_ptr<Shape> read()
  {
    const std::size_t before = problems_.list().size();
    read_names();
    for (std::size_t i = 0; i < list_.items.size(); ++i) {
      read_position(list_.items[i], tori_[i]);
      read_axis(list_.items[i], tori_[i]);
    }
    if (problems_.list().size() != before) return nullptr;
    return std::make_unique<TorusUnion>(prefixes_, std::move(tori_));
  }

 private:
  void read_names()
  {
    std::map<std::string, bool> grouped;  // prefix -> whether it is the name of a group
    std::vector<std::string> names;
    for (const Node& item : list_.items) {
      const Node& name = item.at("name");
      const Node* group = item.find("group");
      check_name(name);
      if (group) check_name(*group);
      if (std::find(names.begin(), names.end(), name.string) != names.end()) {
        problems_.add(name, "there are two tori named '" + name.string + "'; give each its own name");
      }
      names.push_back(name.string);
      const Node& prefix = group ? *group : name;
      const auto [known, fresh] = grouped.emplace(prefix.string, group != nullptr);
      if (!fresh && known->second != (group != nullptr)) {
        problems_.add(prefix, "'" + prefix.string +
                                  "' is both a group and a torus without a group; rename one of them");
      }
      if (fresh) prefixes_.push_back(prefix.string);
      const auto at = std::find(prefixes_.begin(), prefixes_.end(), prefix.string);
      Torus torus;
      torus.name = name.string;
      torus.group = static_cast<int>(at - prefixes_.begin());
      tori_.push_back(std::move(torus));
    }
    for (const std::string& prefix : prefixes_) {
      for (const char* radius : {".R", ".r0", ".r1"}) parameters_.push_back(prefix + radius);
    }
  }

  void check_name(const Node& node)
  {
    if (usable_name(node.string)) return;
    problems_.add(node, "expected a name of letters, digits, '_' and '-', found '" + node.string + "'");
  }

  void read_position(const Node& item, Torus& torus)
  {
    const Node& position = item.at("position");
    if (position.is(Node::Type::array)) {
      const std::vector<double> x = position.numbers();
      torus.offset = Vec3(x[0], x[1], x[2]);
      return;
    }
    const double angle = position.at("direction_deg").number * degree;
    torus.direction = Vec3(std::cos(angle), std::sin(angle), 0.0);
    for (const Node& term : position.at("distance").items) {
      if (term.is(Node::Type::number)) {
        torus.offset += term.number * torus.direction;
        continue;
      }
      const auto at = std::find(parameters_.begin(), parameters_.end(), term.string);
      if (at == parameters_.end()) {
        problems_.add(term, "unknown parameter '" + term.string + "'" + suggestion(term.string, parameters_));
        continue;
      }
      torus.weights.resize(parameters_.size(), 0.0);
      torus.weights[at - parameters_.begin()] += 1.0;
    }
  }

  void read_axis(const Node& item, Torus& torus)
  {
    const Node& axis = item.at("axis");
    if (axis.is(Node::Type::string)) {  // "tangential", the only choice
      if (!item.at("position").is(Node::Type::object)) {
        problems_.add(axis, "a tangential axis needs a position given by direction_deg and distance");
        return;
      }
      torus.rotation = rotation_from_z(Vec3::UnitZ().cross(torus.direction));
      return;
    }
    const std::vector<double> a = axis.numbers();
    const Vec3 direction(a[0], a[1], a[2]);
    const double length = direction.stableNorm();
    if (length == 0.0) {
      problems_.add(axis, "expected an axis that is not zero, found [0, 0, 0]");
      return;
    }
    torus.rotation = rotation_from_z((direction / length).normalized());
  }

  const Node& list_;
  Problems& problems_;
  std::vector<std::string> prefixes_;
  std::vector<std::string> parameters_;
  std::vector<Torus> tori_;
};

Field named(std::string name, Field::Kind kind, std::string doc, std::string unit = {})
{
  Field field = kit::field(kind, std::move(name), "", std::move(doc));
  field.unit = std::move(unit);
  return field;
}

Field three_numbers(std::string doc, std::string unit)
{
  Field field = named("", Field::Kind::numbers, std::move(doc), std::move(unit));
  field.min_items = field.max_items = 3;
  return field;
}

Field position_field()
{
  Field angle =
      named("direction_deg", Field::Kind::number, "Angle from the element's x, counter-clockwise.", "degree");
  angle.required = true;

  const Field number = named("", Field::Kind::number, "A length.", "length");
  Field term = named("", Field::Kind::any_of, "A length, or the name of a parameter of this element.");
  term.children = {number, named("", Field::Kind::string, "Name of a parameter, for instance centre.R.")};
  Field distance = named("distance", Field::Kind::list, "Terms whose sum is the distance from the origin.");
  distance.required = true;
  distance.min_items = 1;
  distance.children = {term};

  Field polar =
      named("", Field::Kind::object, "In the element's xy-plane, at a distance made of parameters.");
  polar.children = {angle, distance};

  Field position = named("position", Field::Kind::any_of, "Centre of the torus in the element frame.");
  position.default_json = "[0, 0, 0]";
  position.children = {three_numbers("x, y and z.", "length"), polar};
  return position;
}

Field axis_field()
{
  Field tangential = named("", Field::Kind::choice, "z x direction of a position given by direction_deg.");
  tangential.choices = {"tangential"};
  Field axis = named("axis", Field::Kind::any_of,
                     "Axis of revolution in the element frame; its length and sign do not matter.");
  axis.default_json = "[0, 0, 1]";
  axis.children = {three_numbers("A vector.", "1"), tangential};
  return axis;
}

}  // namespace

void torus_union_fields(std::vector<Field>& out)
{
  Field name = named("name", Field::Kind::string, "Name of the torus, unique in the element.");
  name.required = true;
  Field torus = named("", Field::Kind::object, "A torus.");
  torus.children = {name, named("group", Field::Kind::string, "Tori of one group share their parameters."),
                    position_field(), axis_field()};
  Field tori =
      named("tori", Field::Kind::list,
            "The tori of the element; they may overlap each other. Each group, and each torus without "
            "one, has the parameters <name>.R (radius of the ring), <name>.r0 and <name>.r1 "
            "(half-widths of the cross-section in the ring's plane and along its axis); "
            "`parameters` gives all of them.");
  tori.required = true;
  tori.min_items = 1;
  tori.children = {torus};
  out.push_back(std::move(tori));
}

std::unique_ptr<Shape> make_torus_union(const Node& section, Problems& problems)
{
  return Reader(section.at("tori"), problems).read();
}

}  // namespace hauberk
