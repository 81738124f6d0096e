#pragma once
/// Where a number of a JSON text ends.

#include <cstddef>
#include <string_view>

namespace hauberk {

/// Length of the JSON number (RFC 8259, section 6) at the start of `text`, 0 when there is none.
std::size_t json_number_size(std::string_view text);

/// Value of a JSON number, correctly rounded; infinite when beyond the largest double, 0 below the smallest.
double parse_json_number(std::string_view token);

/// True for NaN and Infinity in the spellings people and programs use.
bool is_not_finite_word(std::string_view word);

}  // namespace hauberk
