#include "dispatch.hpp"
#include "man_page.hpp"
#include "options.hpp"

#include <fmt/format.h>

namespace hauberk::command {

Description man_description()
{
  return {.name = "man",
          .line = "the manual page, as roff: hauberk man | man -l -",
          .synopsis = "man",
          .summary = "Prints the manual page hauberk(1). It is installed with the program: man hauberk."};
}

int man_command(const std::vector<std::string>& words)
{
  Options options(man_description());
  options.parse(words);
  fmt::print("{}", man_page());
  return exit_done;
}

}  // namespace hauberk::command
