#include <hauberk/error.hpp>
#include <hauberk/host/search_path.hpp>

#include <fmt/format.h>
#include <boost/dll/runtime_symbol_info.hpp>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

void add(std::vector<fs::path>& folders, const fs::path& folder)
{
  fs::path path = folder.lexically_normal();
  if (!path.has_filename() && path.has_relative_path()) path = path.parent_path();  // trailing slash
  if (std::find(folders.begin(), folders.end(), path) == folders.end()) folders.push_back(std::move(path));
}

void add_environment(std::vector<fs::path>& folders, std::string_view entries)
{
  while (!entries.empty()) {
    const std::size_t length = std::min(entries.find(':'), entries.size());
    const fs::path entry(entries.substr(0, length));
    entries.remove_prefix(std::min(length + 1, entries.size()));
    if (entry.empty()) continue;  // elsewhere this means the current directory; here it never does
    if (entry.is_relative()) {
      throw InputError(fmt::format(
          "HAUBERK_PLUGIN_PATH: '{}' is a relative path; expected absolute folders separated by colons",
          entry.native()));
    }
    add(folders, entry);
  }
}

}  // namespace

std::vector<fs::path> plugin_search_path(std::span<const fs::path> command_line, const char* environment,
                                         const fs::path& executable)
{
  std::vector<fs::path> folders;
  for (const fs::path& folder : command_line) {
    std::error_code ignored;
    if (folder.empty() || !fs::is_directory(folder, ignored)) {
      throw InputError(fmt::format("--plugin-path: '{}' is not a folder", folder.native()));
    }
    add(folders, fs::absolute(folder));
  }
  if (environment) add_environment(folders, environment);
  add(folders, executable.parent_path().parent_path() / "lib" / "hauberk" / "plugins");
  return folders;
}

std::vector<fs::path> plugin_search_path(std::span<const fs::path> command_line)
{
  // The location is that of the file itself, not of a link on PATH that points to it.
  return plugin_search_path(command_line, std::getenv("HAUBERK_PLUGIN_PATH"),
                            fs::canonical(boost::dll::program_location()));
}

std::vector<fs::path> own_plugin_folders()
{
  return plugin_search_path({}, nullptr, fs::canonical(boost::dll::program_location()));
}

fs::path shared_data_folder()
{
  return fs::canonical(boost::dll::program_location()).parent_path().parent_path() / "share" / "hauberk";
}

}  // namespace hauberk
