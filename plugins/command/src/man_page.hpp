#pragma once
/// The manual page, made of the descriptions of all commands.

#include <string>

namespace hauberk::command {

/// The manual page hauberk(1) with all commands, in the macros of man.
std::string man_page();

/// Text as roff shows it letter by letter, also at the beginning of a line.
std::string roff(const std::string& text);

}  // namespace hauberk::command
