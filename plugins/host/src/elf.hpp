#pragma once
/// What can be said about a library from its file, without running any of its code.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hauberk {

struct ElfSummary {
  bool elf = false;                   ///< has the header of a shared ELF library or program
  bool this_machine = false;          ///< same class, byte order and processor as this program
  bool damaged = false;               ///< the file ends before what its header announces
  bool tables = false;                ///< the lists below could be read
  std::vector<std::string> needed;    ///< names of libraries it needs
  std::vector<std::string> exported;  ///< names of dynamic symbols it defines
  std::size_t constructors = 0;       ///< functions that run when it is loaded; the compiler's own is one
};

/// Reads `file`. Never throws for what the file contains.
ElfSummary read_elf(const std::filesystem::path& file);

}  // namespace hauberk
