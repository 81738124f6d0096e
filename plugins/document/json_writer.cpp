#include "document/json_writer.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace hauberk {

namespace {

constexpr std::size_t line_width = 100;

bool is_container(const Node& node)
{
  return (node.is(Node::Type::array) && !node.items.empty()) ||
         (node.is(Node::Type::object) && !node.members.empty());
}

/// True when every value in the container is a scalar or (in arrays) a short array of scalars.
bool is_flat(const Node& node, int levels)
{
  for (const Node& item : node.items) {
    if (is_container(item) && (levels == 0 || item.is(Node::Type::object) || !is_flat(item, levels - 1)))
      return false;
  }
  for (const auto& [key, value] : node.members) {
    if (is_container(value) && (levels == 0 || value.is(Node::Type::object) || !is_flat(value, levels - 1)))
      return false;
  }
  return true;
}

std::string one_line(const Node& node)
{
  switch (node.type) {
    case Node::Type::null:
      return "null";
    case Node::Type::boolean:
      return node.boolean ? "true" : "false";
    case Node::Type::number:
      return format_number(node.number);
    case Node::Type::string:
      return quote_json(node.string);
    case Node::Type::array: {
      std::string out = "[";
      for (const Node& item : node.items) out += (out.size() > 1 ? ", " : "") + one_line(item);
      return out + "]";
    }
    case Node::Type::object: {
      std::string out = "{";
      for (const auto& [key, value] : node.members) {
        out += (out.size() > 1 ? ", " : " ") + quote_json(key) + ": " + one_line(value);
      }
      return out + (node.members.empty() ? "}" : " }");
    }
  }
  return "null";
}

void write(const Node& node, std::size_t indent, std::string& out)
{
  if (!is_container(node)) {
    out += one_line(node);
    return;
  }
  if (is_flat(node, 1)) {
    if (std::string line = one_line(node); line.size() + indent <= line_width) {
      out += line;
      return;
    }
  }
  const std::string inner(indent + 2, ' ');
  bool first = true;
  const auto next = [&] {
    out += first ? "\n" : ",\n";
    out += inner;
    first = false;
  };
  if (node.is(Node::Type::array)) {
    out += "[";
    for (const Node& item : node.items) {
      next();
      write(item, indent + 2, out);
    }
    out += "\n" + std::string(indent, ' ') + "]";
  } else {
    out += "{";
    for (const auto& [key, value] : node.members) {
      next();
      out += quote_json(key) + ": ";
      write(value, indent + 2, out);
    }
    out += "\n" + std::string(indent, ' ') + "}";
  }
}

}  // namespace

std::string format_number(double value)
{
  char buffer[64];
  const bool plain =
      value == std::floor(value) && std::abs(value) < 1e15 && !(value == 0.0 && std::signbit(value));
  const auto result = plain ? std::to_chars(buffer, buffer + sizeof buffer, static_cast<std::int64_t>(value))
                            : std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, result.ptr);
}

std::string quote_json(const std::string& text)
{
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (byte < 0x20) {
      out += "\\u00";
      out += digits[byte >> 4];
      out += digits[byte & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string write_json(const Node& node)
{
  std::string out;
  write(node, 0, out);
  return out;
}

}  // namespace hauberk
