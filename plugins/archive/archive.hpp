#pragma once
/// Zip archives, which 3MF files are. libzip and what it links are loaded where an archive is written or
/// read.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hauberk::archives {

/// Whether the program was built with libzip. Without it the functions below throw ComputationError.
bool available();

/// Names and contents as an archive in memory, equal bytes of equal contents. Throws ComputationError.
std::string pack(const std::vector<std::pair<std::string, std::string>>& files);

enum class Unpacked {
  done,
  no_archive,  ///< `text` says why
  no_such_file,
  too_large,
  not_readable,  ///< `text` says why
  damaged
};
struct Content {
  Unpacked result = Unpacked::done;
  std::string text;
};

/// The content of `file`, unless it is longer than `most` bytes. Throws ComputationError.
Content unpack(std::string_view bytes, const std::string& file, std::size_t most);

}  // namespace hauberk::archives
