#pragma once
/// Writing Node trees as JSON.

#include <hauberk/section.hpp>

#include <boost/json/value.hpp>

#include <string>

namespace hauberk {

/// Shortest text that reads back as exactly `value`; integers below 1e15 have no exponent. `value` must be
/// finite.
std::string format_number(double value);

/// `text` as a JSON string, with quotes.
std::string quote_json(const std::string& text);

/// Indented JSON (two spaces); arrays and objects without containers in them stay on one line where they fit.
/// Ends without a line break. Thread safe.
std::string write_json(const Node& node);

/// The same tree as a Boost.JSON value. Integers up to 2^53 become int64.
boost::json::value to_boost_json(const Node& node);

}  // namespace hauberk
