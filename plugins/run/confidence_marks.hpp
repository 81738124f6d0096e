#pragma once
/// How tables mark limits that are less certain than others.

#include <string>

namespace hauberk {

/// The mark of a word of confidence (share/doc/results.md): "!" contradicted, "?" single, "~" unsettled, else
/// none.
std::string confidence_mark(const std::string& word);

/// Lines that explain those of the marks "?" and "~" that are among `marks`, one after the other.
std::string explained_marks(const std::string& marks);

}  // namespace hauberk
