#pragma once
/// Finds plugins by id.

#include <hauberk/host/plugin_library.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// "a shape", "a load case", "an optimizer".
std::string with_article(PluginKind kind);

/// One library file in a searched folder.
struct PluginEntry {
  std::string id;  ///< file name without ending
  std::filesystem::path file;
  const PluginTable* table = nullptr;  ///< null when broken or shadowed
  std::string problem;                 ///< why it cannot be used; empty when it can, or when shadowed
  std::optional<std::filesystem::path> shadowed_by;  ///< the file of an earlier folder that is used instead
};

/// Plugins of a list of folders. A plugin is the file ID.so; in the first folder that has it, it is used,
/// and files of that name in later folders are shadowed. Loads a library when it is first asked for, each
/// once. All calls are thread safe.
class Registry {
 public:
  /// `directories` as from plugin_search_path; those that do not exist are passed over.
  explicit Registry(std::vector<std::filesystem::path> directories);

  const std::vector<std::filesystem::path>& directories() const { return directories_; }

  /// Everything found, loaded and checked, in the order of folders, then of ids. Broken libraries are among
  /// the entries and do not stop the rest.
  std::vector<PluginEntry> list() const;

  /// The checked table of plugin `id`, valid until the program ends. Throws InputError when the id is
  /// malformed, when no folder has it (names the folders and the nearest id of that kind), when it is of
  /// another kind, or when the library cannot be used (with the reason).
  const PluginTable& find(PluginKind kind, std::string_view id) const;

  /// The files of that name, in the order of folders: the first one is used, the others are shadowed by it.
  std::vector<std::filesystem::path> files(std::string_view id) const;

 private:
  struct Loaded {
    const PluginTable* table = nullptr;
    std::string problem;
  };
  const Loaded& load(const std::filesystem::path& file) const;
  [[noreturn]] void report_missing(PluginKind kind, std::string_view id) const;

  std::vector<std::filesystem::path> directories_;
  mutable std::mutex mutex_;
  mutable std::map<std::filesystem::path, Loaded> loaded_;  ///< guarded by mutex_; entries never change
};

}  // namespace hauberk
