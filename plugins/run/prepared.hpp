#pragma once
/// From a file to a scene that can be solved: what every task begins from.

#include "document/diagnostics.hpp"
#include "limits/limits.hpp"
#include "results/document.hpp"
#include "run/scene_at_rest.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/experiment.hpp>
#include <hauberk/host/registry.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// Problems of a file; as text a line each that already starts with the place, printed as it is.
class ReportedProblems : public InputError {
 public:
  explicit ReportedProblems(const Diagnostics& diagnostics)
      : InputError(diagnostics.text()), problems_(diagnostics.of_file())
  {
  }
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// An experiment whose scene passed every check, at a rest state with room. It is made once and outlives
/// whatever computes it.
struct Prepared : SceneAtRest {
  std::shared_ptr<const Registry> registry;
  /// Finds plugins and notes them in `plugins`.
  PluginLookup lookup;
  std::vector<Provenance::Plugin> plugins;  ///< used, in the order of first use
  /// Name and text, by name, of the weaves that variants are made of; empty where the experiment holds what
  /// the weave stands for.
  std::vector<std::pair<std::string, std::string>> weaves;
  /// Path as written and fingerprint of files that plugins have read.
  std::vector<std::pair<std::string, std::string>> files;
  Experiment experiment;
};

/// Finds plugins of a registry, which outlives it.
PluginLookup lookup_in(const Registry& registry);

/// Reads and checks an experiment up to its rest state, and lets `then` add what the task needs (which may
/// read variants, with further plugins and files). `then` puts problems into the diagnostics. Throws
/// ReportedProblems with a line per problem.
std::unique_ptr<const Prepared> prepare_experiment(
    std::shared_ptr<const Registry> registry, const ExperimentSource& source,
    const std::function<void(const Prepared&, Diagnostics&)>& then);

/// Names of the macroscopic unknowns of a load case.
std::vector<std::string> macro_names(const LoadCase& load_case);

}  // namespace hauberk
