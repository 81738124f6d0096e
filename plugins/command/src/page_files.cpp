#include "page_files.hpp"

#include "document/json_place.hpp"
#include "document/json_text.hpp"
#include "results/document.hpp"
#include "run/weave_library.hpp"
#include "say.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/search_path.hpp>

#include <utility>

namespace hauberk::command {

exporting::PageParts installed_page_parts()
{
  return exporting::read_page_parts((shared_data_folder() / "web").string());
}

Job job_of_results(std::shared_ptr<const Registry> registry, const boost::json::value& results,
                   const std::string& file)
{
  const detail::JsonPlace document(results, file);
  return prepare_job(std::move(registry),
                     {file, write_json(document.at("experiment").value()), {}, weave_lookup(file)});
}

FurtherFiles page_of_run(const Job& job, exporting::PageParts parts)
{
  return [&job, parts = std::move(parts)](const boost::json::object& document,
                                          std::span<const ResultFile> files) {
    std::vector<ResultFile> out;
    exporting::PageView view;
    for (const ResultFile& file : files)
      if (file.name.ends_with(".svg")) view.figures.push_back({file.name, file.content});
    try {
      out.push_back(
          {"page", page_file,
           page({page_entry(boost::json::value(document), results_file, job.prepared->scene, view)}, parts)});
    } catch (const std::exception& error) {
      say_error("hauberk: warning: {}: {}\n", page_file, error.what());
    }
    return out;
  };
}

}  // namespace hauberk::command
