#include "run/confidence_marks.hpp"

namespace hauberk {

std::string confidence_mark(const std::string& word)
{
  if (word == "contradicted") return "!";
  if (word == "single") return "?";
  return word == "unsettled" ? "~" : "";
}

std::string explained_marks(const std::string& marks)
{
  std::string out;
  if (marks.find('?') != std::string::npos)
    out += "? one search alone ended there; more starts (solver.starts) tell more\n";
  if (marks.find('~') != std::string::npos)
    out += "~ many searches ended where no other did; more starts may find a state that is further\n";
  return out;
}

}  // namespace hauberk
