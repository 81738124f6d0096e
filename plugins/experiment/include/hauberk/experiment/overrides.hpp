#pragma once
/// Values given on the command line: --set /solver/preset=fast.

#include <hauberk/settings.hpp>

#include <string>

namespace hauberk {

struct Diagnostics;

/// Puts the value of `assignment` (POINTER=VALUE) into the tree, before it is checked. POINTER is an RFC 6901
/// pointer; objects on the way that do not exist are created, "-" appends to an array. VALUE is read as JSON
/// when it is JSON, else it is a string. What is set gets line 0 and is noted in `diagnostics.overridden`.
/// An assignment that cannot be applied is reported there.
void apply_override(Node& root, const std::string& assignment, Diagnostics& diagnostics);

}  // namespace hauberk
