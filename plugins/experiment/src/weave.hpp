#pragma once
/// Weaves: elements and a cell that an experiment refers to by name. They are put into the tree before it is
/// checked, so that everything after knows elements and places only. share/doc/weaves.md describes the files.

#include <hauberk/experiment/experiment.hpp>

namespace hauberk {

/// cell.weave.
Field weave_field();

/// The table of fields of an experiment without weaves: what must be there after `expand_weave`.
Field expanded_fields(TaskFormats formats);

/// Replaces cell.weave by the elements, vectors and places that it stands for; a tree without it stays as it
/// is. Elements of the experiment stay beside those of the weave. False when it cannot be done, which is
/// reported.
bool expand_weave(Node& root, const WeaveLookup& weaves, Problems& problems);

/// Puts cell.weave of `written` in the place of what it stands for in `expanded`.
void keep_weave(Node& expanded, const Node& written);

}  // namespace hauberk
