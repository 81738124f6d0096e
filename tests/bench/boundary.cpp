/// What the boundary of plugins costs: the same limit with shape and load case as plugins, behind the guard,
/// or linked in. Count what `measured` does:
///
///     valgrind --tool=callgrind --toggle-collect='*measured*' build/release/bin/tests/boundary_cost
///     plugins|linked

#include "../../loadcases/in_plane_periodic/in_plane_periodic.hpp"
#include "../../shapes/torus_union/torus_union.hpp"
#include "limits/limits.hpp"
#include "run/limit_tasks.hpp"
#include "run/prepared.hpp"

#include <fmt/format.h>

#include <string_view>

namespace {

using namespace hauberk;

/// Makes the model, too: it is what asks shapes.
[[gnu::noinline]] LimitResult measured(const Prepared& p, const SceneSpec& scene, const LoadCase& load)
{
  const Model model = make_model(scene, load, p.experiment.solver.clearance);
  return compute_limits(model, scene, profile_tasks(p.experiment), p.settings, 1).front();
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2) return 2;
  const auto registry = std::make_shared<Registry>(std::vector<std::filesystem::path>{HAUBERK_PLUGIN_FOLDER});
  const std::string file = HAUBERK_SOURCE_DIR "/share/experiments/chain.json";
  const std::unique_ptr<const Prepared> prepared =
      prepare_experiment(registry,
                         {file,
                          read_text_file(file),
                          {"/load_case/directions_deg=[0]", "/load_case/senses=[\"stretch\"]",
                           "/cell/repeat=[8,1]", "/solver/neighbours=0"}},
                         [](const Prepared&, Diagnostics&) {});
  SceneSpec scene = prepared->scene;
  std::shared_ptr<const LoadCase> load = prepared->experiment.load_case;
  if (std::string_view(argv[1]) == "linked") {
    Torus ring;
    ring.name = "ring";
    for (ElementType& type : scene.types)
      type.shape = std::make_shared<TorusUnion>(std::vector<std::string>{"ring"}, std::vector<Torus>{ring});
    load = std::make_shared<InPlanePeriodic>(StrainMeasure::tensor, InPlanePeriodic::OutOfPlane{},
                                             InPlanePeriodic::Hold{true, false});
  }
  const LimitResult limit = measured(*prepared, scene, *load);
  fmt::print("{} {:.17g} {} iterations\n", to_string(limit.status), limit.value.value_or(0.0),
             limit.iterations);
}
