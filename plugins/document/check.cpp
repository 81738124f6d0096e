#include "document/check.hpp"

#include "document/json_writer.hpp"
#include "document/jsonc.hpp"
#include "document/merge_fields.hpp"

#include <hauberk/error.hpp>
#include <hauberk/suggestion.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {

namespace {

/// What to take instead of a word that a field does not know: one that people may remember, or one that they
/// meant.
std::string instead_of(const Field& field, const std::string& word)
{
  if (field.name == "preset" && word == "fast")
    return "; it took as long as accurate: leave preset away, or set tolerance to 1e-3 for gaps as wide";
  return did_you_mean(word, field.choices);
}

using Kind = Field::Kind;
using Type = Node::Type;

bool accepts(Kind kind, Type type)
{
  switch (kind) {
    case Kind::number:
    case Kind::integer:
      return type == Type::number;
    case Kind::boolean:
      return type == Type::boolean;
    case Kind::string:
    case Kind::choice:
      return type == Type::string;
    case Kind::numbers:
    case Kind::list:
      return type == Type::array;
    case Kind::object:
    case Kind::map:
      return type == Type::object;
    case Kind::any_of:
    case Kind::any:
      return true;
  }
  return false;
}

class Checker {
 public:
  Checker(Problems& problems, const ExtraFieldsOf& extra) : problems_(problems), extra_(extra) {}

  bool check(Node& node, const Field& field)
  {
    if (!accepts(field.kind, node.type)) return mismatch(node, field);
    switch (field.kind) {
      case Kind::number:
      case Kind::integer:
        return check_number(node, field);
      case Kind::choice:
        return check_choice(node, field);
      case Kind::numbers:
        return check_numbers(node, field);
      case Kind::list:
        return check_list(node, field);
      case Kind::map:
        return check_map(node, field);
      case Kind::object:
        return check_object(node, field);
      case Kind::any_of:
        return check_any_of(node, field);
      case Kind::any:
        return !node.is(Type::number) || std::isfinite(node.number);
      case Kind::boolean:
      case Kind::string:
        break;
    }
    return true;
  }

 private:
  Problems& problems_;
  const ExtraFieldsOf& extra_;

  /// Of text that was meant as an expression how one is written: those that begin with $ or = are numbers
  /// here.
  static std::string hint_of_expression(const Node& node)
  {
    const bool meant = node.is(Type::string) && node.string.find('$') != std::string::npos;
    return meant ? "; an expression begins with = or $: " + quote_json("=" + node.string) : "";
  }

  bool mismatch(const Node& node, const Field& field, const std::string& hint = "")
  {
    problems_.add(node, "expected " + describe_expected(field) + ", found " + describe_found(node) +
                            (hint.empty() ? hint_of_expression(node) : hint));
    return false;
  }

  static bool in_range(double value, const Field& field)
  {
    return value <= field.maximum &&
           (field.exclusive_minimum ? value > field.minimum : value >= field.minimum);
  }

  bool check_number(const Node& node, const Field& field)
  {
    if (!std::isfinite(node.number)) return false;  // reported when it was read
    const bool whole = field.kind != Kind::integer || node.number == std::floor(node.number);
    return (whole && in_range(node.number, field)) || mismatch(node, field);
  }

  bool check_choice(const Node& node, const Field& field)
  {
    if (std::find(field.choices.begin(), field.choices.end(), node.string) != field.choices.end())
      return true;
    return mismatch(node, field, instead_of(field, node.string));
  }

  bool check_count(const Node& node, const Field& field, std::size_t count)
  {
    return (count >= field.min_items && count <= field.max_items) || mismatch(node, field);
  }

  bool check_numbers(const Node& node, const Field& field)
  {
    Field item = field;
    item.kind = Kind::number;
    bool good = check_count(node, field, node.items.size());
    for (const Node& value : node.items) {
      good &= value.is(Type::number) ? check_number(value, item) : mismatch(value, item);
    }
    return good;
  }

  bool check_list(Node& node, const Field& field)
  {
    bool good = check_count(node, field, node.items.size());
    if (field.children.empty()) return good;
    for (Node& item : node.items) good &= check(item, field.children[0]);
    return good;
  }

  bool check_map(Node& node, const Field& field)
  {
    if (node.members.size() < field.min_items) {
      problems_.add(node, "expected at least " + std::to_string(field.min_items) +
                              (field.min_items == 1 ? " entry" : " entries") + ", found " +
                              (node.members.empty() ? "none" : std::to_string(node.members.size())));
    }
    if (field.children.empty()) return true;
    std::erase_if(node.members, [&](auto& member) { return !check(member.second, field.children[0]); });
    return true;
  }

  bool check_any_of(Node& node, const Field& field)
  {
    const Field* first = nullptr;
    for (const Field& child : field.children) {
      if (!accepts(child.kind, node.type)) continue;
      if (first == nullptr) first = &child;
      // Options that share a JSON type: the first without problems is meant.
      Node copy = node;
      Problems attempt;
      if (Checker(attempt, extra_).check(copy, child) && attempt.empty()) {
        node = std::move(copy);
        return true;
      }
    }
    return first == nullptr ? mismatch(node, field) : check(node, *first);
  }

  bool check_object(Node& node, const Field& field)
  {
    const ExtraFields extra = extra_ ? extra_(field, node, problems_) : ExtraFields{};
    const std::vector<Field> children = merge_fields(field.children, extra.fields);
    std::vector<std::string> known;
    known.reserve(children.size());
    for (const Field& child : children) known.push_back(child.name);

    std::vector<std::string> given;
    std::erase_if(node.members, [&](auto& member) {
      const std::string& key = member.first;
      Node& value = member.second;
      given.push_back(key);
      const auto child =
          std::find_if(children.begin(), children.end(), [&](const Field& f) { return f.name == key; });
      if (child != children.end()) return !check(value, *child);
      if (!extra.open) problems_.add(value, "unknown key '" + key + "'" + suggestion(key, known));
      return !extra.open;
    });
    for (const Field& child : children) {
      const bool was_given = std::find(given.begin(), given.end(), child.name) != given.end();
      if (child.required && !was_given) {
        problems_.add(node, "missing key '" + child.name + "': expected " + describe_expected(child));
      }
      if (!child.default_json.empty() && node.find(child.name) == nullptr) fill_default(node, child);
    }
    return true;
  }

  void fill_default(Node& node, const Field& child)
  {
    Node value = default_node(child, node.pointer + "/" + pointer_token(child.name));
    check(value, child);  // nested defaults; what is wrong with a plugin's default is reported like any value
    node.members.emplace_back(child.name, std::move(value));
  }
};

}  // namespace

bool check_fields(Node& node, const Field& field, Problems& problems, const ExtraFieldsOf& extra)
{
  return Checker(problems, extra).check(node, field);
}

Node default_node(const Field& field, const std::string& pointer)
{
  Problems problems;
  std::optional<Node> node = read_jsonc(field.default_json, problems);
  if (!node || !problems.empty()) {
    throw PluginError("the default of field '" + field.name + "' is not valid JSON: " + field.default_json);
  }
  relocate(*node, pointer, 0);
  return std::move(*node);
}

}  // namespace hauberk
