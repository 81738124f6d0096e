#include "document/diagnostics.hpp"
#include "document/jsonc.hpp"

#include <hauberk/experiment/overrides.hpp>

#include <charconv>

namespace hauberk {

namespace {

/// "/a/b~1c" -> {"a", "b/c"}.
std::vector<std::string> split_pointer(const std::string& pointer)
{
  std::vector<std::string> keys;
  std::size_t start = 1;
  for (;;) {
    const std::size_t stop = pointer.find('/', start);
    keys.push_back(pointer_key(std::string_view(pointer).substr(start, stop - start)));
    if (stop == std::string::npos) return keys;
    start = stop + 1;
  }
}

/// The place `key` of a container, created when absent; null when it cannot be.
Node* step_into(Node& parent, const std::string& key, bool& created)
{
  created = false;
  if (parent.is(Node::Type::object)) {
    for (auto& [name, value] : parent.members) {
      if (name == key) return &value;
    }
    created = true;
    parent.members.emplace_back(key, Node{});
    Node& fresh = parent.members.back().second;
    fresh.type = Node::Type::object;
    fresh.pointer = parent.pointer + "/" + pointer_token(key);
    return &fresh;
  }
  if (!parent.is(Node::Type::array)) return nullptr;
  std::size_t index = parent.items.size();
  if (key != "-") {
    const auto result = std::from_chars(key.data(), key.data() + key.size(), index);
    if (result.ec != std::errc() || result.ptr != key.data() + key.size()) return nullptr;
  }
  if (index > parent.items.size()) return nullptr;
  if (index == parent.items.size()) {
    created = true;
    parent.items.emplace_back();
    parent.items.back().type = Node::Type::object;
    parent.items.back().pointer = parent.pointer + "/" + std::to_string(index);
  }
  return &parent.items[index];
}

Node parse_value(const std::string& text)
{
  Problems ignored;
  if (std::optional<Node> node = read_jsonc(text, ignored); node && ignored.empty()) return std::move(*node);
  Node node;
  node.type = Node::Type::string;
  node.string = text;
  return node;
}

/// Where a pointer leads.
struct Reached {
  Node* node = nullptr;             ///< null: it leads nowhere
  std::string first_created;        ///< pointer of the first place that did not exist
  std::string stopped_at, problem;  ///< when it leads nowhere
};

Reached reach(Node& root, const std::string& pointer)
{
  Reached out;
  Node* node = &root;
  for (const std::string& key : split_pointer(pointer)) {
    const Node& parent = *node;
    bool created = false;
    Node* next = step_into(*node, key, created);
    if (next == nullptr) {
      const bool array = parent.is(Node::Type::array);
      out.stopped_at = parent.pointer;
      out.problem = "cannot reach '" + key + "'" +
                    (array ? ": expected an index from 0 to " + std::to_string(parent.items.size())
                           : std::string(": there is no object or array here"));
      return out;
    }
    node = next;
    if (created && out.first_created.empty()) out.first_created = node->pointer;
  }
  out.node = node;
  return out;
}

}  // namespace

std::string set_value(Node& root, const std::string& pointer, const Node& value)
{
  if (!pointer.starts_with('/'))
    return "expected a JSON pointer such as /solver/preset, found '" + pointer + "'";
  const Reached reached = reach(root, pointer);
  if (reached.node == nullptr)
    return (reached.stopped_at.empty() ? "" : reached.stopped_at + ": ") + reached.problem;
  const std::string place = reached.node->pointer;
  *reached.node = value;
  relocate(*reached.node, place, value.line);
  return {};
}

void apply_override(Node& root, const std::string& assignment, Diagnostics& diagnostics)
{
  const auto refuse = [&](const std::string& pointer, const std::string& message) {
    diagnostics.overridden.push_back(pointer);
    diagnostics.problems.add({pointer, 0, message});
  };
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || assignment[0] != '/') {
    refuse("", "--set expects POINTER=VALUE, as in /solver/tolerance=1e-3; found '" + assignment + "'");
    return;
  }
  const Reached reached = reach(root, assignment.substr(0, equals));
  if (reached.node == nullptr) {
    refuse(reached.stopped_at, "--set " + reached.problem);
    return;
  }
  const std::string pointer = reached.node->pointer;
  *reached.node = parse_value(assignment.substr(equals + 1));
  relocate(*reached.node, pointer, 0);
  diagnostics.overridden.push_back(reached.first_created.empty() ? pointer : reached.first_created);
}

}  // namespace hauberk
