#include "document/json_cursor.hpp"

#include "document/utf8.hpp"

namespace hauberk {

JsonCursor::JsonCursor(std::string_view text) : text_(text)
{
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = line_start_ = 3;  // a byte order mark is no content
}

bool JsonCursor::is_word(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '+' || c == '-';
}

std::string_view JsonCursor::word() const
{
  std::size_t stop = at_;
  while (stop < text_.size() && stop - at_ < 40 && is_word(text_[stop])) ++stop;
  return text_.substr(at_, stop - at_);
}

void JsonCursor::stop_at(std::size_t at, const std::string& message, const std::string& pointer) const
{
  const std::size_t column = count_characters(text_.substr(line_start_, at - line_start_)) + 1;
  throw JsonSyntaxError{pointer, line_, "syntax error at column " + std::to_string(column) + ": " + message};
}

void JsonCursor::fail(const std::string& expected, const std::string& pointer) const
{
  stop("expected " + expected + ", found " + found(), pointer);
}

std::string JsonCursor::found() const
{
  if (end()) return "end of file";
  if (is_word(peek())) return "'" + std::string(word()) + "'";
  if (static_cast<unsigned char>(peek()) < 0x20) return "a control character";
  return "'" + std::string(first_character(rest())) + "'";
}

void JsonCursor::advance()
{
  if (text_[at_++] != '\n') return;
  ++line_;
  line_start_ = at_;
}

void JsonCursor::skip_space()
{
  while (!end()) {
    const char c = peek();
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
      advance();
    } else if (rest().starts_with("//")) {
      while (!end() && peek() != '\n') ++at_;
    } else if (rest().starts_with("/*")) {
      skip_block_comment();
    } else {
      return;
    }
  }
}

void JsonCursor::skip_block_comment()
{
  const int opened = line_;
  at_ += 2;
  while (!rest().starts_with("*/")) {
    if (end()) fail("'*/' for the comment opened on line " + std::to_string(opened), "");
    advance();
  }
  at_ += 2;
}

std::string JsonCursor::string(const std::string& pointer)
{
  std::string result;
  ++at_;
  for (;;) {
    if (end() || peek() == '\n') stop("expected '\"' at the end of the string", pointer);
    const char c = peek();
    if (c == '"') break;
    if (static_cast<unsigned char>(c) < 0x20) stop("control characters in strings must be escaped", pointer);
    if (c == '\\') {
      escape(result, pointer);
    } else {
      result += c;
      ++at_;
    }
  }
  ++at_;
  return result;
}

void JsonCursor::escape(std::string& out, const std::string& pointer)
{
  static constexpr std::string_view names = "\"\\/bfnrt";
  static constexpr std::string_view values = "\"\\/\b\f\n\r\t";
  const std::size_t start = at_++;
  const char c = peek();
  if (const auto k = names.find(c); !end() && k != std::string_view::npos) {
    out += values[k];
    ++at_;
    return;
  }
  if (c != 'u') stop_at(start, "expected one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u", pointer);
  ++at_;
  unsigned code = hex4(start, pointer);
  if (code >= 0xD800 && code < 0xDC00 && rest().starts_with("\\u")) {
    at_ += 2;
    const unsigned low = hex4(start, pointer);
    if (low < 0xDC00 || low > 0xDFFF) stop_at(start, "surrogate without its partner", pointer);
    code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
  } else if (code >= 0xD800 && code <= 0xDFFF) {
    stop_at(start, "surrogate without its partner", pointer);
  }
  append_utf8(out, code);
}

unsigned JsonCursor::hex4(std::size_t start, const std::string& pointer)
{
  unsigned code = 0;
  for (int k = 0; k < 4; ++k, ++at_) {
    const char c = peek();
    unsigned digit = 16;
    if (c >= '0' && c <= '9') digit = static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') digit = static_cast<unsigned>(c - 'a') + 10;
    if (c >= 'A' && c <= 'F') digit = static_cast<unsigned>(c - 'A') + 10;
    if (digit == 16) stop_at(start, "expected four hexadecimal digits after \\u", pointer);
    code = code * 16 + digit;
  }
  return code;
}

}  // namespace hauberk
