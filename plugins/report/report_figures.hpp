#pragma once
/// Figures of merit of designs, which all files of a report share.

#include "report/report.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hauberk::detail {

/// Deviations from targets, none where a bound is kept, in per cent of the mean absolute target of all
/// directions (null where that is zero, or no direction has a value).
struct Deviation {
  std::size_t values = 0;  ///< directions that count
  std::optional<double> rms, worst;
};

using TargetValue = std::optional<double> ReportTarget::*;

/// Recomputed less target, 0 where a bound is kept; null without a value.
std::optional<double> miss_of(const ReportTarget& target);

/// Of `value` in the directions that have it and `with` (null: no further condition).
Deviation deviation(const ReportDesign& design, TargetValue value, TargetValue with = nullptr);

/// The largest deviation that is known of the publication, per direction or from its range, which says
/// something where all targets are the same; in per cent as above.
std::optional<double> published_worst(const ReportDesign& design);

/// Largest change from recomputed to rechecked values, in per cent as above.
std::optional<double> recheck_change(const ReportDesign& design);

/// (to - from)/|target| in per cent; null where one is missing, or the target is zero.
std::optional<double> relative_percent(const std::optional<double>& from, const std::optional<double>& to,
                                       double target);

std::size_t targets_met(const ReportDesign& design);

/// Sums over all designs.
struct ReportTotals {
  std::size_t designs = 0, targets = 0, met = 0;
  std::int64_t iterations = 0, evaluations = 0;
  std::optional<double> seconds;      ///< of those that tell it
  std::optional<double> peak_memory;  ///< the largest
  /// Of those designs of which the publication says it.
  std::size_t published = 0;
  double seconds_of_published = 0.0, published_seconds = 0.0;  ///< ours, theirs
};
ReportTotals totals(std::span<const ReportEntry> entries);

/// Seconds of the publication: iterations times their time.
std::optional<double> published_seconds(const ReportDesign& design);

/// Names as printed: those that several entries have are followed by their files.
std::vector<std::string> distinct_names(std::span<const ReportEntry> entries);

/// "eta", "stretch", or with its unit "curvature (1/mm)".
std::string quantity_text(const ReportEntry& entry);

}  // namespace hauberk::detail
