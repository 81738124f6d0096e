#include "tasks/chart/chart_summary.hpp"

#include "run/text_table.hpp"

#include <fmt/format.h>

namespace hauberk {
namespace {

constexpr double megabyte = 1e6;

std::vector<std::string> row(const PrecisionChart& chart, const PrecisionPoint& p)
{
  const PrecisionMethod& method = chart.methods[p.method];
  std::vector<std::string> out{chart.scenes[p.scene].name, method.name, method.settings[p.setting]};
  if (chart.threads.size() > 1) out.push_back(std::to_string(p.threads));
  out.push_back(p.error ? fmt::format("{:.2e}", *p.error) : to_string(p.status));
  out.push_back(p.seconds.empty() ? "-" : fmt::format("{:.6f}", *p.median_seconds()));
  out.push_back(p.first ? std::to_string(p.first->evaluations) : "-");
  out.push_back(p.first ? std::to_string(p.first->iterations) : "-");
  out.push_back(p.peak_memory_bytes
                    ? fmt::format("{:.2f}", static_cast<double>(*p.peak_memory_bytes) / megabyte)
                    : "-");
  return out;
}

}  // namespace

std::string chart_summary(const PrecisionChart& chart)
{
  std::vector<std::vector<std::string>> cells{{"scene", "method", "setting"}};
  if (chart.threads.size() > 1) cells.front().emplace_back("threads");
  for (const char* name : {"error", "median s", "evaluations", "Newton steps", "peak MB"})
    cells.front().emplace_back(name);
  for (const PrecisionPoint& p : chart.points) cells.push_back(row(chart, p));
  std::string text = text_table(cells, 3);
  for (const PrecisionPoint& p : chart.points) {
    if (!p.message.empty())
      text += fmt::format("{}: {}: {}\n", point_name(chart, p), to_string(p.status), p.message);
  }
  return text;
}

}  // namespace hauberk
