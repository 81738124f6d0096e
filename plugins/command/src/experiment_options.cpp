#include "experiment_options.hpp"

#include "run/loose_parts.hpp"
#include "run/weave_library.hpp"
#include "say.hpp"
#include "tasks/table.hpp"

#include <hauberk/host/search_path.hpp>
#include <hauberk/host/trust.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace hauberk::command {

std::shared_ptr<const Registry> open_registry(const Options& options)
{
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : options.list("plugin-path")) folders.emplace_back(folder);
  return registry_of(folders);
}

std::shared_ptr<const Registry> registry_of(const std::vector<std::filesystem::path>& folders)
{
  return std::make_shared<Registry>(plugin_search_path(folders));
}

std::vector<std::string> named_plugin_folders(const std::vector<std::filesystem::path>& by_hand)
{
  const std::vector<std::filesystem::path> all = plugin_search_path(by_hand), own = own_plugin_folders();
  std::vector<std::string> out;
  for (const std::filesystem::path& folder : all) {
    std::error_code unknown;
    const bool named = std::find(own.begin(), own.end(), folder) == own.end();
    if (named && std::filesystem::is_directory(folder, unknown)) out.push_back(folder.string());
  }
  return out;
}

std::string shadow_text(const std::string& id, const std::filesystem::path& used,
                        const std::filesystem::path& shadowed)
{
  return fmt::format("of the plugin '{}' the file '{}' is used, and '{}' is not", id, used.string(),
                     shadowed.string());
}

void warn_of_plugins(const Prepared& prepared)
{
  for (const std::string& warning : open_to_others(prepared.registry->directories()))
    say_error("hauberk: warning: {}\n", warning);
  for (const Provenance::Plugin& plugin : prepared.plugins) {
    const std::vector<std::filesystem::path> files = prepared.registry->files(plugin.id);
    for (std::size_t k = 1; k < files.size(); ++k)
      say_error("hauberk: warning: {}\n", shadow_text(plugin.id, files[0], files[k]));
  }
}

void warn_of_loose_parts(const Prepared& prepared)
{
  for (const std::string& warning : loose_parts(prepared.scene)) say_error("hauberk: warning: {}\n", warning);
}

void read_alone(const Options& options)
{
  const std::string& file = options.positional();
  const std::shared_ptr<const Registry> registry = open_registry(options);
  Diagnostics diagnostics;
  const std::optional<Experiment> experiment = read_experiment(
      {file, read_text_file(file), options.list("set"), weave_lookup(file), {}, task_formats()},
      lookup_in(*registry), diagnostics);
  if (!experiment) throw ReportedProblems(diagnostics);
}

Job open_job(const Options& options)
{
  const std::string& file = options.positional();
  return prepare_job(open_registry(options),
                     {file, read_text_file(file), options.list("set"), weave_lookup(file)});
}

}  // namespace hauberk::command
