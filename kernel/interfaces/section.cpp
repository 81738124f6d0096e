#include <hauberk/section.hpp>

#include <stdexcept>

namespace hauberk {

Node::Node() = default;
Node::~Node() = default;
Node::Node(const Node&) = default;
Node::Node(Node&&) noexcept = default;
Node& Node::operator=(const Node&) = default;
Node& Node::operator=(Node&&) noexcept = default;

const Node* Node::find(std::string_view key) const
{
  if (type != Type::object) return nullptr;
  for (const auto& [name, value] : members) {
    if (name == key) return &value;
  }
  return nullptr;
}

const Node& Node::at(std::string_view key) const
{
  if (const Node* value = find(key)) return *value;
  throw std::out_of_range("no member '" + std::string(key) + "' at '" + pointer + "'");
}

std::vector<double> Node::numbers() const
{
  std::vector<double> result;
  result.reserve(items.size());
  for (const Node& item : items) {
    if (item.type != Type::number) {
      throw std::out_of_range("'" + item.pointer + "' is no number");
    }
    result.push_back(item.number);
  }
  return result;
}

void Problems::add(const Node& where, std::string message)
{
  list_.push_back({where.pointer, where.line, std::move(message)});
}

}  // namespace hauberk
