#include "extends.hpp"

#include "document/diagnostics.hpp"
#include "document/jsonc.hpp"
#include "document/read_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace hauberk {
namespace {

constexpr const char* key = "extends";
/// Files that extend each other in a row.
constexpr int most_files = Place::most_others;

class Extension {
 public:
  explicit Extension(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  bool extend(Node& root, const std::string& file, int depth)
  {
    const std::optional<Node> named = take_out(root);
    if (!named) return true;
    if (depth == 0) here_ = *named;
    const std::string place = depth == 0 ? "" : fmt::format("{}:{}: ", file, Place::of(named->line).line);
    if (!named->is(Node::Type::string)) return refuse(place + "expected the path of a file");
    if (depth == most_files)
      return refuse(
          fmt::format("{}{} files extend each other in a row: is there a circle?", place, most_files));
    if (named->string.find('\0') != std::string::npos)
      return refuse(place + "expected the path of a file, found a character that no path has");
    // As the system walks it: with links to folders, "a/.." need not be here.
    const std::string path = (std::filesystem::path(file).parent_path() / named->string).string();
    std::optional<Node> base = read(place, path);
    if (!base || !extend(*base, path, depth + 1)) return false;
    join(*base, root);
    if (depth == 0) drop_nulls(root);
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
    diagnostics_.others.push_back(path);
    number_lines(*base);
    constexpr std::array<std::string_view, 4> own{"$schema", "name", "description", "expect"};
    std::erase_if(base->members, [&](const auto& member) {
      return std::find(own.begin(), own.end(), member.first) != own.end();
    });
    return base;
  }

  /// `over` becomes what it says over `base`, whose order stays; keys of its own come first.
  static void join(Node& base, Node& over)
  {
    std::vector<std::pair<std::string, Node>> joined;
    for (auto& [name, value] : base.members) {
      const auto own = std::find_if(over.members.begin(), over.members.end(),
                                    [&name = name](const auto& member) { return member.first == name; });
      if (own == over.members.end()) {
        joined.emplace_back(name, std::move(value));
        continue;
      }
      if (own->second.is(Node::Type::object) && value.is(Node::Type::object)) join(value, own->second);
      joined.push_back(std::move(*own));
      over.members.erase(own);
    }
    over.members.insert(over.members.end(), std::make_move_iterator(joined.begin()),
                        std::make_move_iterator(joined.end()));
  }

  /// What takes a key away, also where there is none.
  static void drop_nulls(Node& object)
  {
    std::erase_if(object.members, [](const auto& member) { return member.second.is(Node::Type::null); });
    for (auto& [name, value] : object.members) drop_nulls(value);
  }

  /// Lines of the file that is the newest of `others`.
  void number_lines(Node& node) const
  {
    node.line = Place{static_cast<int>(diagnostics_.others.size()) - 1, node.line}.encoded();
    for (Node& item : node.items) number_lines(item);
    for (auto& [name, value] : node.members) number_lines(value);
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
