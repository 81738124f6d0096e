#include "tasks/stability/stability_loading.hpp"

#include "document/json_writer.hpp"
#include "run/limit_tasks.hpp"

#include <fmt/format.h>

#include <map>

namespace hauberk {
namespace {

/// What a limit depends on, apart from how it is found.
std::string scene_text(const Experiment& e)
{
  std::string text = fmt::format("{:.17g}\n", e.solver.clearance);
  for (const char* key : {"elements", "cell", "load_case"}) text += write_json(e.resolved.at(key)) + "\n";
  return text;
}

/// An exact value belongs to one limit; with several it would not say to which.
void check_exact(const StabilityFamily& family, std::size_t member, const Experiment& e,
                 Diagnostics& diagnostics)
{
  const std::size_t limits = profile_tasks(e).size();
  if (!family.exact[member] || limits == 1) return;
  diagnostics.problems.add(
      {"/stability/families", 0,
       fmt::format("family '{}', member '{}': an exact value needs one direction and sense, found {} limits",
                   family.name, family.labels[member], limits)});
}

}  // namespace

std::vector<StabilityItem> load_stability(const ExperimentStability& stability, const PluginLookup& lookup,
                                          Diagnostics& diagnostics)
{
  std::vector<StabilityItem> items;
  std::map<std::string, std::size_t> scenes;
  for (std::size_t f = 0; f < stability.families.size(); ++f) {
    const StabilityFamily& family = stability.families[f];
    for (std::size_t k = 0; k < family.members.size(); ++k) {
      for (std::size_t m = 0; m < stability.methods.size(); ++m) {
        StabilityItem item{f, k, m, read_stability_member(stability, f, k, m, lookup, diagnostics), 0};
        const std::optional<Experiment>& e = item.reading.experiment;
        const std::string scene = e ? scene_text(*e) : fmt::format("refused {} {} {}", f, k, m);
        item.scene = scenes.emplace(scene, scenes.size()).first->second;
        if (e && m == 0) check_exact(family, k, *e, diagnostics);
        items.push_back(std::move(item));
      }
    }
  }
  return items;
}

}  // namespace hauberk
