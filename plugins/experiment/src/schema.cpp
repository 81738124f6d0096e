#include "document/check.hpp"
#include "document/merge_fields.hpp"
#include "document/node_access.hpp"

#include <hauberk/experiment/fields.hpp>
#include <hauberk/experiment/schema.hpp>
#include <hauberk/experiment/union_shape.hpp>
#include <hauberk/host/factories.hpp>

#include <cmath>

namespace hauberk {

namespace {

using Kind = Field::Kind;

Node boolean_node(bool value)
{
  Node node;
  node.type = Node::Type::boolean;
  node.boolean = value;
  return node;
}

Node strings_node(const std::vector<std::string>& values)
{
  Node node;
  node.type = Node::Type::array;
  for (const std::string& value : values) node.items.push_back(string_node(value));
  return node;
}

Node const_node(const std::string& key, const std::string& value)
{
  Node constant = object_node(), properties = object_node(), condition = object_node();
  set_default(constant, "const", string_node(value));
  set_default(properties, key, std::move(constant));
  set_default(condition, "properties", std::move(properties));
  set_default(condition, "required", strings_node({key}));
  return condition;
}

class SchemaWriter {
 public:
  explicit SchemaWriter(std::span<const PluginTable* const> plugins) : plugins_(plugins) {}

  Node write(const Field& field) const
  {
    Node out = object_node();
    const std::string doc = field.doc + (field.unit.empty() ? "" : " Unit: " + field.unit + ".");
    if (!doc.empty()) set_default(out, "description", string_node(doc));
    if (!field.default_json.empty()) set_default(out, "default", default_node(field, ""));
    write_type(field, out);
    return out;
  }

  /// Properties of an object; `closed`: it has no others.
  void write_members(const std::vector<Field>& members, bool closed, Node& out) const
  {
    set_default(out, "type", string_node("object"));
    Node properties = object_node();
    std::vector<std::string> needed;
    for (const Field& member : members) {
      set_default(properties, member.name, write(member));
      if (member.required) needed.push_back(member.name);
    }
    set_default(out, "properties", std::move(properties));
    if (!needed.empty()) set_default(out, "required", strings_node(needed));
    if (closed) set_default(out, "additionalProperties", boolean_node(false));
  }

 private:
  std::span<const PluginTable* const> plugins_;

  void write_type(const Field& field, Node& out) const
  {
    const auto type = [&](const char* name) { set_default(out, "type", string_node(name)); };
    switch (field.kind) {
      case Kind::number:
        return write_number("number", field, out);
      case Kind::integer:
        return write_number("integer", field, out);
      case Kind::boolean:
        return type("boolean");
      case Kind::string:
        return type("string");
      case Kind::choice:
        set_default(out, "enum", strings_node(field.choices));
        return;
      case Kind::numbers:
        type("array");
        return write_numbers(field, out);
      case Kind::list:
        type("array");
        return write_list(field, out);
      case Kind::map:
        type("object");
        return write_map(field, out);
      case Kind::object:
        return write_object(field, out);
      case Kind::any_of:
        return write_any_of(field, out);
      case Kind::any:
        return;
    }
  }

  /// A number, or a string that stands for one.
  static void write_number(const char* type, const Field& field, Node& out)
  {
    set_default(out, "type", strings_node({type, "string"}));
    set_default(out, "pattern", string_node("^[$=]"));
    write_range(field, out);
  }

  static void write_range(const Field& field, Node& out)
  {
    if (std::isfinite(field.minimum)) {
      set_default(out, field.exclusive_minimum ? "exclusiveMinimum" : "minimum", number_node(field.minimum));
    }
    if (std::isfinite(field.maximum)) set_default(out, "maximum", number_node(field.maximum));
  }

  static void write_count(const Field& field, Node& out)
  {
    if (field.min_items > 0) set_default(out, "minItems", number_node(static_cast<double>(field.min_items)));
    if (field.max_items != std::numeric_limits<std::size_t>::max()) {
      set_default(out, "maxItems", number_node(static_cast<double>(field.max_items)));
    }
  }

  static void write_numbers(const Field& field, Node& out)
  {
    Node item = object_node();
    write_number("number", field, item);
    set_default(out, "items", std::move(item));
    write_count(field, out);
  }

  void write_list(const Field& field, Node& out) const
  {
    if (!field.children.empty()) set_default(out, "items", write(field.children[0]));
    write_count(field, out);
  }

  void write_map(const Field& field, Node& out) const
  {
    if (!field.children.empty()) set_default(out, "additionalProperties", write(field.children[0]));
    if (field.min_items > 0)
      set_default(out, "minProperties", number_node(static_cast<double>(field.min_items)));
  }

  void write_any_of(const Field& field, Node& out) const
  {
    Node options;
    options.type = Node::Type::array;
    for (const Field& child : field.children) options.items.push_back(write(child));
    set_default(out, "anyOf", std::move(options));
  }

  /// A section with a plugin: the common fields, and for each plugin that is known, all of its fields. Draft
  /// 7 has no way to add to a closed object, so each alternative repeats the common fields.
  void write_object(const Field& field, Node& out) const
  {
    const std::optional<PluginSection> section = plugin_section(field);
    write_members(field.children, !section.has_value(), out);
    if (!section) return;
    Node alternatives;
    alternatives.type = Node::Type::array;
    for (const PluginTable* plugin : plugins_) {
      if (plugin->kind != section->kind) continue;
      if (plugin == &union_table() && field.name == union_part_field) continue;  // none within itself
      Node then = object_node(), alternative = object_node();
      write_members(merge_fields(field.children, plugin_fields(*plugin)), true, then);
      set_default(alternative, "if", const_node(section->key, plugin->id));
      set_default(alternative, "then", std::move(then));
      alternatives.items.push_back(std::move(alternative));
    }
    if (!alternatives.items.empty()) set_default(out, "allOf", std::move(alternatives));
  }
};

}  // namespace

Node experiment_schema(std::span<const PluginTable* const> plugins, TaskFormats formats)
{
  Node root = object_node();
  set_default(root, "$schema", string_node("http://json-schema.org/draft-07/schema#"));
  set_default(root, "$id", string_node("urn:hauberk:experiment"));
  set_default(root, "title", string_node("Hauberk experiment"));
  std::vector<const PluginTable*> shapes_too(plugins.begin(), plugins.end());
  shapes_too.push_back(&union_table());
  const SchemaWriter writer(shapes_too);
  Field all = experiment_fields(formats);
  Node body = writer.write(all);
  // What a file leaves out that extends another one is known there alone.
  Node extending = object_node(), named = object_node();
  set_default(extending, "required", strings_node({"extends"}));
  std::erase_if(all.children, [](const Field& f) { return f.name != "extends" && f.name != "name"; });
  writer.write_members(all.children, false, named);
  set_default(root, "if", std::move(extending));
  set_default(root, "then", std::move(named));
  set_default(root, "else", std::move(body));
  return root;
}

Node field_schema(const Field& field) { return SchemaWriter({}).write(field); }

}  // namespace hauberk
