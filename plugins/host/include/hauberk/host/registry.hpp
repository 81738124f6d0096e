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

/// One plugin in a searched folder, or a library that cannot be used.
struct PluginEntry {
  std::string id;  ///< file name without ending, or that of one of a library of several
  std::filesystem::path file;
  const PluginTable* table = nullptr;  ///< null when broken or shadowed
  std::string problem = {};            ///< why it cannot be used; empty when it can, or when shadowed
  /// The file of an earlier folder that is used instead.
  std::optional<std::filesystem::path> shadowed_by = {};
};

/// Plugins of a list of folders. A plugin is the file ID.so, or one of those that a library of several has in
/// its list, whatever its name; in the first folder that has it, it is used, and those of that id in later
/// folders are shadowed. In one folder ID.so comes first, then libraries of several by their names. Loads a
/// library when it is first asked for, each once: `find` those of several in a folder that has no file ID.so,
/// `files` and `list` all of them. All calls are thread safe.
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

  /// The files that have that plugin, in the order of folders: the first one is used, the others are shadowed
  /// by it.
  std::vector<std::filesystem::path> files(std::string_view id) const;

 private:
  struct Loaded {
    std::vector<const PluginTable*> tables;  ///< empty: it cannot be used
    std::string problem;
    const PluginTable* find(std::string_view id) const;  ///< null: it has none of that id
    std::string why_not(const std::filesystem::path& file, std::string_view id) const;  ///< where it is null
  };
  const Loaded& load(const std::filesystem::path& file) const;
  /// The libraries of several plugins in a folder, by their names, as they were when first asked for.
  const std::vector<std::filesystem::path>& lists(const std::filesystem::path& folder) const;
  /// The files of one folder that have the plugin, or the first of them.
  std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder, std::string_view id,
                                              bool first_only) const;
  std::vector<PluginEntry> entries_in(const std::filesystem::path& folder) const;
  [[noreturn]] void report_missing(PluginKind kind, std::string_view id) const;

  std::vector<std::filesystem::path> directories_;
  mutable std::mutex mutex_;
  // Guarded by mutex_; entries never change.
  mutable std::map<std::filesystem::path, Loaded> loaded_;
  mutable std::map<std::filesystem::path, std::vector<std::filesystem::path>> lists_;
};

}  // namespace hauberk
