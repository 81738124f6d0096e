#pragma once
/// Loads one plugin library and hands out its checked tables.

#include <hauberk/plugin.hpp>

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace hauberk {

/// A loaded library. It stays in memory until the program ends, whatever happens to this object: code and
/// constants of a plugin may be referred to from anywhere.
class PluginLibrary {
 public:
  /// Loads `file` (all symbols resolved now, none shared with other libraries), checks handshake and table:
  /// of its one plugin, `hauberk_plugin`, or of each of several (hauberk/kit/plugin_table.hpp). Where one of
  /// them is wrong, or two have one id, the library is. What can be read from the file (another format or
  /// machine, no entry, a sanitizer this program lacks) is checked first, so that no code of such a library
  /// runs; static constructors are tried in a child process, so that one that throws is an error. Throws
  /// PluginError that names the file, what was found and the way out. Thread safe.
  static PluginLibrary load(const std::filesystem::path& file);

  /// Whether the file exports a list of plugins, whose ids are not the file's name. Only looks at the file,
  /// and says no of what it cannot read. Thread safe.
  static bool has_several(const std::filesystem::path& file);

  /// At least one, in the order of the library.
  std::span<const PluginTable* const> tables() const { return tables_; }
  /// The table of plugin `id`. Empty: that of the only plugin. Throws InputError that names the plugins of
  /// the library where it has no such one, or several and none is named.
  const PluginTable& table(std::string_view id = {}) const;
  const std::filesystem::path& file() const { return file_; }

 private:
  PluginLibrary(std::filesystem::path file, std::vector<const PluginTable*> tables)
      : file_(std::move(file)), tables_(std::move(tables))
  {
  }

  std::filesystem::path file_;
  std::vector<const PluginTable*> tables_;
};

}  // namespace hauberk
