#pragma once
/// Searches in files: what a part of a divided run leaves, and what gathering it recalls.

#include "limits/search_memory.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace hauberk {

inline constexpr const char* search_log_format = "hauberk-searches/1";

/// Who wrote a log, its first record.
struct LogOrigin {
  std::string identity;   ///< digest of what is computed and by which program
  std::string part;       ///< "2-of-8"
  std::string processor;  ///< model name; empty where the system does not tell
  std::string run;        ///< HOST:PID
};

/// The memory of a run whose searches are kept in files: one that it writes, and any number that others
/// wrote, which may still be writing. Lines are written whole; in a file of others one that is damaged ends
/// what is believed of it. Thread safe, but for `read` and `write_to`, which come first.
class SearchLogs final : public SearchMemory {
 public:
  using Warn = std::function<void(const std::string&)>;

  SearchLogs(std::string identity, Warn warn);

  /// What a log holds beside its searches.
  struct Contents {
    LogOrigin origin;
    std::size_t searches = 0;
    bool complete = false;  ///< its part has nothing left to do
  };
  /// Takes over a log. Null, with a warning, where it is no log or damaged from its first line on. Throws
  /// InputError where it was written for another experiment or by another build: naming it.
  std::optional<Contents> read(const std::filesystem::path& file);

  /// What is recorded goes to a log of its own (claim_log), which is made for its first record.
  void write_to(std::filesystem::path folder, std::string name, LogOrigin origin);
  /// Its part has nothing left to do. False: that could not be written.
  bool complete();

  /// Does one search of every log that was read once more, the first that is asked for, and compares.
  void check_one_of_each() { checking_ = true; }

  std::optional<KnownSearch> recall(const std::string& name) override;
  void record(const std::string& name, const Locked& locked, double seconds) override;

  /// Two outcomes of one search: differ, which must not be.
  struct Conflict {
    std::string search;
    std::string file, other;     ///< `other` empty: what this run found
    bool one_processor = false;  ///< both of one kind: no difference is to be expected
  };
  std::vector<Conflict> conflicts() const;
  /// Logs of which a search was done once more, and how many were read.
  std::pair<std::size_t, std::size_t> checked() const;
  std::size_t known() const { return entries_.size(); }
  /// How many searches were done though logs have them: of damage that a log's own checks do not see.
  std::size_t done_again() const;

 private:
  struct File {
    std::filesystem::path path;
    LogOrigin origin;
    bool withheld = false;  ///< one of its searches is being done once more
    bool checked = false;   ///< and was compared
    bool useless = false;   ///< one of its searches was done again, which was told
  };
  struct Entry {
    std::size_t file = 0;
    std::streamoff begin = 0;
    std::size_t length = 0;
    std::uint64_t outcome = 0;  ///< hash of all but the time
  };

  void enter(const std::string& name, const Entry& entry);
  bool write(const std::string& line);
  void note_useless(const Entry& entry, const std::string& name);
  std::string where(std::size_t file) const;
  std::optional<KnownSearch> read_entry(const Entry& entry) const;

  std::string identity_;
  Warn warn_;
  std::vector<File> files_;
  std::unordered_map<std::string, std::vector<Entry>> entries_;  ///< outcomes that differ, the first is used
  mutable std::mutex mutex_;  ///< guards all below, and `files_` once searches are asked for
  std::map<std::string, Entry> withheld_;
  std::vector<Conflict> conflicts_;
  std::size_t done_again_ = 0;
  bool checking_ = false;
  LogOrigin own_;
  std::filesystem::path own_folder_, own_file_;
  std::string own_name_;
  std::ofstream out_;
};

}  // namespace hauberk
