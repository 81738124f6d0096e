#include "sections.hpp"

#include "document/check.hpp"
#include "document/json_writer.hpp"
#include "document/jsonc.hpp"
#include "verdict.hpp"

#include <hauberk/host/factories.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hauberk::conformance {
namespace {

using Kind = Field::Kind;
using Type = Node::Type;

/// Keys of a section that belong to every plugin of the kind.
constexpr const char* common_keys[] = {"shape",  "plugin",     "parameters", "directions_deg",
                                       "senses", "directions", "comment"};

Node text_node(const std::string& text)
{
  Node node;
  node.type = Type::string;
  node.string = text;
  return node;
}

Node number_node(double value)
{
  Node node;
  node.type = Type::number;
  node.number = value;
  return node;
}

/// A number that the field allows, 1 if it can be.
double simple_number(const Field& field)
{
  const double low = field.minimum, high = field.maximum;
  double value = 1.0;
  if (low >= value) value = std::isfinite(high) ? 0.5 * (low + high) : low + 1.0;
  if (high < value) value = std::isfinite(low) ? 0.5 * (low + high) : high - 1.0;
  return field.kind == Kind::integer ? std::ceil(value) : value;
}

/// Makes the simplest value of a field; names are numbered, so that no two are the same.
class Maker {
 public:
  Node make(const Field& field)
  {
    if (!field.default_json.empty()) return default_node(field, "");
    switch (field.kind) {
      case Kind::number:
      case Kind::integer:
        return number_node(simple_number(field));
      case Kind::boolean:
        return plain(Type::boolean);
      case Kind::string:
        return text_node(name());
      case Kind::choice:
        return text_node(field.choices.empty() ? "" : field.choices.front());
      case Kind::numbers:
      case Kind::list:
        return list(field);
      case Kind::object:
        return object(field);
      case Kind::map:
        return map(field);
      case Kind::any_of:
        return field.children.empty() ? Node{} : make(field.children.front());
      case Kind::any:
        break;
    }
    return {};
  }

 private:
  static Node plain(Type type)
  {
    Node node;
    node.type = type;
    return node;
  }
  std::string name() { return "a" + std::to_string(++names_); }
  Node list(const Field& field)
  {
    Node node = plain(Type::array);
    for (std::size_t i = 0; i < field.min_items; ++i) {
      if (field.kind == Kind::numbers) {
        node.items.push_back(number_node(simple_number(field)));
      } else {
        node.items.push_back(field.children.empty() ? Node{} : make(field.children.front()));
      }
    }
    return node;
  }
  Node object(const Field& field)
  {
    Node node = plain(Type::object);
    for (const Field& child : field.children) {
      if (child.required) node.members.emplace_back(child.name, make(child));
    }
    return node;
  }
  Node map(const Field& field)
  {
    Node node = plain(Type::object);
    for (std::size_t i = 0; i < field.min_items; ++i)
      node.members.emplace_back(name(), field.children.empty() ? Node{} : make(field.children.front()));
    return node;
  }

  int names_ = 0;
};

std::string text_of(const std::vector<Problem>& problems)
{
  std::string text;
  for (const Problem& p : problems)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", p.pointer, p.message);
  return text;
}

void add_variant(std::vector<Variant>& out, const Section& section, const std::string& name, Node value)
{
  Variant variant{name, write_json(value), section.values};
  for (auto& [key, old] : variant.values.members) {
    if (key != name) continue;
    relocate(value, old.pointer, old.line);
    old = std::move(value);
    break;
  }
  out.push_back(std::move(variant));
}

/// What else a value may be, when one switch in it is set otherwise.
class Switches {
 public:
  /// The other values of a node of this field, and what was changed in each: "crossed = true".
  struct Other {
    std::string what;
    Node value;
  };

  std::vector<Other> of(const Field& field, const Node& node, const std::string& place) const
  {
    switch (field.kind) {
      case Kind::boolean:
      case Kind::choice:
        return values(field, &node, place);
      case Kind::any_of:
        return any_of(field, node, place);
      case Kind::object:
        return members(field, node, place);
      case Kind::list:
        return items(field, node, place);
      case Kind::map:
        return entries(field, node, place);
      default:
        return {};
    }
  }

 private:
  static std::vector<Other> values(const Field& field, const Node* now, const std::string& place)
  {
    std::vector<Other> out;
    const auto add = [&](Node value, bool same) {
      if (!same) out.push_back({fmt::format("{} = {}", place, write_json(value)), std::move(value)});
    };
    if (field.kind == Kind::boolean) {
      for (const bool value : {false, true}) {
        Node node;
        node.type = Type::boolean;
        node.boolean = value;
        add(node, now != nullptr && now->is(Type::boolean) && now->boolean == value);
      }
    }
    if (field.kind == Kind::choice) {
      for (const std::string& choice : field.choices)
        add(text_node(choice), now != nullptr && now->is(Type::string) && now->string == choice);
    }
    return out;
  }

  static bool takes(const Field& field, const Node& node)
  {
    Node copy = node;
    Problems problems;
    return check_fields(copy, field, problems) && problems.empty();
  }

  std::vector<Other> any_of(const Field& field, const Node& node, const std::string& place) const
  {
    std::vector<Other> out;
    for (const Field& child : field.children) {
      std::vector<Other> more;
      if (takes(child, node)) {
        more = of(child, node, place);
      } else if (child.kind == Kind::boolean || child.kind == Kind::choice) {
        more = values(child, nullptr, place);
      } else {
        Node value = Maker().make(child);
        if (!value.is(Type::null)) more.push_back({fmt::format("{} = {}", place, write_json(value)), value});
      }
      std::move(more.begin(), more.end(), std::back_inserter(out));
    }
    return out;
  }

  std::vector<Other> members(const Field& field, const Node& node, const std::string& place) const
  {
    std::vector<Other> out;
    for (const Field& child : field.children) {
      const std::string there = place.empty() ? child.name : place + "/" + child.name;
      const Node* now = node.find(child.name);
      for (Other& other : now != nullptr ? of(child, *now, there) : values(child, nullptr, there)) {
        Node whole = node;
        if (now == nullptr) {
          whole.members.emplace_back(child.name, std::move(other.value));
        } else {
          for (auto& [key, value] : whole.members) {
            if (key == child.name) value = other.value;
          }
        }
        out.push_back({std::move(other.what), std::move(whole)});
      }
    }
    return out;
  }

  std::vector<Other> items(const Field& field, const Node& node, const std::string& place) const
  {
    std::vector<Other> out;
    if (field.children.empty()) return out;
    const Field& item = field.children.front();
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      for (Other& other : of(item, node.items[i], fmt::format("{}/{}", place, i))) {
        Node whole = node;
        whole.items[i] = std::move(other.value);
        out.push_back({std::move(other.what), std::move(whole)});
      }
    }
    // Of choices also none, and each by itself.
    if (item.kind != Kind::choice) return out;
    Node list = node;
    list.items.clear();
    if (!node.items.empty()) out.push_back({place + " = []", list});
    for (Other& other : values(item, node.items.size() == 1 ? &node.items.front() : nullptr, place + "/0")) {
      list.items.assign(1, std::move(other.value));
      out.push_back({std::move(other.what), list});
    }
    return out;
  }

  std::vector<Other> entries(const Field& field, const Node& node, const std::string& place) const
  {
    std::vector<Other> out;
    for (std::size_t i = 0; i < node.members.size() && !field.children.empty(); ++i) {
      for (Other& other :
           of(field.children.front(), node.members[i].second, place + "/" + node.members[i].first)) {
        Node whole = node;
        whole.members[i].second = std::move(other.value);
        out.push_back({std::move(other.what), std::move(whole)});
      }
    }
    return out;
  }
};

}  // namespace

std::vector<Variant> switched(const Section& section)
{
  std::vector<Variant> out;
  for (Switches::Other& other : Switches().of(section.fields, section.values, "")) {
    relocate(other.value, "", 0);
    Problems problems;
    if (!check_fields(other.value, section.fields, problems) || !problems.empty()) continue;
    const bool known =
        std::any_of(out.begin(), out.end(), [&](const Variant& v) { return v.field == other.what; });
    if (!known) out.push_back({std::move(other.what), "", std::move(other.value)});
  }
  return out;
}

Section read_section(const PluginTable& table, const Setup& setup)
{
  Section section;
  section.fields.kind = Kind::object;
  section.fields.children = plugin_fields(table);
  Problems problems;
  if (setup.section.empty()) {
    section.values = Maker().make(section.fields);
    relocate(section.values, "", 0);
  } else {
    std::optional<Node> given = read_jsonc(setup.section, problems);
    require(given.has_value(), "the section given cannot be read: {}", text_of(problems.list()));
    if (const Node* parameters = given->find("parameters")) section.parameters = *parameters;
    std::erase_if(given->members, [](const auto& member) {
      return std::find(std::begin(common_keys), std::end(common_keys), member.first) != std::end(common_keys);
    });
    section.values = std::move(*given);
  }
  check_fields(section.values, section.fields, problems);
  require(problems.empty(), "{} is refused by the fields: {}",
          setup.section.empty() ? "a section made of the plugin's fields" : "the section given",
          text_of(problems.list()));
  return section;
}

std::vector<Variant> variants(const Section& section)
{
  std::vector<Variant> out;
  for (const Field& field : section.fields.children) {
    const Node* given = section.values.find(field.name);
    if (given == nullptr) continue;
    switch (field.kind) {
      case Kind::number:
      case Kind::integer:
        for (const double end : {field.minimum, field.maximum, simple_number(field)}) {
          if (!std::isfinite(end) || end == given->number) continue;
          if (end == field.minimum && field.exclusive_minimum) continue;
          add_variant(out, section, field.name, number_node(end));
        }
        break;
      case Kind::choice:
        for (const std::string& choice : field.choices) {
          if (choice != given->string) add_variant(out, section, field.name, text_node(choice));
        }
        break;
      case Kind::boolean: {
        Node flipped = *given;
        flipped.boolean = !flipped.boolean;
        add_variant(out, section, field.name, std::move(flipped));
        break;
      }
      case Kind::numbers:
        for (std::size_t i = 0; i < given->items.size(); ++i) {
          Node moved = *given;
          double& value = moved.items[i].number;
          value = value + 1.0 <= field.maximum ? value + 1.0 : field.minimum;
          if (std::isfinite(value)) add_variant(out, section, field.name, std::move(moved));
        }
        break;
      default:
        break;
    }
  }
  return out;
}

void scale_lengths(Node& node, const Field& field, double factor)
{
  switch (field.kind) {
    case Kind::number:
      if (field.unit == "length") node.number *= factor;
      break;
    case Kind::numbers:
      for (Node& item : node.items) {
        if (field.unit == "length") item.number *= factor;
      }
      break;
    case Kind::list:
      for (Node& item : node.items) scale_lengths(item, field.children.front(), factor);
      break;
    case Kind::map:
      for (auto& [key, value] : node.members) scale_lengths(value, field.children.front(), factor);
      break;
    case Kind::object:
      for (auto& [key, value] : node.members) {
        for (const Field& child : field.children) {
          if (child.name == key) scale_lengths(value, child, factor);
        }
      }
      break;
    case Kind::any_of:
      for (const Field& child : field.children) {
        Node copy = node;
        Problems problems;
        if (!check_fields(copy, child, problems) || !problems.empty()) continue;
        return scale_lengths(node, child, factor);
      }
      break;
    default:
      break;
  }
}

}  // namespace hauberk::conformance
