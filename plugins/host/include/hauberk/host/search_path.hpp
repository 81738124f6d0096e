#pragma once
/// Where plugins and data are looked for.

#include <filesystem>
#include <span>
#include <vector>

namespace hauberk {

/// Folders to search, in order, absolute, each once: `command_line` (--plugin-path), then the entries of
/// `environment` (value of HAUBERK_PLUGIN_PATH, colon separated; may be null), then ../lib/hauberk/plugins
/// seen from the folder of `executable`. The current directory is never searched on its own: empty entries of
/// the environment are skipped. Throws InputError for a folder on the command line that does not exist, and
/// for a relative entry of the environment. Folders of the other two kinds need not exist.
std::vector<std::filesystem::path> plugin_search_path(std::span<const std::filesystem::path> command_line,
                                                      const char* environment,
                                                      const std::filesystem::path& executable);

/// The same with this process's environment and executable.
std::vector<std::filesystem::path> plugin_search_path(std::span<const std::filesystem::path> command_line);

/// Those of them that this process searches whatever its command line and environment are.
std::vector<std::filesystem::path> own_plugin_folders();

/// ../share/hauberk seen from the folder of this process's executable: data that belong to the program.
std::filesystem::path shared_data_folder();

}  // namespace hauberk
