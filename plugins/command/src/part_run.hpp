#pragma once
/// One part of a run that is divided (run --part), and what all commands of such runs share.

#include "parts/part_folder.hpp"
#include "parts/search_log.hpp"
#include "run_experiment.hpp"

namespace hauberk::command {

/// The part that --part names. Throws UsageError for what is none, and for options that parts do not have.
Share part_of(const Options& options);

/// What the folder is to say of a division into so many parts.
Division division_of(const Options& options, const Job& job, std::size_t count);

/// Digest of what the job computes and by which program, its libraries and plugins.
std::string identity_of(const Job& job);

/// What logs of this process say of it.
LogOrigin log_origin(const std::string& part);

/// Throws InputError where the job's task cannot be divided.
void refuse_whole(const Job& job);

/// Computes a part, or what is left of it, and returns the exit code.
int run_part(Job& job, const Share& share, const Options& options, const RunRequest& request);

}  // namespace hauberk::command
