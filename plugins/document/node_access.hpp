#pragma once
/// Reading checked nodes: what was wrong has been removed, so everything may be absent.

#include <hauberk/section.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace hauberk {

inline double number_or(const Node& section, std::string_view key, double otherwise)
{
  const Node* node = section.find(key);
  return node != nullptr && node->is(Node::Type::number) ? node->number : otherwise;
}

inline int int_or(const Node& section, std::string_view key, int otherwise)
{
  return static_cast<int>(number_or(section, key, otherwise));
}

inline std::string string_or(const Node& section, std::string_view key, const std::string& otherwise)
{
  const Node* node = section.find(key);
  return node != nullptr && node->is(Node::Type::string) ? node->string : otherwise;
}

inline bool boolean_or(const Node& section, std::string_view key, bool otherwise)
{
  const Node* node = section.find(key);
  return node != nullptr && node->is(Node::Type::boolean) ? node->boolean : otherwise;
}

inline std::optional<std::string> optional_string(const Node& section, std::string_view key)
{
  const Node* node = section.find(key);
  return node != nullptr && node->is(Node::Type::string) ? std::optional(node->string) : std::nullopt;
}

inline std::optional<double> optional_number(const Node& section, std::string_view key)
{
  const Node* node = section.find(key);
  return node != nullptr && node->is(Node::Type::number) ? std::optional(node->number) : std::nullopt;
}

inline std::optional<int> optional_int(const Node& section, std::string_view key)
{
  const std::optional<double> value = optional_number(section, key);
  return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
}

inline std::uint64_t seed_or(const Node& section, std::string_view key, std::uint64_t otherwise)
{
  const std::optional<double> value = optional_number(section, key);
  return value ? static_cast<std::uint64_t>(*value) : otherwise;
}

/// Member `key` of an object, null when absent or not of type `type`.
inline const Node* find_typed(const Node& section, std::string_view key, Node::Type type)
{
  const Node* node = section.find(key);
  return node != nullptr && node->is(type) ? node : nullptr;
}

inline Node number_node(double value)
{
  Node node;
  node.type = Node::Type::number;
  node.number = value;
  return node;
}

inline Node string_node(std::string value)
{
  Node node;
  node.type = Node::Type::string;
  node.string = std::move(value);
  return node;
}

template <class Numbers>
Node numbers_node(const Numbers& values)
{
  Node node;
  node.type = Node::Type::array;
  for (const double value : values) node.items.push_back(number_node(value));
  return node;
}

inline Node object_node()
{
  Node node;
  node.type = Node::Type::object;
  return node;
}

/// Member `key` of an object that may be changed, null when absent.
inline Node* find_mutable(Node& section, std::string_view key)
{
  return const_cast<Node*>(section.find(key));
}

/// Sets member `key`, unless it is there.
inline void set_default(Node& section, const std::string& key, Node value)
{
  if (section.find(key) == nullptr) section.members.emplace_back(key, std::move(value));
}

}  // namespace hauberk
