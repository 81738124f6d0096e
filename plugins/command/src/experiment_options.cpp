#include "experiment_options.hpp"

#include "run/weave_library.hpp"

#include <hauberk/host/search_path.hpp>

namespace hauberk::command {

std::shared_ptr<const Registry> open_registry(const Options& options)
{
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : options.list("plugin-path")) folders.emplace_back(folder);
  return std::make_shared<Registry>(plugin_search_path(folders));
}

Job open_job(const Options& options)
{
  const std::string& file = options.positional();
  return prepare_job(open_registry(options),
                     {file, read_text_file(file), options.list("set"), weave_lookup(file)});
}

}  // namespace hauberk::command
