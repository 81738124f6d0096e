#include "sections.hpp"

#include "document/check.hpp"
#include "document/json_writer.hpp"
#include "document/jsonc.hpp"
#include "verdict.hpp"

#include <hauberk/host/factories.hpp>

#include <algorithm>
#include <cmath>

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

}  // namespace

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
