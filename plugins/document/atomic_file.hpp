#pragma once
/// Files that are either wholly written or not touched.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// A file of a folder, and what is to be in it.
struct NamedContent {
  std::string name, content;
};

/// What becomes of results that a folder holds when others are written.
enum class FormerResults {
  replaced,
  kept  ///< in the folder `.hauberk-previous` below it, until `drop_previous`; what that holds already is
        ///< older and stays
};

/// Replaces files of `directory` together, and removes those of `names` that are not among them: all are
/// written and flushed under temporary names before the first is renamed, in the order given. Of former
/// results that are kept the first of `names` is kept last, so that all are where it is. Throws
/// ComputationError naming the file and the cause (disk full, read-only); if that is before the first rename,
/// as a full disk is, everything is as it was. A kill between the renames leaves new files beside former
/// ones, each whole. Thread safe for different folders.
void write_files_atomically(const std::filesystem::path& directory, const std::vector<NamedContent>& files,
                            std::span<const char* const> names,
                            FormerResults former = FormerResults::replaced);

/// Writes a file of its own, whole or not at all; what else its folder holds stays. Throws InputError where
/// there is a file of that name already, which is left as it is, ComputationError as above. Thread safe for
/// different files.
void write_new_file_atomically(const std::filesystem::path& file, const std::string& content);

/// Throws the InputError of `write_new_file_atomically` where the file exists: before anything is computed.
void refuse_existing_file(const std::filesystem::path& file,
                          const char* way_out = "give another name with -o, or remove it");

/// Removes temporary files for `names` that a killed process left. What cannot be removed stays.
void remove_abandoned(const std::filesystem::path& directory, std::span<const char* const> names);

/// Makes sure that files can be written to `directory` before anything is computed: creates it when
/// missing, refuses one that holds any of `names` unless `force`, and tries a file. Removes what is
/// abandoned. Throws InputError naming the folder; a folder that was made is then removed.
void prepare_output_directory(const std::filesystem::path& directory, bool force,
                              std::span<const char* const> names);

/// Removes former results that were kept: to be called once a run is done. Files that cannot be removed stay,
/// and so does what a link of the folder's name leads to.
void drop_previous(const std::filesystem::path& directory, std::span<const char* const> names);

}  // namespace hauberk
