#include "transition_run.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk::command {
namespace {

std::string jump_text(const TransitionJump& jump)
{
  if (jump.relative <= jump.resolution) return fmt::format("< {:.1e}", std::max(jump.resolution, 1e-16));
  return fmt::format("{:.3e} at {:.4f}", jump.relative, jump.at);
}

}  // namespace

TransitionJob transition_job(const Experiment& experiment, const SceneSpec& scene, const Schedule& schedule)
{
  const ExperimentTransition& from = experiment.transition.value();
  TransitionJob job;
  job.model =
      std::make_shared<const Model>(make_model(scene, *experiment.load_case, experiment.solver.clearance));
  const double length = job.model->length;
  job.spec.model = job.model.get();
  job.spec.fixed = from.fixed;
  job.spec.moving = from.moving;
  job.spec.g_hat = from.activation_distance / length;
  job.spec.range = from.range / length;
  job.spec.contacts = from.contacts;
  job.spec.schedule = schedule;
  job.spec.length_unit = experiment.length_unit;
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
    job.spec.paths.push_back(std::move(motion));
  }
  return job;
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

}  // namespace hauberk::command
