#pragma once
/// From a job to a folder of results: what `run` and `gather` do.

#include "experiment_options.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hauberk::command {

/// What a run goes on from where it is gathered from parts.
struct Gathering {
  SearchMemory* memory = nullptr;
  std::vector<std::filesystem::path> folders;  ///< of the parts
  std::vector<std::string> processors;         ///< on which they were computed, where there are several kinds
  /// Called before final results are written. Throws ComputationError where parts contradict each other or
  /// this run: then they are not.
  std::function<void()> check;
};

struct RunRequest {
  std::filesystem::path folder;
  unsigned threads = 1;
  bool force = false, resume = false, quiet = false;
  FurtherFiles further;  ///< left with final results
  std::string take_over;
  const Gathering* gathering = nullptr;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();  ///< of the program
};

/// Computes the job into the folder and returns the exit code. Throws as a command does.
int run_experiment(Job& job, const RunRequest& request);

/// The value of --threads, or all processors that the process may use.
unsigned threads_of(const Options& options);

/// The folder that -o names, or out/NAME-OF-THE-FILE.
std::filesystem::path output_folder(const Options& options);

}  // namespace hauberk::command
