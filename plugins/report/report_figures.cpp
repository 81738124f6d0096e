#include "report/report_figures.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk::detail {
namespace {

constexpr double per_cent = 100.0;

double mean_target(const ReportDesign& design)
{
  double sum = 0.0;
  for (const ReportTarget& t : design.targets) sum += std::abs(t.target);
  return design.targets.empty() ? 0.0 : sum / static_cast<double>(design.targets.size());
}

void raise(std::optional<double>& largest, const std::optional<double>& x)
{
  if (x && (!largest || *x > *largest)) largest = x;
}

}  // namespace

std::optional<double> miss_of(const ReportTarget& target)
{
  return target.recomputed ? std::optional(miss(target.aim, target.target, *target.recomputed))
                           : std::nullopt;
}

Deviation deviation(const ReportDesign& design, TargetValue value, TargetValue with)
{
  Deviation out;
  double sum = 0.0, worst = 0.0;
  for (const ReportTarget& t : design.targets) {
    if (!(t.*value) || (with != nullptr && !(t.*with))) continue;
    const double d = std::abs(miss(t.aim, t.target, *(t.*value)));
    sum += d * d;
    worst = std::max(worst, d);
    ++out.values;
  }
  const double mean = mean_target(design);
  if (out.values == 0 || !(mean > 0.0)) return out;
  out.rms = per_cent * std::sqrt(sum / static_cast<double>(out.values)) / mean;
  out.worst = per_cent * worst / mean;
  return out;
}

std::optional<double> published_worst(const ReportDesign& design)
{
  std::optional<double> out = deviation(design, &ReportTarget::published).worst;
  const double mean = mean_target(design);
  if (!design.published || !design.published->lowest || !design.published->highest || !(mean > 0.0))
    return out;
  const double target = design.targets.front().target;
  const bool same = std::all_of(design.targets.begin(), design.targets.end(),
                                [target](const ReportTarget& t) { return t.target == target; });
  if (!same) return out;
  for (const std::optional<double>& end : {design.published->lowest, design.published->highest})
    raise(out, per_cent * std::abs(*end - target) / mean);
  return out;
}

std::optional<double> recheck_change(const ReportDesign& design)
{
  std::optional<double> out;
  const double mean = mean_target(design);
  for (const ReportTarget& t : design.targets) {
    if (t.recomputed && t.rechecked && mean > 0.0)
      raise(out, per_cent * std::abs(*t.rechecked - *t.recomputed) / mean);
  }
  return out;
}

std::optional<double> relative_percent(const std::optional<double>& from, const std::optional<double>& to,
                                       double target)
{
  if (!from || !to || target == 0.0) return std::nullopt;
  return per_cent * (*to - *from) / std::abs(target);
}

std::size_t targets_met(const ReportDesign& design)
{
  const auto n = std::count_if(design.targets.begin(), design.targets.end(),
                               [](const ReportTarget& t) { return t.met; });
  return static_cast<std::size_t>(n);
}

std::optional<double> published_seconds(const ReportDesign& design)
{
  if (!design.published || !design.published->iterations || !design.published->seconds_per_iteration)
    return std::nullopt;
  return *design.published->iterations * *design.published->seconds_per_iteration;
}

ReportTotals totals(std::span<const ReportEntry> entries)
{
  ReportTotals out;
  for (const ReportEntry& entry : entries) {
    if (!entry.design) continue;
    const ReportDesign& design = *entry.design;
    ++out.designs;
    out.targets += design.targets.size();
    out.met += targets_met(design);
    out.iterations += design.iterations;
    out.evaluations += design.evaluations;
    if (design.seconds) out.seconds = out.seconds.value_or(0.0) + *design.seconds;
    raise(out.peak_memory, entry.peak_memory);
    const std::optional<double> theirs = published_seconds(design);
    if (!theirs || !design.seconds) continue;
    ++out.published;
    out.published_seconds += *theirs;
    out.seconds_of_published += *design.seconds;
  }
  return out;
}

std::vector<std::string> distinct_names(std::span<const ReportEntry> entries)
{
  std::vector<std::string> out;
  out.reserve(entries.size());
  for (const ReportEntry& entry : entries) {
    const auto n = std::count_if(entries.begin(), entries.end(),
                                 [&](const ReportEntry& other) { return other.name == entry.name; });
    out.push_back(n == 1 ? entry.name : entry.name + " (" + entry.file + ")");
  }
  return out;
}

std::string quantity_text(const ReportEntry& entry)
{
  if (!entry.design) return {};
  return entry.design->quantity + (entry.unit == "strain" ? "" : " (" + entry.unit + ")");
}

}  // namespace hauberk::detail
