#include "extends.hpp"

#include "document/diagnostics.hpp"
#include "document/jsonc.hpp"
#include "document/read_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

namespace hauberk {
namespace {

constexpr const char* key = "extends";
/// Files that extend each other in a row.
constexpr int most_files = 8;

class Extension {
 public:
  explicit Extension(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  bool extend(Node& root, const std::string& file, int depth)
  {
    const std::optional<Node> named = take_out(root);
    if (!named) return true;
    if (depth == 0) here_ = *named;
    const std::string place = depth == 0 ? "" : fmt::format("{}:{}: ", file, named->line);
    if (!named->is(Node::Type::string)) return refuse(place + "expected the path of a file");
    if (depth == most_files)
      return refuse(
          fmt::format("{}{} files extend each other in a row: is there a circle?", place, most_files));
    const std::string path =
        (std::filesystem::path(file).parent_path() / named->string).lexically_normal().string();
    std::optional<Node> base = read(place, path);
    if (!base || !extend(*base, path, depth + 1)) return false;
    join(*base, root, path);
    return true;
  }

 private:
  static std::optional<Node> take_out(Node& root)
  {
    const auto at = std::find_if(root.members.begin(), root.members.end(),
                                 [](const auto& member) { return member.first == key; });
    if (at == root.members.end()) return std::nullopt;
    Node out = std::move(at->second);
    root.members.erase(at);
    return out;
  }

  bool refuse(std::string message)
  {
    diagnostics_.problems.add(here_, std::move(message));
    return false;
  }

  std::optional<Node> read(const std::string& place, const std::string& path)
  {
    Problems problems;
    std::optional<Node> base;
    try {
      base = read_jsonc(read_whole_file(path, largest_text), problems);
    } catch (const InputError& error) {
      refuse(place + error.what());
      return std::nullopt;
    }
    for (const Problem& p : problems.list()) refuse(fmt::format("{}:{}: {}", path, p.line, p.message));
    if (base && !base->is(Node::Type::object)) {
      refuse(path + ": expected an object");
      return std::nullopt;
    }
    if (!problems.empty()) return std::nullopt;
    constexpr std::array<std::string_view, 4> own{"$schema", "name", "description", "expect"};
    std::erase_if(base->members, [&](const auto& member) {
      return std::find(own.begin(), own.end(), member.first) != own.end();
    });
    return base;
  }

  /// `over` becomes what it says over `base`.
  void join(Node& base, Node& over, const std::string& path)
  {
    std::vector<std::pair<std::string, Node>> joined;
    for (auto& [name, value] : base.members) {
      const auto own = std::find_if(over.members.begin(), over.members.end(),
                                    [&name = name](const auto& member) { return member.first == name; });
      if (own == over.members.end()) {
        diagnostics_.inherited.emplace_back(value.pointer, path);
        joined.emplace_back(name, std::move(value));
        continue;
      }
      if (own->second.is(Node::Type::object) && value.is(Node::Type::object))
        join(value, own->second, path);
      else
        forget(own->second.pointer);
      if (!own->second.is(Node::Type::null)) joined.emplace_back(name, std::move(own->second));
      over.members.erase(own);
    }
    for (auto& member : joined) over.members.push_back(std::move(member));
  }

  /// What is below a place comes from no other file.
  void forget(const std::string& pointer)
  {
    std::erase_if(diagnostics_.inherited,
                  [&](const auto& entry) { return pointer_within(entry.first, pointer); });
  }

  Diagnostics& diagnostics_;
  Node here_;  ///< the key of the file itself
};

}  // namespace

bool extend(Node& root, const std::string& file, Diagnostics& diagnostics)
{
  return Extension(diagnostics).extend(root, file, 0);
}

}  // namespace hauberk
