#pragma once
/// The parts of share/doc/command.md that are made from the descriptions of commands.

#include "commands.hpp"

#include <string>
#include <vector>

namespace hauberk::command {

/// Stands in the page between `<!-- begin: NAME -->` and `<!-- end -->`, which have lines of their own.
struct ReferenceBlock {
  std::string name;      ///< "options of run"
  std::string markdown;  ///< whole lines
};
std::vector<ReferenceBlock> reference_blocks();

/// The page with every block of `blocks` put in. Throws InputError for a block that the page has not exactly
/// once, and for one of the page that is not among them.
std::string with_blocks(const std::string& page, const std::vector<ReferenceBlock>& blocks);

}  // namespace hauberk::command
