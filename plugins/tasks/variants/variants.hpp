#pragma once
/// What the sections that make variants of a file have in common: values put at places, lists that vary,
/// names.

#include <hauberk/experiment/experiment.hpp>

#include <string>
#include <vector>

namespace hauberk {

/// What each of several variants puts where, and what it is called.
struct Variants {
  std::vector<std::string> labels;
  std::vector<std::vector<Assignment>> values;
};

/// The member `set` of a section, if it has one.
std::vector<Assignment> read_set(const Node& section);

/// The variants of the member `vary` of a section, none where it is absent: each puts what `set` says, then
/// its value of every entry. Called as `labels` says, else by the values of the first entry. `each` is what
/// messages call a variant.
Variants read_variants(const Node& section, const std::string& each, Problems& problems);

/// Reports a list that says something about every variant and has not as many items as there are of them.
void check_length(const Node* list, std::size_t count, const std::string& what, const std::string& each,
                  Problems& problems);

/// Why it makes no sense to put a value at a place of a variant, which lacks sections that the file has or
/// has them of its own; else empty. `variants` is what they are called, `verb` what is done to their places.
std::string place_without_effect(TaskFormats formats, const std::string& pointer, const std::string& variants,
                                 const std::string& verb);

/// Reports entries without a name, and names that are given twice; `what` precedes the name in messages.
template <class Named>
void check_names(const Node& list, const std::vector<Named>& entries, const std::string& what,
                 Problems& problems)
{
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (entries[k].name.empty()) problems.add(list.items[k], "expected a name, found \"\"");
    for (std::size_t j = 0; j < k; ++j) {
      if (entries[j].name == entries[k].name)
        problems.add(list.items[k], what + " '" + entries[k].name + "' is given twice");
    }
  }
}

}  // namespace hauberk
