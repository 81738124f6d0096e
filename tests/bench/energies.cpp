#include "benchmarks.hpp"
#include "equilibrium/stage.hpp"
#include "measure.hpp"
#include "model/near_pairs.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

namespace hauberk::bench {
namespace {

/// Activation distance (L) within which each of the three has contacts at rest: the nearest pairs of the
/// fourfold one are 0.06 L apart.
constexpr double activation = 0.1;

Stage stage_of(const Scene& scene, Formulation formulation)
{
  Stage stage;
  stage.contact.formulation = formulation;
  stage.contact.g_hat = activation;
  stage.contact.clearance = scene.prepared().model.clearance;
  stage.contact.quadrature = Quadrature::rough;
  return stage;
}

void measure_energy(benchmark::State& state, Scenes& scenes, const Source& source, Formulation formulation)
{
  std::size_t pairs = 0;
  long evaluations = 0;
  measure(state, [&] {
    const Scene& scene = scenes.at(source);
    return [&pairs, &evaluations, &scene = scene, stage = stage_of(scene, formulation),
            rest = rest_state(scene.prepared().model)] {
      const std::vector<ElementPair> near = stage_pairs(scene.prepared().model, rest, stage);
      const ContactEnergy energy =
          contact_energy(scene.prepared().model, rest, near, stage.contact, {2, false, false});
      if (!(energy.energy > 0.0)) throw ComputationError("nothing is in contact");
      pairs = near.size();
      evaluations = energy.evaluations;
    };
  });
  state.counters[counter::evaluations] = static_cast<double>(evaluations);
  state.counters[counter::pairs] = static_cast<double>(pairs);
}

}  // namespace

void register_energies(Scenes& scenes)
{
  for (const char* material : materials) {
    const Source source = published_limits(material);
    for (const Formulation formulation : {Formulation::nearest, Formulation::arc}) {
      enter(fmt::format("energy/{}/{}", material, name_of(formulation)),
            [&scenes, source, formulation](benchmark::State& state) {
              measure_energy(state, scenes, source, formulation);
            });
    }
  }
}

}  // namespace hauberk::bench
