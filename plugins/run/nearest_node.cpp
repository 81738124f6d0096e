#include "run/nearest_node.hpp"

#include "document/jsonc.hpp"

#include <algorithm>
#include <string>

namespace hauberk {

const Node& nearest_node(const Node& root, std::string_view pointer)
{
  const Node* node = &root;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    const std::size_t end = std::min(pointer.find('/'), pointer.size());
    const std::string key = pointer_key(pointer.substr(0, end));
    pointer.remove_prefix(end);
    const Node* next = node->find(key);
    if (node->is(Node::Type::array)) {
      const std::size_t index = std::stoul(key);
      next = index < node->items.size() ? &node->items[index] : nullptr;
    }
    if (next == nullptr) break;
    node = next;
  }
  return *node;
}

}  // namespace hauberk
