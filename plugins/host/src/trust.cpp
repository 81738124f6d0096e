#include <hauberk/host/trust.hpp>

#include <fmt/format.h>

#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <system_error>

namespace hauberk {
namespace {

/// Whose hand it is that can write; empty: nobody else's.
std::string foreign_writer(const std::filesystem::path& path)
{
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return {};
  if ((info.st_mode & S_IWOTH) != 0) return "everybody";
  if ((info.st_mode & S_IWGRP) != 0 && info.st_gid != ::getegid() && info.st_gid != 0)
    return fmt::format("the group {}", info.st_gid);
  if (info.st_uid != ::geteuid() && info.st_uid != 0) return fmt::format("the user {}", info.st_uid);
  return {};
}

}  // namespace

std::vector<std::string> open_to_others(std::span<const std::filesystem::path> folders)
{
  std::vector<std::string> out;
  const auto look = [&out](const char* what, const std::filesystem::path& path) {
    const std::string writer = foreign_writer(path);
    if (writer.empty()) return;
    out.push_back(fmt::format(
        "{} '{}' can be written by {}, who thereby decides what this program runs; mend its owner "
        "and permissions (chmod go-w)",
        what, path.native(), writer));
  };
  for (const std::filesystem::path& folder : folders) {
    look("the plugin folder", folder);
    std::error_code error;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
         it.increment(error)) {
      if (it->path().extension() == ".so") files.push_back(it->path());
    }
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) look("the plugin", file);
  }
  return out;
}

}  // namespace hauberk
