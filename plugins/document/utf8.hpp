#pragma once
/// Places in text of bytes, and whether these are UTF-8.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hauberk {

struct InvalidUtf8 {
  int line;            ///< 1-based
  std::size_t column;  ///< 1-based, in characters
  std::string byte;    ///< "0xff"
};

/// First byte that cannot stand in UTF-8 (overlong forms, surrogates and code points above 0x10ffff
/// included).
std::optional<InvalidUtf8> find_invalid_utf8(std::string_view text);

/// Characters (code points) of valid UTF-8.
std::size_t count_characters(std::string_view text);

/// The first character of valid, non-empty UTF-8.
std::string_view first_character(std::string_view text);

/// Appends a code point that is no surrogate.
void append_utf8(std::string& out, unsigned code);

}  // namespace hauberk
