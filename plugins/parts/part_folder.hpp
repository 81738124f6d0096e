#pragma once
/// The folder `parts` in a folder of results, into which the parts of a divided run write.
///
///   parts/parts.json              what is divided, and into how many parts
///   parts/2-of-8/searches-1.log   what the first run of part 2 found (search_log.hpp); what another one of
///   it
///                                 found is in searches-2.log
///   parts/gathered/searches-1.log what gathering itself had to find
///
/// No file is written by two runs, so that nothing has to be locked: a part may run twice at a time, on any
/// machines, and both do the same.

#include "limits/search_memory.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

inline constexpr const char* parts_folder = "parts";
inline constexpr const char* parts_file = "parts.json";
inline constexpr const char* parts_format = "hauberk-parts/1";
inline constexpr const char* searches_name = "searches";
inline constexpr const char* gathered_folder = "gathered";
/// Parts that a run can be divided into.
inline constexpr std::size_t most_parts = 10000;

/// How a run is divided.
struct Division {
  std::size_t count = 1;
  std::string identity;                ///< digest of what is computed and by which program
  std::string experiment;              ///< absolute path of its file
  std::vector<std::string> set;        ///< of --set
  std::vector<std::string> libraries;  ///< of --plugin-path, absolute
};

/// "2/8": the second of eight. Throws InputError for what is none.
Share share_named(const std::string& text);
/// "2-of-8".
std::string part_name(const Share& share);
std::filesystem::path part_path(const std::filesystem::path& folder, const Share& share);

/// What `folder` (of results) says of its division. Throws InputError where it says nothing, or what cannot
/// be read.
Division read_division(const std::filesystem::path& folder);

/// Says it there, if nothing does yet. Throws InputError where it is of another number of parts or identity.
void enter_division(const std::filesystem::path& folder, const Division& division);

/// Logs NAME-*.log in a folder, in the order of their numbers; none where there is no such folder.
std::vector<std::filesystem::path> logs_in(const std::filesystem::path& folder, const std::string& name);

/// Makes the first of NAME-1.log, NAME-2.log, ... in `folder` that does not exist, empty, for the caller
/// alone: two runs never get one. Throws ComputationError where none can be made.
std::filesystem::path claim_log(const std::filesystem::path& folder, const std::string& name);

/// Parts as Slurm lists them: "1-3,7".
std::string part_list(const std::vector<std::size_t>& numbers);

}  // namespace hauberk
