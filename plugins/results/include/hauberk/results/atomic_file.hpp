#pragma once
/// Files that are either wholly written or not touched.

#include <filesystem>
#include <string_view>

namespace hauberk {

/// Replaces `path` by `content`: written to a temporary file in the same folder, flushed to the disk,
/// renamed. Throws ComputationError naming the file and the cause (disk full, read-only); a former file then
/// stays as it was and the temporary file is removed. Thread safe for different paths.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Makes sure that results can be written to `directory` before anything is computed: creates it when
/// missing, refuses one that holds results unless `force`, and tries a file. Throws InputError naming the
/// folder.
void prepare_output_directory(const std::filesystem::path& directory, bool force);

}  // namespace hauberk
