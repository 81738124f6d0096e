#include "scenes.hpp"

#include <hauberk/host/registry.hpp>

#include <filesystem>

namespace hauberk::bench {

std::string Source::arguments() const
{
  std::string text = file;
  for (const std::string& assignment : set) text += " --set '" + assignment + "'";
  return text;
}

Source published_limits(const std::string& material, std::vector<std::string> set)
{
  return {"share/experiments/" + material + "_limits.json", std::move(set)};
}

Scenes::Scenes()
    : registry_(std::make_shared<const Registry>(
          std::vector<std::filesystem::path>{std::filesystem::path(HAUBERK_PLUGIN_FOLDER)}))
{
}

const Scene& Scenes::at(const Source& source)
{
  const std::string key = source.arguments();
  if (const auto known = scenes_.find(key); known != scenes_.end()) return known->second;
  const std::string path = std::string(HAUBERK_SOURCE_DIR) + "/" + source.file;
  Job job = prepare_job(registry_, {source.file, read_text_file(path), source.set});
  return scenes_.emplace(key, Scene{std::move(job)}).first->second;
}

}  // namespace hauberk::bench
