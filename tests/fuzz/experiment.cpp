/// Experiment files: any bytes are either an experiment or refused with the project's own errors, in words.

#include "document/json_writer.hpp"
#include "harness.hpp"
#include "tasks/chart/chart_section.hpp"
#include "tasks/job.hpp"
#include "tasks/stability/stability_section.hpp"
#include "tasks/sweep/sweep_section.hpp"
#include "tasks/table.hpp"

#include <hauberk/error.hpp>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace hauberk {
namespace {

/// Scenes are only prepared up to these sizes: the time for larger ones is theirs, not a mistake.
constexpr std::size_t most_elements = 48, most_cases = 24, most_bodies = 96;

[[noreturn]] void violated(const char* property, const std::string& text)
{
  std::fprintf(stderr, "experiment: %s\n%s\n", property, text.c_str());
  std::abort();
}

const std::shared_ptr<const Registry>& registry()
{
  static const auto shared = std::make_shared<const Registry>(
      std::vector<std::filesystem::path>{std::filesystem::path(HAUBERK_PLUGIN_FOLDER)});
  return shared;
}

PluginLookup lookup() { return lookup_in(*registry()); }

/// A message that says something, and of a problem where it is.
void check_message(const std::string& text, const char* what)
{
  if (text.find_first_not_of(" \n") == std::string::npos) violated("an error without a message", what);
}

/// What is written into results must be an experiment again, and the same one: --resume compares them.
void check_round_trip(const Experiment& experiment)
{
  const std::string resolved = write_json(experiment.resolved);
  Diagnostics diagnostics;
  const std::optional<Experiment> again =
      read_experiment({"y.json", resolved, {}, {}, {}, task_formats()}, lookup(), diagnostics);
  if (!again) violated("the resolved experiment is refused", diagnostics.text() + "\n" + resolved);
  if (write_json(again->resolved) != resolved)
    violated("the resolved experiment is resolved further", resolved);
}

bool is_small(const Experiment& e)
{
  std::size_t bodies = 0, cases = 0;
  for (const PlacedElement& placed : e.scene.elements) {
    const ElementType& type = e.scene.types[placed.type];
    bodies += type.shape->primitives(placed.parameters).size();
  }
  if (e.section<ExperimentStability>()) {
    for (const StabilityFamily& family : e.section<ExperimentStability>()->families)
      cases += family.members.size() * e.section<ExperimentStability>()->methods.size();
  }
  if (e.section<ExperimentChart>()) {
    for (const ChartMethod& method : e.section<ExperimentChart>()->methods)
      cases += method.scenes.size() * method.settings.size();
  }
  if (e.section<ExperimentSweep>()) cases += e.section<ExperimentSweep>()->row_count();
  return e.scene.elements.size() <= most_elements && bodies <= most_bodies && cases <= most_cases;
}

}  // namespace
}  // namespace hauberk

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace hauberk;
  const ExperimentSource source{
      "x.json", std::string(reinterpret_cast<const char*>(data), size), {}, {}, {}, task_formats()};
  Diagnostics diagnostics;
  std::optional<Experiment> experiment = read_experiment(source, lookup(), diagnostics);
  if (experiment.has_value() != diagnostics.empty())
    violated("an experiment must be read exactly where there is no problem", diagnostics.text());
  if (!experiment) {
    for (const Problem& problem : diagnostics.problems.list()) check_message(problem.message, "problem");
    check_message(diagnostics.text(), "list of problems");
    return 0;
  }
  check_round_trip(*experiment);
  if (!is_small(*experiment)) return 0;
  // All that `hauberk check` does. Anything else that is thrown ends the program.
  try {
    prepare_job(registry(), source);
  } catch (const ReportedProblems& error) {
    check_message(error.what(), "ReportedProblems");
  } catch (const InputError& error) {
    check_message(error.what(), "InputError");
  } catch (const ComputationError& error) {
    check_message(error.what(), "ComputationError");
  } catch (const PluginError& error) {
    check_message(error.what(), "PluginError");
  }
  return 0;
}
