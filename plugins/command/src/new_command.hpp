#pragma once
/// `hauberk plugins new`.

#include <string>
#include <vector>

namespace hauberk::command {

/// Writes a project of a plugin from the installed template, all of its files or none. Throws InputError for
/// a name that is none, and where a file exists already.
int new_command(const std::vector<std::string>& words);

}  // namespace hauberk::command
