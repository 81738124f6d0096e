#pragma once
/// The output folder of a run: partial results while it lasts, final ones at its end.

#include "document/atomic_file.hpp"
#include "run/progress.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// A file in which a running task may keep what it needs to go on; it goes once results are complete.
inline constexpr const char* journal_file = ".hauberk-evaluations";

/// Digests of partial results as they were written, so that --resume knows that they are still the same: of
/// the last ones, and of those before, which a kill may have left. It goes once results are complete.
inline constexpr const char* digest_file = ".hauberk-digest";

/// Whether a folder's results.json is as the run left it; null: nothing tells.
std::optional<bool> is_as_written(const std::filesystem::path& directory);

/// Removes the journal of a folder, as its search is done or is to begin anew.
void drop_journal(const std::filesystem::path& directory);

/// Partial results that cannot be written are no reason to lose what is being computed: a warning says so,
/// and the next ones are tried. Results of a former run in the folder are kept beside until `done`. Not
/// thread safe.
class RunFolder {
 public:
  /// What is to be written, made when it is asked for.
  using Content = std::function<std::vector<NamedContent>()>;

  /// The folder must have been prepared. `names`: all that runs may leave in it, results.json first; they
  /// outlive this. `resuming`: it holds results of this very run.
  RunFolder(std::filesystem::path directory, std::span<const char* const> names, bool resuming,
            Progress& progress, Content content);

  /// Writes everything. Where the folder cannot be written, writes to a new folder for temporary files
  /// instead. Throws ComputationError naming the file that cannot be written, and the place or the way out.
  void write();
  /// Writes what there is. Never throws.
  void write_partial();
  /// Does so if the last time was a few seconds ago, or this is as old as a short run takes in all: that one
  /// writes once.
  void write_sometimes();

  /// Results are complete: those of former runs go.
  void done();

  const std::filesystem::path& directory() const { return directory_; }

 private:
  void replace(const std::vector<NamedContent>& files);

  std::filesystem::path directory_;
  std::span<const char* const> names_;
  /// Of these what runs have left, as far as results there say, and this run: nothing else is ever removed.
  std::vector<const char*> ours_;
  Progress& progress_;
  Content content_;
  std::string digest_;  ///< of the results.json that was written last
  bool own_;            ///< the folder's results are this run's
  std::string warned_;
  std::chrono::steady_clock::time_point next_;  ///< when partial results are due
};

}  // namespace hauberk
