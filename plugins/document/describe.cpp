#include "document/check.hpp"
#include "document/json_writer.hpp"

#include <cmath>

namespace hauberk {

namespace {

std::string join(const std::vector<std::string>& words, const std::string& between)
{
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

/// " >= 0", " > 0", " in [0, 1]", " in (0, 1]" or nothing.
std::string range(const Field& field)
{
  // The ends of the integer types are nobody's business.
  const double largest =
      field.kind == Field::Kind::integer ? 2147483647.0 : std::numeric_limits<double>::max();
  const bool below = field.minimum >= -largest;
  const bool above = field.maximum < largest;
  if (below && above) {
    return std::string(" in ") + (field.exclusive_minimum ? "(" : "[") + format_number(field.minimum) + ", " +
           format_number(field.maximum) + "]";
  }
  if (below) return (field.exclusive_minimum ? " > " : " >= ") + format_number(field.minimum);
  if (above) return " <= " + format_number(field.maximum);
  return "";
}

/// "an array of 2 numbers", "an array of at least 1 strings".
std::string array_of(const Field& field, const std::string& items)
{
  constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  std::string count;
  if (field.min_items == field.max_items)
    count = std::to_string(field.min_items) + " ";
  else if (field.max_items != unlimited)
    count = std::to_string(field.min_items) + " to " + std::to_string(field.max_items) + " ";
  else if (field.min_items > 0)
    count = "at least " + std::to_string(field.min_items) + " ";
  return "an array of " + count + items;
}

std::string plural(const Field& item)
{
  switch (item.kind) {
    case Field::Kind::number:
      return "numbers" + range(item);
    case Field::Kind::integer:
      return "integers" + range(item);
    case Field::Kind::string:
      return "strings";
    case Field::Kind::object:
      return "objects";
    case Field::Kind::numbers:
      return "arrays of " + std::to_string(item.min_items) + " numbers";
    case Field::Kind::choice:
      return "names out of " + join(item.choices, ", ");
    default:
      return "values";
  }
}

}  // namespace

std::string describe_expected(const Field& field)
{
  switch (field.kind) {
    case Field::Kind::number:
      return field.minimum == field.maximum ? format_number(field.minimum) : "a number" + range(field);
    case Field::Kind::integer:
      return "an integer" + range(field);
    case Field::Kind::boolean:
      return "true or false";
    case Field::Kind::string:
      return "a string";
    case Field::Kind::choice:
      return (field.choices.size() > 1 ? "one of " : "") + join(field.choices, ", ");
    case Field::Kind::numbers:
      return array_of(field, "numbers" + range(field));
    case Field::Kind::list:
      return array_of(field, field.children.empty() ? "values" : plural(field.children[0]));
    case Field::Kind::object:
    case Field::Kind::map:
      return "an object";
    case Field::Kind::any:
      return "a value";
    case Field::Kind::any_of:
      break;
  }
  std::vector<std::string> options;
  for (const Field& child : field.children) options.push_back(describe_expected(child));
  return join(options, " or ");
}

std::string describe_found(const Node& node)
{
  switch (node.type) {
    case Node::Type::null:
      return "null";
    case Node::Type::boolean:
      return node.boolean ? "true" : "false";
    case Node::Type::number:
      return format_number(node.number);
    case Node::Type::object:
      return "an object";
    case Node::Type::array:
      if (node.items.empty()) return "an empty array";
      return "an array of " + std::to_string(node.items.size()) +
             (node.items.size() == 1 ? " value" : " values");
    case Node::Type::string:
      break;
  }
  constexpr std::size_t longest = 60;
  if (node.string.size() <= longest) return quote_json(node.string);
  std::size_t cut = longest;
  while (cut > 0 && (static_cast<unsigned char>(node.string[cut]) & 0xC0u) == 0x80u)
    --cut;  // whole characters
  return quote_json(node.string.substr(0, cut)) + "...";
}

}  // namespace hauberk
