#pragma once
/// A report of many results: designs and limits in one text, one table and one page of plots.

#include "design/run_result.hpp"
#include "document/atomic_file.hpp"
#include "results/document.hpp"

#include <boost/json/value.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// Names of its files.
inline constexpr const char* report_text_file = "report.md";
inline constexpr const char* report_table_file = "report.csv";
inline constexpr const char* report_picture_file = "report.svg";
inline constexpr std::array report_names{report_text_file, report_table_file, report_picture_file, page_file};

/// One direction of a design; values in the unit of its quantity.
struct ReportTarget {
  double direction_deg = 0.0, target = 0.0;
  Aim aim = Aim::reach;
  std::optional<double> published;  ///< what a publication reached
  std::optional<double> initial, provisional, recomputed;
  std::optional<double>
      rechecked;  ///< by limits of the designed scene that were computed apart from the design
  bool better_state = false, met = false;
};

/// A range of values measured in one direction.
struct MeasuredRange {
  double direction_deg = 0.0, lowest = 0.0, highest = 0.0;
};

/// What a publication says of a design as a whole.
struct PublishedDesign {
  std::string source;
  std::optional<double> lowest, highest;  ///< range of the values reached
  std::optional<double> iterations, seconds_per_iteration;
  std::vector<std::pair<double, double>> profile;  ///< direction in degrees, value
  std::vector<MeasuredRange> measured;             ///< of printed samples
};

struct ReportDesign {
  std::string quantity, status;
  std::vector<ReportTarget> targets;
  std::optional<PublishedDesign> published;
  std::int64_t iterations = 0, evaluations = 0;
  std::optional<double> seconds;  ///< of all searches; null where times are not told
  /// Time of the search that gave the design, divided by its iterations; null where it made none, or
  /// times are not told.
  std::optional<double> seconds_per_iteration;
  bool rechecked = false;  ///< limits computed apart were entered
};

/// A result as a report shows it.
struct ReportEntry {
  std::string name;                   ///< the experiment's
  std::string file;                   ///< where it was read
  std::string length_unit;            ///< of the experiment
  std::string positive, negative;     ///< names of the senses
  std::string unit;                   ///< of limits: "strain", or "1/mm" for curvatures
  std::optional<double> peak_memory;  ///< bytes
  std::optional<double> threads;
  std::optional<ReportDesign> design;  ///< none: limits
  RunResult run;                       ///< what plots of profiles need of it: limits, profiles, design
  /// Parts of the document by which two results are of the same scene: parameters of the elements, load
  /// case, clearance.
  boost::json::value scene;
};

/// Reads a document of results of a design or of limits. `file` is its name in messages. Throws InputError
/// naming file, place and way out where it is none, has another task, or lacks something. Thread safe.
ReportEntry read_report_entry(const boost::json::value& document, const std::string& file);

/// Enters limits that were computed from the designed scene (designed.json) into the design of `entry`,
/// direction by direction. Throws InputError as above, and where they are of another scene. Thread safe.
void enter_recheck(ReportEntry& entry, const boost::json::value& document, const std::string& file);

/// The text, in Markdown: a table of deviations and one of costs with a row per design and sums, then a
/// table per result with a row per direction. Thread safe.
std::string report_text(std::span<const ReportEntry> entries);

/// The table: rows `design`, each followed by its rows `target`, rows `limits` with their rows `profile`, and
/// a row `total` for all designs; the first column says which. A header first; separator comma, decimal
/// point, empty where there is no value. Numbers read back exactly. Thread safe.
std::string report_csv(std::span<const ReportEntry> entries);

/// The page of plots: a polar panel per result, at most three in a row; of designs initial and optimised
/// values, targets, and published values. An SVG file that needs no others; the same entries give the same
/// bytes. Thread safe.
std::string report_svg(std::span<const ReportEntry> entries);

/// All three files.
std::vector<NamedContent> report_content(std::span<const ReportEntry> entries);

}  // namespace hauberk
