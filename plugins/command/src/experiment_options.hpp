#pragma once
/// From the options of a command to an experiment's job.

#include "options.hpp"
#include "tasks/job.hpp"

namespace hauberk::command {

/// The registry for --plugin-path, HAUBERK_PLUGIN_PATH and this program's place.
std::shared_ptr<const Registry> open_registry(const Options& options);
/// The same for folders that come before HAUBERK_PLUGIN_PATH.
std::shared_ptr<const Registry> registry_of(const std::vector<std::filesystem::path>& folders);

/// Folders for plugins that are named by hand or by HAUBERK_PLUGIN_PATH and exist, absolute, in the order in
/// which they are searched: what another process needs as its --plugin-path.
std::vector<std::string> named_plugin_folders(const std::vector<std::filesystem::path>& by_hand);

/// "of the plugin 'ID' the file 'A' is used, and 'B' is not".
std::string shadow_text(const std::string& id, const std::filesystem::path& used,
                        const std::filesystem::path& shadowed);

/// Says on stderr where somebody else may write plugins, and which files of those that the experiment uses
/// are shadowed.
void warn_of_plugins(const Prepared& prepared);
/// Says which elements are no one body.
void warn_of_loose_parts(const Prepared& prepared);

/// Reads the experiment that `options` name, and nothing that is made of it. Throws ReportedProblems.
void read_alone(const Options& options);

/// The experiment that `options` name, with --set. Throws as prepare_job.
Job open_job(const Options& options);

}  // namespace hauberk::command
