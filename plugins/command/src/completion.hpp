#pragma once
/// Scripts that let a shell complete the words of a command line.

#include "description.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hauberk::command {

std::string bash_completion();
std::string zsh_completion();
std::string fish_completion();

/// Options of a command; --help comes last.
std::vector<Option> options_with_help(const Description& about);

/// As it is typed: --output, -o.
std::vector<std::string> spellings(const Option& option);

/// Words that may follow the name of a command: what its first argument may be, and the commands below it.
std::vector<std::string> first_words(const Description& about);

/// The ids in what `hauberk plugins list` prints, as a filter; plugins that cannot be used are left out.
std::string ids_filter();

/// `text` with the only place of `mark` replaced.
std::string with_part(std::string text, std::string_view mark, const std::string& part);

}  // namespace hauberk::command
