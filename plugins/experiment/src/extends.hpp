#pragma once
/// Experiments that begin from another file.

#include <hauberk/section.hpp>

#include <string>

namespace hauberk {

struct Diagnostics;

/// Puts the file that `root` extends, if it does, below it, with what that one extends: objects are joined,
/// null takes a key away, anything else replaces what was there (RFC 7396). Name, description and what the
/// file expects are its own and are not taken over. `file` is where `root` comes from: paths are relative to
/// it. Lines of what comes from other files say so (Place). False: something is wrong, and is reported.
bool extend(Node& root, const std::string& file, Diagnostics& diagnostics);

}  // namespace hauberk
