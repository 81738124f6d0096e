#pragma once
/// Text from files and plugins, for places that would obey some of its characters.

#include <string>
#include <string_view>

namespace hauberk {

/// What becomes of line breaks.
enum class LineBreaks { kept, shown };

/// Text in which nothing moves a terminal's cursor or turns its direction: control characters (C0, DEL and C1
/// in UTF-8) and marks that embed, override or isolate a direction of writing (U+202A to U+202E, U+2066 to
/// U+2069) are shown as `\x1b` and `\u{202e}`; bytes that are not UTF-8 as `\xff`. Tabs stay.
std::string plain_text(std::string_view text, LineBreaks line_breaks = LineBreaks::shown);

/// The same of a JSON text, which stays one with the same values: what acts is escaped as `\u202e`.
std::string plain_json(std::string_view text);

}  // namespace hauberk
