#pragma once
/// Reading JSON with comments and trailing commas into a Node tree that knows the place of every value.
///
/// Boost.JSON, used for everything that is written, keeps no line numbers and silently keeps the last of
/// duplicate keys; experiment files are written by people, who need both.

#include <hauberk/section.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace hauberk {

/// Deepest nesting of arrays and objects that is read.
inline constexpr int max_json_depth = 64;

/// Parses `text`: JSON (RFC 8259, UTF-8) plus // and /* */ comments and trailing commas. Every node gets its
/// 1-based line and its RFC 6901 pointer; `base` is the pointer of the root.
///
/// Duplicate keys (the first is kept) and numbers that are not finite (not-a-number is kept, which
/// check_fields drops without a second message) are problems, and reading goes on. A syntax error, invalid
/// UTF-8 or nesting deeper than max_json_depth ends reading: null is returned, and the last problem gives
/// line, column (1-based, in characters), what was expected and what was found. Thread safe.
std::optional<Node> read_jsonc(std::string_view text, Problems& problems, const std::string& base = "");

/// `key` as one reference token of a JSON pointer: "~" becomes "~0", "/" becomes "~1".
std::string pointer_token(std::string_view key);

/// The reverse of pointer_token.
std::string pointer_key(std::string_view token);

/// True when `pointer` is `root` or lies below it.
bool pointer_within(std::string_view pointer, std::string_view root);

/// Gives `node` the pointer `base` and everything below it the matching pointers, and line `line` throughout.
void relocate(Node& node, const std::string& base, int line);

}  // namespace hauberk
