#pragma once
/// Everything a run leaves on the disk.

#include <hauberk/results/atomic_file.hpp>
#include <hauberk/results/chart.hpp>
#include <hauberk/results/document.hpp>
#include <hauberk/results/polar_svg.hpp>
#include <hauberk/results/stability.hpp>
#include <hauberk/results/sweep.hpp>
#include <hauberk/results/transition.hpp>

#include <boost/json/object.hpp>

#include <array>
#include <filesystem>
#include <string>

namespace hauberk {

/// Names of the files in the output folder.
inline constexpr const char* results_file = "results.json";
inline constexpr const char* limits_file = "limits.csv";
inline constexpr const char* profile_file = "profile.svg";
inline constexpr const char* designed_file = "designed.json";
inline constexpr const char* boundary_file = "boundary.ply";
inline constexpr const char* boundary_picture_file = "boundary.svg";

inline constexpr const char* stability_file = "stability.csv";
inline constexpr const char* stability_picture_file = "stability.svg";

inline constexpr const char* transition_file = "transition.csv";
inline constexpr const char* transition_minima_file = "minima.csv";
inline constexpr const char* transition_picture_file = "transition.svg";

inline constexpr const char* sweep_file = "sweep.csv";
inline constexpr const char* sweep_picture_file = "sweep.svg";

inline constexpr const char* chart_file = "chart.csv";
inline constexpr const char* chart_picture_file = "chart.svg";
inline constexpr const char* chart_work_picture_file = "chart_work.svg";
/// All of them: what a run may leave.
inline constexpr std::array result_names{results_file,
                                         limits_file,
                                         profile_file,
                                         designed_file,
                                         stability_file,
                                         stability_picture_file,
                                         transition_file,
                                         transition_minima_file,
                                         transition_picture_file,
                                         sweep_file,
                                         sweep_picture_file,
                                         boundary_file,
                                         boundary_picture_file,
                                         chart_file,
                                         chart_picture_file,
                                         chart_work_picture_file};

/// The files of `results_content` for `run`, for ResultNames::files: limits, profile and, for a design
/// of a periodic cell, designed; for limits along components limits, boundary and picture.
std::vector<std::pair<std::string, std::string>> result_files(const RunResult& run);

/// limits.csv, profile.svg (or boundary.ply and boundary.svg), designed.json (for a design) and, last,
/// results.json, so that a results.json on the disk means that the files it names are complete. `document` is
/// that of `results_document`.
std::vector<NamedContent> results_content(const boost::json::object& document, const RunResult& run,
                                          const std::string& experiment_json, const ResultNames& names,
                                          const PlotLabels& labels);

/// Those of a stability experiment: stability and picture.
std::vector<std::pair<std::string, std::string>> stability_files();

/// stability.csv, stability.svg and, last, results.json.
std::vector<NamedContent> stability_content(const boost::json::object& document, const StabilityMap& map,
                                            const std::string& title);

/// Those of a transition experiment: transition, minima and picture.
std::vector<std::pair<std::string, std::string>> transition_files();

/// transition.csv, minima.csv, transition.svg and, last, results.json.
std::vector<NamedContent> transition_content(const boost::json::object& document,
                                             const TransitionResult& result, const std::string& title);

/// Those of a sweep: sweep and picture.
std::vector<std::pair<std::string, std::string>> sweep_files();

/// sweep.csv, sweep.svg and, last, results.json.
std::vector<NamedContent> sweep_content(const boost::json::object& document, const SweepTable& table,
                                        const PlotLabels& labels);

/// Those of a chart: chart, picture and work_picture.
std::vector<std::pair<std::string, std::string>> chart_files();

/// chart.csv, chart.svg, chart_work.svg and, last, results.json.
std::vector<NamedContent> chart_content(const boost::json::object& document, const PrecisionChart& chart,
                                        const std::string& title);

}  // namespace hauberk
