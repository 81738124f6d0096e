#pragma once
/// Files that shapes are read from, by lines and words.

#include <string>
#include <string_view>

namespace hauberk::detail {

/// What is in a file of at most `megabytes`. Throws InputError that begins with the path where it cannot be
/// read, is larger, or is not a regular file: a device or a pipe might never end.
std::string read_bytes(const std::string& path, int megabytes);

/// What the name of a file ends with, in small letters: ".obj"; empty where it has no dot.
std::string ending_of(const std::string& path);

/// Reads a number that is the whole of `word`; false if it is none, or not finite.
bool read_number(std::string_view word, double& value);

/// Cuts the next word off a line; empty at its end.
std::string_view next_word(std::string_view& line);

/// Cuts the next line off a text, without what ends it.
std::string_view next_line(std::string_view& text);

/// A word of the file for messages: short, and printable.
std::string quoted(std::string_view word);

}  // namespace hauberk::detail
