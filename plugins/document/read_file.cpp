#include "document/read_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace hauberk {

std::string read_whole_file(const std::string& path, std::size_t megabytes)
{
  namespace fs = std::filesystem;
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("cannot read '{}': {}", path, why));
  };
  const auto too_large = [&] { refuse(fmt::format("it is larger than {} MB", megabytes)); };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) refuse("it is a folder; give the file in it");
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse("it is a device or a pipe, which may never end; write what it gives to a file, and give that");
  const std::size_t most = megabytes << 20;
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > most) too_large();
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(errno != 0 ? std::generic_category().message(errno) : "it cannot be opened");
  std::string text, block(1 << 16, '\0');
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > most) too_large();
  }
  if (file.bad()) refuse("reading failed");
  return text;
}

}  // namespace hauberk
