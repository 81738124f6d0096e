#pragma once
#include <string>

namespace hauberk::test {

/// How often `what` stands in `text`, without overlaps.
inline int occurrences(const std::string& text, const std::string& what)
{
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

}  // namespace hauberk::test
