#pragma once
/// Loads one plugin library and hands out its checked table.

#include <hauberk/plugin.hpp>

#include <filesystem>

namespace hauberk {

/// A loaded plugin. The library stays in memory until the program ends, whatever happens to this object:
/// code and constants of a plugin may be referred to from anywhere.
class PluginLibrary {
 public:
  /// Loads `file` (all symbols resolved now, none shared with other libraries), checks handshake and table.
  /// What can be read from the file (another format or machine, no entry, a sanitizer this program lacks) is
  /// checked first, so that no code of such a library runs; static constructors are tried in a child process,
  /// so that one that throws is an error. Throws PluginError that names the file, what was found and the way
  /// out. Thread safe.
  static PluginLibrary load(const std::filesystem::path& file);

  const PluginTable& table() const { return *table_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  PluginLibrary(std::filesystem::path file, const PluginTable& table) : file_(std::move(file)), table_(&table)
  {
  }

  std::filesystem::path file_;
  const PluginTable* table_;
};

}  // namespace hauberk
