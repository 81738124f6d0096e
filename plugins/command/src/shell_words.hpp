#pragma once
/// Words as a shell reads them.

#include <string>
#include <string_view>

namespace hauberk::command {

/// In single quotes, as all three shells read it.
std::string shell_quoted(std::string_view text);
/// A word as a shell reads it, in quotes only where it needs them.
std::string shell_word(std::string_view text);

}  // namespace hauberk::command
