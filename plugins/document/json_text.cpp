#include "document/json_text.hpp"

#include "document/read_file.hpp"

#include <hauberk/error.hpp>

#include <boost/json/basic_parser_impl.hpp>
#include <boost/json/serialize.hpp>
#include <boost/json/value_stack.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

namespace json = boost::json;

/// Builds a value like Boost's own parser, but converts numbers with std::from_chars, which rounds correctly.
struct ExactHandler {
  static constexpr std::size_t max_object_size = json::object::max_size();
  static constexpr std::size_t max_array_size = json::array::max_size();
  static constexpr std::size_t max_key_size = json::string::max_size();
  static constexpr std::size_t max_string_size = json::string::max_size();
  using code = boost::json::error_code;

  json::value_stack stack;
  std::string number;

  bool on_document_begin(code&) { return true; }
  bool on_document_end(code&) { return true; }
  bool on_object_begin(code&) { return true; }
  bool on_object_end(std::size_t n, code&) { return stack.push_object(n), true; }
  bool on_array_begin(code&) { return true; }
  bool on_array_end(std::size_t n, code&) { return stack.push_array(n), true; }
  bool on_key_part(json::string_view s, std::size_t, code&) { return stack.push_chars(s), true; }
  bool on_key(json::string_view s, std::size_t, code&) { return stack.push_key(s), true; }
  bool on_string_part(json::string_view s, std::size_t, code&) { return stack.push_chars(s), true; }
  bool on_string(json::string_view s, std::size_t, code&) { return stack.push_string(s), true; }
  bool on_number_part(json::string_view s, code&) { return number.append(s.data(), s.size()), true; }
  bool on_int64(std::int64_t i, json::string_view, code&)
  {
    number.clear();
    return stack.push_int64(i), true;
  }
  bool on_uint64(std::uint64_t u, json::string_view, code&)
  {
    number.clear();
    return stack.push_uint64(u), true;
  }
  bool on_double(double approximate, json::string_view s, code&)
  {
    number.append(s.data(), s.size());
    double exact = approximate;  // kept for what overflows or vanishes
    std::from_chars(number.data(), number.data() + number.size(), exact);
    number.clear();
    return stack.push_double(exact), true;
  }
  bool on_bool(bool b, code&) { return stack.push_bool(b), true; }
  bool on_null(code&) { return stack.push_null(), true; }
  bool on_comment_part(json::string_view, code&) { return true; }
  bool on_comment(json::string_view, code&) { return true; }
};

/// Longest line, in characters, onto which an array or object is folded.
constexpr std::size_t line_width = 110;

void write_scalar(std::string& out, const json::value& v)
{
  if (v.is_double())
    out += number_text(v.get_double());
  else if (v.is_string())
    out += json::serialize(v.get_string());
  else
    out += json::serialize(v);
}

/// Appends `v` on one line; gives up (returns false) as soon as `out` is longer than `limit`.
bool write_flat(std::string& out, const json::value& v, std::size_t limit)
{
  const char* separator = "";
  if (v.is_array()) {
    out += '[';
    for (const json::value& item : v.get_array()) {
      out += std::exchange(separator, ", ");
      if (!write_flat(out, item, limit)) return false;
    }
    out += ']';
  } else if (v.is_object()) {
    out += "{";
    for (const auto& [key, item] : v.get_object()) {
      out += std::exchange(separator, ", ");
      out += json::serialize(key) + ": ";
      if (!write_flat(out, item, limit)) return false;
    }
    out += "}";
  } else {
    write_scalar(out, v);
  }
  return out.size() <= limit;
}

void write_indented(std::string& out, const json::value& v, std::size_t indent, std::size_t column)
{
  std::string flat;
  if (!v.is_structured() || write_flat(flat, v, line_width > column ? line_width - column : 0)) {
    if (!v.is_structured()) write_scalar(flat, v);
    out += flat;
    return;
  }
  const std::string margin(indent + 2, ' ');
  const char* separator = "\n";
  if (v.is_array()) {
    out += '[';
    for (const json::value& item : v.get_array()) {
      out += std::exchange(separator, ",\n") + margin;
      write_indented(out, item, indent + 2, indent + 2);
    }
    out += '\n' + std::string(indent, ' ') + ']';
  } else {
    out += '{';
    for (const auto& [key, item] : v.get_object()) {
      const std::string label = json::serialize(key) + ": ";
      out += std::exchange(separator, ",\n");
      out += margin;
      out += label;
      write_indented(out, item, indent + 2, indent + 2 + label.size());
    }
    out += '\n' + std::string(indent, ' ') + '}';
  }
}

}  // namespace

json::value parse_json(std::string_view text, std::string_view name)
{
  json::basic_parser<ExactHandler> parser{json::parse_options{}};
  parser.handler().stack.reset();
  json::error_code error;
  const std::size_t used = parser.write_some(false, text.data(), text.size(), error);
  if (!error && used < text.size()) error = json::error::extra_data;
  if (!error && !parser.done()) error = json::error::incomplete;
  if (error) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(used), '\n');
    throw InputError(std::string(name) + ":" + std::to_string(line) + ": not valid JSON: " + error.message());
  }
  return parser.handler().stack.release();
}

json::value read_json_file(const std::string& path)
{
  const std::string text = read_whole_file(path, largest_results);
  try {
    return parse_json(text, path);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; expected a file as `hauberk run` writes it");
  }
}

std::string number_text(double x)
{
  if (!std::isfinite(x)) return "null";
  if (x == 0.0) return "0";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x);
  return {buffer, end.ptr};
}

std::string write_json(const json::value& document)
{
  std::string out;
  write_indented(out, document, 0, 0);
  out += '\n';
  return out;
}

}  // namespace hauberk
