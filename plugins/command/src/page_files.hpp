#pragma once
/// The page of a run, of a report and of an export: where its viewer is, and how it is made of results.

#include "export/page.hpp"
#include "tasks/job.hpp"

#include <memory>
#include <string>

namespace hauberk::command {

/// Reads template and viewer of pages from where this program has its data. Throws InputError, with the way
/// out, where the viewer was not built.
exporting::PageParts installed_page_parts();

/// The job of the experiment that results hold. Throws as prepare_job.
Job job_of_results(std::shared_ptr<const Registry> registry, const boost::json::value& results,
                   const std::string& file);

/// What a run leaves as its page: made of its final document, with the pictures of its files. A page that
/// cannot be made is told of and left out: results are not lost for it. `job` outlives it.
FurtherFiles page_of_run(const Job& job, exporting::PageParts parts);

}  // namespace hauberk::command
