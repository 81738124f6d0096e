#pragma once
/// From the options of a command to an experiment's job.

#include "options.hpp"
#include "tasks/job.hpp"

namespace hauberk::command {

/// The registry for --plugin-path, HAUBERK_PLUGIN_PATH and this program's place.
std::shared_ptr<const Registry> open_registry(const Options& options);

/// The experiment that `options` name, with --set. Throws as prepare_job.
Job open_job(const Options& options);

}  // namespace hauberk::command
