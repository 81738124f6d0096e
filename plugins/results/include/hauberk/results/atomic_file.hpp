#pragma once
/// Files that are either wholly written or not touched.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// Replaces `path` by `content`: written to a temporary file in the same folder, flushed to the disk,
/// renamed. Throws ComputationError naming the file and the cause (disk full, read-only); a former file then
/// stays as it was and the temporary file is removed. Thread safe for different paths.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// A file of a folder, and what is to be in it.
struct NamedContent {
  std::string name, content;
};

/// What becomes of results that a folder holds when others are written.
enum class FormerResults {
  replaced,
  kept  ///< in the folder `previous` below it, until `drop_previous`; what that holds already is older and
        ///< stays
};

/// Replaces several files of `directory` together: all are written and flushed under temporary names before
/// the first is renamed, in the order given. A full disk leaves everything as it was, so that no mixture of
/// old and new remains; of results of other names only what is kept. Throws as `write_file_atomically`.
void write_files_atomically(const std::filesystem::path& directory, const std::vector<NamedContent>& files,
                            FormerResults former = FormerResults::replaced);

/// Makes sure that results can be written to `directory` before anything is computed: creates it when
/// missing, refuses one that holds results unless `force`, and tries a file. Removes temporary files that a
/// killed process left there. Throws InputError naming the folder; a folder that was made is then removed.
void prepare_output_directory(const std::filesystem::path& directory, bool force);

/// Removes former results that were kept: to be called once a run is done. Files that cannot be removed stay.
void drop_previous(const std::filesystem::path& directory);

}  // namespace hauberk
