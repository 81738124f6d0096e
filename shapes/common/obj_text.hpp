#pragma once
/// Wavefront OBJ files, line by line.

#include <hauberk/linalg.hpp>

#include <string>
#include <string_view>

namespace hauberk::detail {

/// Goes through the lines of a text, comments cut off, and those together that a backslash at their end
/// continues. What is wrong is an InputError that begins with `name` and the line.
class ObjText {
 public:
  /// Both outlive it.
  ObjText(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  /// Goes to the next line; false at the end.
  bool next();
  /// The first word of the line.
  std::string_view key() const { return key_; }
  /// Its number, from 1.
  int line() const { return first_; }
  /// Cuts the next word off it; empty at its end.
  std::string_view next_word();
  /// The three numbers after `v`.
  Vec3 point();
  /// The index from 0 of a point that a word such as 3, -1 or 3/1/2 names: what is before a slash, from 1, or
  /// from the last of `count` backwards. Points may follow the lines that name them, so it can be `count` or
  /// more.
  int index(std::string_view word, std::size_t count) const;

  [[noreturn]] void refuse(const std::string& what) const { refuse(what, first_); }
  [[noreturn]] void refuse(const std::string& what, int line) const;

 private:
  bool continued(std::string_view line) const;

  std::string_view text_;
  const std::string& name_;
  std::string_view key_, rest_;
  std::string joined_;
  int number_ = 0, first_ = 0;  ///< lines that were read, and where the present one began
};

}  // namespace hauberk::detail
