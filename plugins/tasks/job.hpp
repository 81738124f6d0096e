#pragma once
/// An experiment with its task and its plan: what check, plan and run begin from.

#include "document/atomic_file.hpp"
#include "tasks/task.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

struct Job {
  std::unique_ptr<const Prepared> prepared;
  std::unique_ptr<TaskRun> task;
  Plan plan;
};

/// Reads and checks an experiment with everything that its task needs; computes nothing but rest states.
/// Throws ReportedProblems with a line per problem, InputError when a file cannot be read.
Job prepare_job(std::shared_ptr<const Registry> registry, const ExperimentSource& source);

/// A job of the task `limits` that is done, with the limits that it asks for: its results can be written.
Job solved(Job job, std::vector<LimitResult> limits);

/// The plan of results.json.
boost::json::object plan_document(const Job& job);

/// What `hauberk plan` says: the plan of results.json, and the tightest pairs at rest.
struct ShownPlan {
  std::string text;
  boost::json::object document;
};
ShownPlan show_plan(const Job& job);

/// The document of results.json without results: what does not change while the task runs.
boost::json::object blank_document(const Job& job, const Provenance& provenance);

/// What a run leaves beside the files of its task, made from its document and from these.
using FurtherFiles =
    std::function<std::vector<ResultFile>(const boost::json::object&, std::span<const ResultFile>)>;

/// Enters the job's results into a blank document, takes out what the run itself took (results/timings.hpp),
/// and returns it with the files beside it, results.json last. `further`: may be empty.
std::vector<NamedContent> result_content(const Job& job, const std::filesystem::path& folder,
                                         boost::json::object& document, const FurtherFiles& further);

}  // namespace hauberk
