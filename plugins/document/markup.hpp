#pragma once
/// What pages and drawings are written with.

#include "document/plain_text.hpp"

#include <string>
#include <string_view>

namespace hauberk {

/// Plain text with the characters that mean something in XML and HTML replaced.
std::string xml_escape(std::string_view text, LineBreaks line_breaks = LineBreaks::shown);

/// Bytes in base64 (RFC 4648), as they stand in a `data:` address.
std::string base64(std::string_view bytes);

}  // namespace hauberk
