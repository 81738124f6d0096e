#pragma once
/// What a running task has beside its own: threads, the progress display, and the folder it saves into.

#include "limits/search_memory.hpp"
#include "run/progress.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace hauberk {

/// Lives as long as the run. The functions are called by one thread at a time and never throw.
struct RunContext {
  unsigned threads = 1;
  Progress& progress;
  std::filesystem::path folder;  ///< of the results
  bool resumed = false;          ///< the folder holds partial results of this very run
  /// What is computed and by which program, on one line: results of one identity are the same.
  std::function<std::string()> identity;
  /// Writes what there is if the last time was a few seconds ago; a kill loses at most this much.
  std::function<void()> save_sometimes;
  /// Writes what there is.
  std::function<void()> save;
  /// Notes the largest resident size so far, as it is to be forgotten.
  std::function<void()> note_peak_memory;
  /// Searches that are known by name, and that are to be remembered; null: none. Of a part never null.
  SearchMemory* memory = nullptr;
};

}  // namespace hauberk
