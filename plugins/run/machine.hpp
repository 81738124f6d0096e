#pragma once
/// What a run has to work with.

#include "results/document.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

namespace hauberk {

/// The processor as /proc/cpuinfo names it, how many there are, and the load average of the last minute.
/// Thread safe.
Machine this_machine();

/// Processors that this process may use, at least 1: those of its affinity, no more than its control groups
/// (processors_of_groups) allow, and no more than SLURM_CPUS_PER_TASK says. Thread safe.
unsigned available_processors();

/// Whole processors that a quota amounts to, rounded up: `cpu_max` is the text of cpu.max, a quota and a
/// period in microseconds. Null where there is no limit, or none that can be read.
std::optional<unsigned> processors_of_quota(std::string_view cpu_max);

/// The least quota of processors of the groups that `own`, the text of /proc/self/cgroup, names, and of all
/// above them: cpu.max of version 2, cpu.cfs_quota_us and cpu.cfs_period_us of version 1. `root`: where the
/// trees of groups are. Null: none of them limits it.
std::optional<unsigned> processors_of_groups(const std::filesystem::path& root, std::string_view own);

/// Bytes of memory that this process may use: those of the machine, no more than its control groups
/// (memory_of_groups) and its limits of address space and data allow. Whether others use them is not asked.
/// Thread safe.
double available_memory();

/// The least limit of memory of the groups that `own`, the text of /proc/self/cgroup, names, and of all above
/// them: memory.max of version 2, memory.limit_in_bytes of version 1, which also lie beside each other.
/// `root`: where the trees of groups are. Null: none of them limits it.
std::optional<double> memory_of_groups(const std::filesystem::path& root, std::string_view own);

/// Bytes of the text of memory.max. Null where there is no limit, or none that can be read.
std::optional<double> bytes_of_limit(std::string_view memory_max);

}  // namespace hauberk
