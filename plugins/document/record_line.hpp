#pragma once
/// Records of a file as lines of text: one line per record, with every number in the shortest form that reads
/// back as the same double, and with a checksum. What a kill cut off and what was damaged is told from what
/// was written.

#include <charconv>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// The end of a whole line, before its line break.
inline constexpr std::string_view end_of_record = " .";

/// Writes one record. Not thread safe.
class RecordWriter {
 public:
  /// `mark`: what kind of record it is, its first character.
  explicit RecordWriter(char mark) : text_(1, mark) {}

  template <class Number>
  void number(Number x)
  {
    char buffer[32] = {};
    text_ += ' ';
    text_.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
  }
  /// Preceded by how many there are.
  void numbers(std::span<const double> x);
  /// Any characters; those that end a word are written as numbers.
  void words(std::string_view s);

  /// What was written so far, without a checksum.
  const std::string& text() const { return text_; }
  /// The line, without its line break.
  std::string line() &&;

 private:
  std::string text_;
};

/// Reads what a RecordWriter wrote, after the mark. `good` turns false where it did not; from there on
/// numbers are zero and texts empty. Not thread safe.
class RecordReader {
 public:
  explicit RecordReader(std::string_view text) : text_(text) {}

  template <class Number>
  Number number()
  {
    Number x{};
    const std::string_view word = next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    good = good && error == std::errc{} && end == word.data() + word.size();
    return good ? x : Number{};
  }
  /// A count of things that take at least two characters each: never more than the record can hold.
  std::size_t count();
  std::vector<double> numbers();
  std::string words();
  /// Whether nothing follows.
  bool ended() const { return text_.find_first_not_of(' ') == std::string_view::npos; }

  bool good = true;

 private:
  std::string_view next();

  std::string_view text_;
};

/// The line of a record whose text is `text`, without its line break.
std::string record_line(std::string text);

/// What a line (without its break) says, mark first, without its checksum and its end; null where it is not
/// what was written.
std::optional<std::string_view> undamaged_record(std::string_view line);

}  // namespace hauberk
