#pragma once
/// Files that are read whole.

#include <cstddef>
#include <string>

namespace hauberk {

/// Largest experiment, weave or template, and largest results, in megabytes.
inline constexpr std::size_t largest_text = 64, largest_results = 1024;

/// What is in a file. Throws InputError "cannot read 'x.json': ..." where there is none, where it is no
/// regular file (a device or a pipe might never end, or never begin), where it cannot be opened, and beyond
/// `megabytes`, also where it grows beyond them while it is read. Thread safe.
std::string read_whole_file(const std::string& path, std::size_t megabytes);

}  // namespace hauberk
