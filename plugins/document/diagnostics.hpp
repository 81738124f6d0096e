#pragma once
/// Problems of one file, as a person reads them.

#include <hauberk/section.hpp>

#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// Problems and where their values came from.
struct Diagnostics {
  std::string file;                     ///< as it is to be printed
  std::vector<std::string> overridden;  ///< pointers of what the command line set
  /// Pointers of what comes from other files, and which; of two that hold a place the longer one counts.
  std::vector<std::pair<std::string, std::string>> inherited;
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
