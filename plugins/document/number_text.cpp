#include "document/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace hauberk {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// True when |token|, a non-zero number, is at least 1: decimal place of its first non-zero digit plus
/// exponent.
bool is_large(std::string_view token)
{
  const std::size_t e = token.find_first_of("eE");
  const std::string_view mantissa = token.substr(0, e);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  const std::int64_t place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  std::int64_t exponent = 0;
  if (e != std::string_view::npos) {
    bool negative = false;
    for (const char c : token.substr(e + 1)) {
      if (c == '-') negative = true;
      // Clamped: any exponent this large decides alone.
      if (is_digit(c)) exponent = std::min<std::int64_t>(exponent * 10 + (c - '0'), 1'000'000'000'000);
    }
    if (negative) exponent = -exponent;
  }
  return place + exponent > 0;
}

}  // namespace

std::size_t json_number_size(std::string_view text)
{
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t start = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at - start;
  };
  const auto next_is = [&](std::string_view any) {
    return at < text.size() && any.find(text[at]) != std::string_view::npos;
  };

  if (next_is("-")) ++at;
  const bool leading_zero = next_is("0");
  const std::size_t whole = digits();
  if (whole == 0 || (leading_zero && whole > 1)) return 0;
  if (next_is(".")) {
    ++at;
    if (digits() == 0) return 0;
  }
  if (next_is("eE")) {
    ++at;
    if (next_is("+-")) ++at;
    if (digits() == 0) return 0;
  }
  return at;
}

double parse_json_number(std::string_view token)
{
  double value = 0.0;
  const auto result = std::from_chars(token.data(), token.data() + token.size(), value);
  if (result.ec == std::errc::result_out_of_range) {
    // Overflow and underflow are reported alike.
    const double sign = token.starts_with('-') ? -1.0 : 1.0;
    return is_large(token) ? sign * std::numeric_limits<double>::infinity() : sign * 0.0;
  }
  return value;
}

bool is_not_finite_word(std::string_view word)
{
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

}  // namespace hauberk
