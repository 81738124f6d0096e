#pragma once
/// The output folder of a run: partial results while it lasts, final ones at its end.

#include "loading.hpp"

#include <hauberk/results/write_results.hpp>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace hauberk::command {

/// Not thread safe.
class Output {
 public:
  /// The folder must have been prepared.
  Output(std::filesystem::path directory, const Loaded& loaded, unsigned threads);

  /// Entries of `limits` to be written exactly as they are in results read before (null: as computed).
  void keep(std::vector<boost::json::value> limits) { kept_ = std::move(limits); }

  /// Writes everything. Throws ComputationError naming the file that cannot be written.
  void write(const RunResult& run);
  /// The same for a stability experiment; `run` describes the base scene.
  void write(const RunResult& run, const StabilityMap& map);
  /// The same for a transition experiment.
  void write(const RunResult& run, const TransitionResult& transition);
  /// Writes if the last time was a few seconds ago.
  void write_sometimes(const RunResult& run);
  void write_sometimes(const RunResult& run, const StabilityMap& map);

  /// The document that was written last.
  const boost::json::object& document() const { return document_; }
  const std::filesystem::path& directory() const { return directory_; }

 private:
  bool is_time() const;

  std::filesystem::path directory_;
  std::string experiment_json_;
  Provenance provenance_;
  ResultNames names_;
  PlotLabels labels_;
  std::vector<boost::json::value> kept_;
  boost::json::object document_;
  std::chrono::steady_clock::time_point last_{};
};

/// What computes results in this build, for their provenance.
Provenance provenance(const Loaded& loaded, unsigned threads);

}  // namespace hauberk::command
