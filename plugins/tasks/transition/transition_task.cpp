#include "tasks/transition/transition_task.hpp"

#include "run/interrupt.hpp"
#include "run/limit_tasks.hpp"
#include "run/nearest_node.hpp"
#include "tasks/transition/transition_results.hpp"
#include "tasks/transition/transition_run.hpp"
#include "tasks/transition/transition_section.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

std::string jump_text(const TransitionJump& jump)
{
  if (jump.relative <= jump.resolution) return fmt::format("< {:.1e}", std::max(jump.resolution, 1e-16));
  return fmt::format("{:.3e} at {:.4f}", jump.relative, jump.at);
}

TransitionSpec transition_spec(const Prepared& prepared)
{
  const ExperimentTransition& from = *prepared.experiment.section<ExperimentTransition>();
  const double length = prepared.model.length;
  TransitionSpec spec;
  spec.model = &prepared.model;
  spec.fixed = from.fixed;
  spec.moving = from.moving;
  spec.g_hat = from.activation_distance / length;
  spec.range = from.range / length;
  spec.contacts = from.contacts;
  spec.schedule = prepared.settings.schedule;
  spec.length_unit = prepared.experiment.length_unit;
  for (const TransitionPathInput& path : from.paths) {
    TransitionMotion motion;
    motion.name = path.name;
    motion.steps = path.steps;
    motion.motion = {path.axis,
                     path.through / length,
                     path.degrees_from * degree,
                     path.degrees_to * degree,
                     path.shift_from / length,
                     path.shift_to / length};
    spec.paths.push_back(std::move(motion));
  }
  return spec;
}

std::string transition_summary(const TransitionResult& result)
{
  std::size_t width = 4;
  for (const TransitionPath& path : result.paths) width = std::max(width, path.name.size());
  std::string text = "largest jumps, relative to the largest value on the path, and where (0 to 1)\n";
  text += fmt::format("{:<{}}  {:<10} {:<20} {:<20} {}\n", "path", width, "contact", "energy", "force",
                      "error of quadrature (energy, force)");
  for (const TransitionPath& path : result.paths) {
    for (std::size_t k = 0; k < path.curves.size(); ++k) {
      const TransitionCurve& c = path.curves[k];
      const std::string quadrature =
          c.quadrature ? fmt::format("{:.1e}, {:.1e}", c.quadrature->first, c.quadrature->second) : "";
      std::string row = fmt::format("{:<{}}  {:<10} {:<20} {:<20} {}", k == 0 ? path.name : "", width,
                                    c.contact, jump_text(c.energy), jump_text(c.force), quadrature);
      row.erase(row.find_last_not_of(' ') + 1);
      text += row + "\n";
    }
  }
  return text;
}

bool only_tori(const Model& model)
{
  return std::all_of(model.bodies.begin(), model.bodies.end(),
                     [](const Body& body) { return body.is_torus(); });
}

class TransitionTask final : public TaskRun {
 public:
  TransitionTask(const Prepared& prepared, Diagnostics& diagnostics)
      : TaskRun(prepared), spec_(transition_spec(prepared))
  {
    const Experiment& e = prepared.experiment;
    if (!only_tori(prepared.model)) {
      diagnostics.problems.add(
          nearest_node(e.resolved, "/task"),
          "this scene has elements that are triangle meshes, tubes around curves or solids, and task "
          "'transition' knows tori only; use task limits");
      return;
    }
    for (const auto& [path, problem] : transition_problems(spec_)) {
      const std::string pointer = fmt::format("/transition/paths/{}", path);
      diagnostics.problems.add(
          nearest_node(e.resolved, pointer),
          fmt::format("path '{}': {}", e.section<ExperimentTransition>()->paths[path].name, problem));
    }
  }

  std::string check_line(const Plan& /*plan*/) const override
  {
    return fmt::format("{} paths, {} formulations", spec_.paths.size(), spec_.contacts.size());
  }

  /// Each formulation at every step, of which the result has a row.
  Work work(const Plan& /*plan*/) const override
  {
    constexpr double row_bytes = 64.0;
    double steps = 0.0;
    for (const TransitionMotion& path : spec_.paths) steps += path.steps;
    const double count = steps * static_cast<double>(spec_.contacts.size());
    return {0.0, count, row_bytes * count};
  }

  /// Quick enough to be computed anew unless it is complete.
  bool resume(const boost::json::value& results) override
  {
    const boost::json::array& paths = results.at("transition").at("paths").as_array();
    bool complete = paths.size() == spec_.paths.size();
    for (const boost::json::value& path : paths)
      complete = complete && path.at("curves").as_array().size() == spec_.contacts.size();
    return complete;
  }

  std::string resume_note() const override { return "not finished: starting anew"; }

  void run(RunContext& context) override
  {
    result_ = run_transition(
        spec_, context.threads,
        [&context](std::size_t done, std::size_t total) {
          context.progress.limits("transition", done, total);
        },
        [] { return !interrupted(); });
    if (!result_.message.empty()) throw ComputationError(result_.message);
  }

  void enter(boost::json::object& results) const override
  {
    results["transition"] = transition_json(result_);
  }

  std::vector<ResultFile> files(const std::filesystem::path& /*folder*/) const override
  {
    const auto& [curves, minima, picture] = transition_file_names;
    return {{"transition", curves, transition_csv(result_)},
            {"minima", minima, transition_minima_csv(result_)},
            {"picture", picture, transition_svg(result_, prepared_.experiment.name)}};
  }

  std::string summary() const override { return transition_summary(result_); }
  bool failed() const override { return !result_.message.empty(); }

 private:
  TransitionSpec spec_;
  TransitionResult result_;
};

}  // namespace

std::unique_ptr<TaskRun> prepare_transition(const Prepared& prepared, Diagnostics& diagnostics)
{
  return std::make_unique<TransitionTask>(prepared, diagnostics);
}

}  // namespace hauberk
