#pragma once
/// Reading and writing JSON text without losing a bit of any number.

#include <boost/json/value.hpp>

#include <string>
#include <string_view>

namespace hauberk {

/// Parses strict JSON (no comments, no trailing commas). Unlike boost::json::parse of Boost 1.81, which is
/// off by a unit in the last place for about one number in twelve, every number is the double nearest to its
/// text. `name` is the file to name in errors. Throws InputError with file and line. Thread safe.
boost::json::value parse_json(std::string_view text, std::string_view name);

/// Reads and parses a file; throws InputError when it cannot be read.
boost::json::value read_json_file(const std::string& path);

/// Shortest text that reads back as the same double; "0" for both zeros, "null" for what is not finite.
std::string number_text(double x);

/// Indented JSON text, keys in the order of the document, ended by a newline. What fits is kept on one line.
/// Numbers as by `number_text`, so that equal documents have equal bytes. Thread safe.
std::string write_json(const boost::json::value& document);

}  // namespace hauberk
