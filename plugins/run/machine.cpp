#include "run/machine.hpp"

#include "run/first_line.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <thread>

namespace hauberk {
namespace {

const std::filesystem::path groups = "/sys/fs/cgroup";

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

std::string whole_text(const char* file)
{
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The path of the group of a controller in the text of /proc/self/cgroup, lines NUMBER:CONTROLLERS:PATH; of
/// version 2 there are no controllers. "/" where there is none.
std::string group_of(std::string_view own, std::string_view controller)
{
  std::istringstream lines{std::string(own)};
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos || line.compare(second + 1, 1, "/") != 0) continue;
    std::istringstream names(line.substr(first + 1, second - first - 1));
    bool is_it = controller.empty() && second == first + 1;
    for (std::string name; std::getline(names, name, ',');) is_it = is_it || name == controller;
    if (is_it) return line.substr(second + 1);
  }
  return "/";
}

template <class T>
std::optional<T> least(std::optional<T> a, std::optional<T> b)
{
  return a && b ? std::min(a, b) : a ? a : b;
}

/// The least of the limits that `limit` reads in the folders of a group and of all above it.
template <class Limit>
auto least_of_groups(const std::filesystem::path& tree, std::filesystem::path group, const Limit& limit)
    -> decltype(limit(tree))
{
  decltype(limit(tree)) out;
  for (;; group = group.parent_path()) {
    out = least(out, limit(tree / group.relative_path()));
    if (!group.has_relative_path()) return out;
  }
}

double limit_of(int resource)
{
  rlimit limit{};
  return ::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
             ? static_cast<double>(limit.rlim_cur)
             : std::numeric_limits<double>::infinity();
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

std::optional<double> bytes_of_limit(std::string_view memory_max)
{
  double bytes = 0.0;
  const char* end = memory_max.data() + memory_max.size();
  const auto [at, error] = std::from_chars(memory_max.data(), end, bytes);
  return error == std::errc() && at == end && bytes > 0.0 ? std::optional(bytes) : std::nullopt;
}

std::optional<unsigned> processors_of_groups(const std::filesystem::path& root, std::string_view own)
{
  const auto second = [](const std::filesystem::path& folder) {
    return processors_of_quota(first_line(folder / "cpu.max"));
  };
  const auto first = [](const std::filesystem::path& folder) {
    return processors_of_quota(first_line(folder / "cpu.cfs_quota_us") + " " +
                               first_line(folder / "cpu.cfs_period_us"));
  };
  return least(least_of_groups(root, group_of(own, ""), second),
               least_of_groups(root / "cpu", group_of(own, "cpu"), first));
}

std::optional<double> memory_of_groups(const std::filesystem::path& root, std::string_view own)
{
  const auto second = [](const std::filesystem::path& folder) {
    return bytes_of_limit(first_line(folder / "memory.max"));
  };
  const auto first = [](const std::filesystem::path& folder) {
    return bytes_of_limit(first_line(folder / "memory.limit_in_bytes"));
  };
  std::optional<double> out = least_of_groups(root / "memory", group_of(own, "memory"), first);
  for (const std::filesystem::path& tree : {root, root / "unified"})
    out = least(out, least_of_groups(tree, group_of(own, ""), second));
  return out;
}

double available_memory()
{
  const double machine =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  const std::optional<double> allowed = memory_of_groups(groups, whole_text("/proc/self/cgroup"));
  return std::min({machine, allowed.value_or(machine), limit_of(RLIMIT_AS), limit_of(RLIMIT_DATA)});
}

unsigned available_processors()
{
  std::optional<unsigned> out = affinity();
  if (!out) out = std::thread::hardware_concurrency();
  out = least(out, processors_of_groups(groups, whole_text("/proc/self/cgroup")));
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
