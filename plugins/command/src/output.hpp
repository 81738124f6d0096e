#pragma once
/// The output folder of a run: partial results while it lasts, final ones at its end.

#include "loading.hpp"
#include "progress.hpp"

#include <hauberk/results/write_results.hpp>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::command {

/// Partial results that cannot be written are no reason to lose what is being computed: a warning says so,
/// and the next ones are tried. Results of a former run in the folder are kept beside until `done`. Not
/// thread safe.
class Output {
 public:
  /// The folder must have been prepared. `resuming`: it holds results of this very run.
  Output(std::filesystem::path directory, const Loaded& loaded, unsigned threads, bool resuming,
         Progress& progress);

  /// Entries of `limits` to be written exactly as they are in results read before (null: as computed).
  void keep(std::vector<boost::json::value> limits) { kept_ = std::move(limits); }

  /// The largest resident size of the runs that this one goes on from.
  void keep_peak_memory(std::int64_t bytes) { provenance_.peak_memory_bytes = bytes; }

  /// Notes the largest resident size so far, as it is to be forgotten.
  void note_peak_memory();

  /// The machine's load before the runs that this one goes on from: the largest one is kept.
  void keep_load_average(const std::optional<double>& load);

  /// Writes everything. Where the folder cannot be written, writes to a new folder for temporary files
  /// instead. Throws ComputationError naming the file that cannot be written, and the place or the way out.
  void write(const RunResult& run);
  /// The same for a stability experiment; `run` describes the base scene.
  void write(const RunResult& run, const StabilityMap& map);
  /// The same for a sweep.
  void write(const RunResult& run, const SweepTable& table);
  /// The same for a chart.
  void write(const RunResult& run, const PrecisionChart& chart);
  /// The same for a transition experiment.
  void write(const RunResult& run, const TransitionResult& transition);
  /// Writes what there is. Never throws.
  void write_partial(const RunResult& run);
  /// Does so if the last time was a few seconds ago.
  void write_sometimes(const RunResult& run);
  void write_sometimes(const RunResult& run, const StabilityMap& map);
  void write_sometimes(const RunResult& run, const SweepTable& table);
  void write_sometimes(const RunResult& run, const PrecisionChart& chart);

  /// Results are complete: those of former runs go.
  void done();

  /// The document that was written last.
  const boost::json::object& document() const { return document_; }
  const std::filesystem::path& directory() const { return directory_; }
  /// What is computed and by which program, on one line: results of one identity are the same. To be asked
  /// once something was written.
  std::string identity() const;

 private:
  using Files = std::vector<NamedContent>;

  bool is_time() const;
  boost::json::object document(const RunResult& run);
  Files content(const RunResult& run);
  Files content(const RunResult& run, const StabilityMap& map);
  Files content(const RunResult& run, const SweepTable& table);
  Files content(const RunResult& run, const PrecisionChart& chart);
  Files content(const RunResult& run, const TransitionResult& transition);
  void replace(const Files& files);
  void write_or_rescue(const Files& files);
  void try_writing(const Files& files);

  std::filesystem::path directory_;
  Progress& progress_;
  bool own_;  ///< the folder's results are this run's
  std::string warned_;
  std::string experiment_json_;
  std::string experiment_here_;  ///< with paths as they are from the folder of the results
  Provenance provenance_;
  ResultNames names_;
  PlotLabels labels_;
  std::vector<boost::json::value> kept_;
  boost::json::object document_;
  std::chrono::steady_clock::time_point last_{};
};

/// Removes the evaluations of a design from a folder, as its search is done or is to begin anew.
void drop_evaluations(const std::filesystem::path& directory);

/// What computes results in this build, for their provenance.
Provenance provenance(const Loaded& loaded, unsigned threads);

}  // namespace hauberk::command
