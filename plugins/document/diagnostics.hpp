#pragma once
/// Problems of one file, as a person reads them.

#include <hauberk/section.hpp>

#include <string>
#include <vector>

namespace hauberk {

/// The file of a line: lines of the k-th other file are numbered from (k + 1) times `lines_of_a_file` on, so
/// that whatever is made of a node, its problems know where it was written.
struct Place {
  static constexpr int lines_of_a_file = 1 << 28;  ///< more than the largest text has characters
  static constexpr int most_others = 6;

  int other = -1;  ///< index among the other files; -1: the file itself
  int line = 0;    ///< 1-based; 0: none
  static Place of(int line) { return {line / lines_of_a_file - 1, line % lines_of_a_file}; }
  int encoded() const { return (other + 1) * lines_of_a_file + line; }
};

/// Problems and where their values came from.
struct Diagnostics {
  std::string file;                     ///< as it is to be printed
  std::vector<std::string> overridden;  ///< pointers of what the command line set
  std::vector<std::string> others;      ///< files that values come from beside `file` (Place)
  Problems problems;

  bool empty() const { return problems.empty(); }
  /// The problems as they were found, those of other files without a line, and with file and line before
  /// their message.
  std::vector<Problem> of_file() const;

  /// One line per problem, in the order of the file, those of others and without a line last:
  ///   chain.json:12: /cell/place/0/element: ...
  ///   base.json:7: /solver/contact: ...
  ///   command line: /solver/preset: ...
  /// Of more than fifty the first fifty and how many there are. The pointer is left out when it is that of
  /// the whole file. Ends without a line break.
  std::string text() const;
};

}  // namespace hauberk
