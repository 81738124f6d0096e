#pragma once
/// Problems of one file, as a person reads them.

#include <hauberk/section.hpp>

#include <string>
#include <vector>

namespace hauberk {

/// Problems and where their values came from.
struct Diagnostics {
  std::string file;                     ///< as it is to be printed
  std::vector<std::string> overridden;  ///< pointers of what the command line set
  Problems problems;

  bool empty() const { return problems.empty(); }

  /// One line per problem, in the order of the file (those without a line last):
  ///   chain.json:12: /cell/place/0/element: ...
  ///   command line: /solver/preset: ...
  /// Of more than fifty the first fifty and how many there are. The pointer is left out when it is that of
  /// the whole file. Ends without a line break.
  std::string text() const;
};

}  // namespace hauberk
