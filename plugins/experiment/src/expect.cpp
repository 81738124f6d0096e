#include "document/json_writer.hpp"

#include <hauberk/experiment/expect.hpp>

#include <boost/json/serialize.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {

namespace {

std::string show(const boost::json::value& value)
{
  if (value.is_number()) return format_number(value.to_number<double>());
  if (value.is_string()) return quote_json(std::string(value.get_string()));
  std::string text = boost::json::serialize(value);
  constexpr std::size_t longest = 80;
  if (text.size() > longest) return value.is_array() ? "an array" : "an object";
  return text;
}

bool meets(const Expectation& expected, const boost::json::value& found)
{
  const bool numeric = expected.rel || expected.abs || expected.min || expected.max ||
                       (expected.value && expected.value->is_number());
  if (!numeric) return !expected.value || *expected.value == found;
  if (!found.is_number()) return false;
  const double number = found.to_number<double>();
  if (expected.min && !(number >= *expected.min)) return false;
  if (expected.max && !(number <= *expected.max)) return false;
  if (!expected.value) return true;
  const double value = expected.value->to_number<double>();
  const double margin = std::max(expected.rel.value_or(0.0) * std::abs(value), expected.abs.value_or(0.0));
  return std::abs(number - value) <= margin;
}

}  // namespace

std::string Expectation::describe() const
{
  std::string out;
  const auto add = [&](const std::string& part, const char* between) {
    out += (out.empty() ? "" : between) + part;
  };
  if (value) {
    out = show(*value);
    if (rel) out += " within " + format_number(*rel) + " relative";
    if (abs) out += (rel ? " or " : " within ") + format_number(*abs) + (rel ? " absolute" : "");
  }
  if (min) add(">= " + format_number(*min), " and ");
  if (max) add("<= " + format_number(*max), " and ");
  return out;
}

std::string ExpectationFailure::text() const
{
  return pointer + ": expected " + expected + ", found " + found;
}

std::vector<ExpectationFailure> evaluate_expectations(const std::vector<Expectation>& expectations,
                                                      const boost::json::value& results)
{
  std::vector<ExpectationFailure> failures;
  for (const Expectation& expected : expectations) {
    boost::json::error_code error;
    const boost::json::value* found = results.find_pointer(expected.pointer, error);
    if (found != nullptr && meets(expected, *found)) continue;
    failures.push_back(
        {expected.pointer, expected.describe(), found == nullptr ? "nothing there" : show(*found)});
  }
  return failures;
}

}  // namespace hauberk
