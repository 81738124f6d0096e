#include "tasks/job.hpp"

#include "document/json_text.hpp"
#include "document/json_writer.hpp"
#include "results/timings.hpp"
#include "run/plan_text.hpp"
#include "tasks/limits/limits_task.hpp"
#include "tasks/table.hpp"

#include <hauberk/error.hpp>

namespace hauberk {

Job prepare_job(std::shared_ptr<const Registry> registry, const ExperimentSource& source)
{
  Job job;
  ExperimentSource with_tasks = source;
  with_tasks.formats = task_formats();
  job.prepared = prepare_experiment(
      std::move(registry), with_tasks, [&job](const Prepared& prepared, Diagnostics& diagnostics) {
        job.task = task_named(prepared.experiment.task).prepare(prepared, diagnostics);
        if (!diagnostics.empty()) return;
        job.plan = make_plan(prepared.model, job.task->limit_tasks(), prepared.settings);
        job.task->check_plan(job.plan, diagnostics);
      });
  return job;
}

Job solved(Job job, std::vector<LimitResult> limits)
{
  job.task = solved_limits(*job.prepared, std::move(limits));
  return job;
}

boost::json::object plan_document(const Job& job)
{
  boost::json::object plan = plan_json(*job.prepared, job.plan);
  plan["task"] = job.task->plan();
  return plan;
}

ShownPlan show_plan(const Job& job)
{
  const std::vector<TightPair> tightest = tightest_pairs(job.prepared->model);
  ShownPlan out{plan_text(*job.prepared, job.plan, job.task->plan(), tightest), plan_document(job)};
  out.document["tightest"] = tightest_json(tightest);
  return out;
}

boost::json::object blank_document(const Job& job, const Provenance& provenance)
{
  const Prepared& prepared = *job.prepared;
  return document_without_results(write_json(prepared.experiment.resolved), provenance, plan_document(job),
                                  prepared.scene);
}

std::vector<NamedContent> result_content(const Job& job, const std::filesystem::path& folder,
                                         boost::json::object& document, const FurtherFiles& further)
{
  job.task->enter(document);
  std::vector<NamedContent> out;
  std::vector<ResultFile> files = job.task->files(folder);
  if (further) {
    for (ResultFile& file : further(document, files)) files.push_back(std::move(file));
  }
  boost::json::object& names = document["files"].emplace_object();
  for (ResultFile& file : files) {
    names[file.what] = file.name;
    out.push_back({std::move(file.name), std::move(file.content)});
  }
  const boost::json::object timings = take_timings(document);
  names["timings"] = timings_file;
  out.push_back({timings_file, write_json(timings)});
  out.push_back({results_file, write_json(document)});
  return out;
}

}  // namespace hauberk
