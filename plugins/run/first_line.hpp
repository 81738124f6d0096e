#pragma once
/// Files of the system that are a line.

#include <filesystem>
#include <fstream>
#include <string>

namespace hauberk {

/// The first line of a file of the system's, as those of /proc and /sys; empty where it cannot be read.
inline std::string first_line(const std::filesystem::path& file)
{
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace hauberk
