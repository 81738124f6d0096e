#include "run/machine.hpp"

#include "run/first_line.hpp"

#include <sched.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace hauberk {
namespace {

/// The first entry "model name : ..."; some processors have none.
std::string processor_name()
{
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(':');
    const std::size_t name = line.find_first_not_of(" \t", std::min(colon, line.size() - 1) + 1);
    return name < line.size() ? line.substr(name) : "";
  }
  return "";
}

/// The path of this process' group of version 2, "/" where there is none.
std::string own_group()
{
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("0::/")) return line.substr(3);
  return "/";
}

std::optional<unsigned> least(std::optional<unsigned> a, std::optional<unsigned> b)
{
  return a && b ? std::min(a, b) : a ? a : b;
}

std::optional<unsigned> quota_of_groups()
{
  const std::filesystem::path root = "/sys/fs/cgroup";
  std::optional<unsigned> out;
  for (std::filesystem::path group = own_group();; group = group.parent_path()) {
    out = least(out, processors_of_quota(first_line(root / group.relative_path() / "cpu.max")));
    if (!group.has_relative_path()) break;
  }
  const std::string period = first_line(root / "cpu/cpu.cfs_period_us");
  return least(out, processors_of_quota(first_line(root / "cpu/cpu.cfs_quota_us") + " " + period));
}

std::optional<unsigned> count_in(const char* text)
{
  unsigned count = 0;
  const std::string_view all = text == nullptr ? "" : text;
  const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), count);
  return error == std::errc() && end == all.data() + all.size() && count > 0 ? std::optional(count)
                                                                             : std::nullopt;
}

/// Null where there are more processors than a set of the usual size holds.
std::optional<unsigned> affinity()
{
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return std::nullopt;
  return static_cast<unsigned>(CPU_COUNT(&set));
}

}  // namespace

std::optional<unsigned> processors_of_quota(std::string_view cpu_max)
{
  std::istringstream in{std::string(cpu_max)};
  double quota = 0.0, period = 0.0;
  if (!(in >> quota >> period) || !(quota > 0.0) || !(period > 0.0)) return std::nullopt;
  constexpr double most = 1e6;
  return static_cast<unsigned>(std::min(most, std::ceil(quota / period)));
}

unsigned available_processors()
{
  std::optional<unsigned> out = affinity();
  if (!out) out = std::thread::hardware_concurrency();
  out = least(out, quota_of_groups());
  out = least(out, count_in(std::getenv("SLURM_CPUS_PER_TASK")));
  return std::max(1U, *out);
}

Machine this_machine()
{
  Machine machine;
  machine.processor = processor_name();
  machine.processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  double load = 0.0;
  if (::getloadavg(&load, 1) == 1) machine.load_average = load;
  return machine;
}

}  // namespace hauberk
