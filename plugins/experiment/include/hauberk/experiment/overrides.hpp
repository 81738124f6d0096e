#pragma once
/// Values put at places of the file: by --set /solver/tolerance=1e-3, or by members of a stability
/// experiment.

#include <hauberk/section.hpp>

#include <string>

namespace hauberk {

struct Diagnostics;

/// Puts the value of `assignment` (POINTER=VALUE) into the tree, before it is checked. POINTER is an RFC 6901
/// pointer; objects on the way that do not exist are created, "-" appends to an array. VALUE is read as JSON
/// when it is JSON, else it is a string. What is set gets line 0 and is noted in `diagnostics.overridden`.
/// An assignment that cannot be applied is reported there.
void apply_override(Node& root, const std::string& assignment, Diagnostics& diagnostics);

/// Puts `value` at `pointer` by the same rules; it keeps its line. Returns what is wrong, empty when nothing
/// is.
std::string set_value(Node& root, const std::string& pointer, const Node& value);

}  // namespace hauberk
