#include "run/scene_at_rest.hpp"

#include "equilibrium/rest.hpp"
#include "run/presets.hpp"

namespace hauberk {

SceneAtRest scene_at_rest(const Experiment& e, std::vector<std::string>& problems)
{
  SceneAtRest out;
  out.model = make_model(e.scene, *e.load_case, e.solver.clearance);
  problems = rest_problems(e.scene, out.model, e.relax);
  if (!problems.empty()) return out;
  PreparedScene rest = prepare_rest(e.scene, out.model);
  out.scene = std::move(rest.scene);
  out.moved = rest.moved;
  if (out.moved > 0.0) out.model = make_model(out.scene, *e.load_case, e.solver.clearance);
  out.settings = limit_settings(e.solver, out.scene, e.length_unit);
  out.settings.start = std::move(rest.start);
  return out;
}

}  // namespace hauberk
