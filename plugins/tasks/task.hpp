#pragma once
/// What a task is to the rest of the program: one of a table, prepared from an experiment, run, and entered
/// into its results.

#include "limits/plan.hpp"
#include "run/context.hpp"
#include "run/limit_tasks.hpp"
#include "run/prepared.hpp"
#include "run/work.hpp"

#include <boost/json/object.hpp>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// A file of the results beside results.json.
struct ResultFile {
  std::string what;  ///< its key in `files` of results.json
  std::string name;
  std::string content;
};

/// One experiment's task, ready to run. What it was prepared from outlives it. Not thread safe.
///
/// Calls come in this order: `limit_tasks`, of which the scene's plan is made; `check_plan`; `check_line` for
/// `check`, `plan` for `plan` and for results; `work`; and to compute `resume` if there are partial results,
/// `run`, `enter`, `files`, `summary`, `failed`. `enter` and `files` are called from within `run`, too,
/// whenever the context saves: they give what there is. A task has to have the pure ones; the defaults of the
/// others are those of a task that solves the limits of its experiment.
///
/// `enter` and `files` run in the thread that calls `save` or `save_sometimes` of the context. A task that
/// computes in several threads holds one lock while it changes what these two read, and while it saves. They
/// are also called after a `run` that threw ComputationError or InputError, and give what was finished. Where
/// `resume` returns true, only `failed` is called after it.
///
/// Of a run that is divided, each part is prepared like any run, and calls `run_part` instead of `run` and of
/// what follows it; who gathers the parts calls `join_parts` before `run`, whose context has a memory of what
/// the parts have found.
class TaskRun {
 public:
  explicit TaskRun(const Prepared& prepared) : prepared_(prepared) {}
  virtual ~TaskRun() = default;
  TaskRun(const TaskRun&) = delete;
  TaskRun& operator=(const TaskRun&) = delete;

  /// Limits of the experiment as it is, which the plan speaks of; in the order of the results.
  virtual std::vector<LimitTask> limit_tasks() const { return profile_tasks(prepared_.experiment); }
  /// Adds problems that only the plan shows.
  virtual void check_plan(const Plan& /*plan*/, Diagnostics& /*diagnostics*/) const {}
  /// What `check` says of an experiment without problems: "19 elements, 4 limits".
  virtual std::string check_line(const Plan& plan) const = 0;
  /// What it is going to do beyond one solve of `limit_tasks`: counts and settings by name, for `hauberk
  /// plan` and results. Numbers, words, and lists or objects of them.
  virtual boost::json::object plan() const { return {}; }
  /// What it takes at least.
  virtual Work work(const Plan& plan) const { return work_of(plan, plan.searches); }
  /// Whether times are results, so that two machines must not be mixed.
  virtual bool measures_time() const { return false; }

  /// Takes over what partial results of the same experiment hold; true if nothing is left to be done. Throws
  /// InputError where they do not fit, and what Boost.JSON throws where they are damaged.
  virtual bool resume(const boost::json::value& results) = 0;
  /// What --resume says: "resuming: finished rows are kept".
  virtual std::string resume_note() const = 0;

  /// Computes until done or interrupted. Throws ComputationError or InputError where it cannot go on.
  virtual void run(RunContext& context) = 0;

  /// Why it cannot be divided into parts, a clause; empty: it can.
  virtual std::string why_whole() const { return "where it looks depends on what it has found"; }
  /// Does a share of what stands alone: limits for the context's memory, whatever else in files of its
  /// folder, which is the part's own. Nothing of it is entered into results. Throws as `run`.
  virtual void run_part(RunContext& /*context*/, const Share& /*share*/) {}
  /// Takes over what parts have left in their folders beside searches.
  virtual void join_parts(RunContext& /*context*/, const std::vector<std::filesystem::path>& /*folders*/) {}

  /// Enters what there is into results that hold the scene and no limits.
  virtual void enter(boost::json::object& results) const = 0;
  /// Files for a folder of results.
  virtual std::vector<ResultFile> files(const std::filesystem::path& folder) const = 0;
  /// Tables and remarks for the terminal; several lines.
  virtual std::string summary() const = 0;
  /// Whether something that was asked for has no answer.
  virtual bool failed() const = 0;

 protected:
  const Prepared& prepared_;
};

/// An entry of the table of tasks.
struct Task {
  std::string_view name;
  std::span<const char* const> file_names;  ///< that it may leave beside results.json
  /// Reads and checks what the task needs; problems go to the diagnostics, and with any of them the run that
  /// is returned cannot be used.
  std::unique_ptr<TaskRun> (*prepare)(const Prepared& prepared, Diagnostics& diagnostics);
};

}  // namespace hauberk
