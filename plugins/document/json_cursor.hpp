#pragma once
/// Where a reader of JSON is in its text, and what it takes next.

#include <string>
#include <string_view>

namespace hauberk {

/// Thrown to leave the reading of JSON at the first syntax error.
struct JsonSyntaxError {
  std::string pointer;
  int line;
  std::string message;
};

/// A place in JSON text that knows its line and column. The text must be valid UTF-8.
class JsonCursor {
 public:
  explicit JsonCursor(std::string_view text);

  bool end() const { return at_ >= text_.size(); }
  int line() const { return line_; }
  /// The next byte, 0 at the end.
  char peek() const { return end() ? '\0' : text_[at_]; }
  /// What is not read yet.
  std::string_view rest() const { return text_.substr(at_); }
  /// The longest run of letters, digits, '_', '.', '+' and '-' (at most 40), which may be empty.
  std::string_view word() const;
  static bool is_word(char c);

  /// Passes over `bytes`, which hold no line break.
  void skip(std::size_t bytes) { at_ += bytes; }
  /// Passes over white space and comments.
  void skip_space();
  /// Reads a string, the opening quote being next.
  std::string string(const std::string& pointer);

  /// "expected <expected>, found <what is next>".
  [[noreturn]] void fail(const std::string& expected, const std::string& pointer) const;
  /// A message of one's own about the current place.
  [[noreturn]] void stop(const std::string& message, const std::string& pointer) const
  {
    stop_at(at_, message, pointer);
  }

 private:
  [[noreturn]] void stop_at(std::size_t at, const std::string& message, const std::string& pointer) const;
  std::string found() const;
  void advance();
  void skip_block_comment();
  void escape(std::string& out, const std::string& pointer);
  unsigned hex4(std::size_t start, const std::string& pointer);

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_start_ = 0;
  int line_ = 1;
};

}  // namespace hauberk
