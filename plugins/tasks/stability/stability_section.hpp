#pragma once
/// The section `stability` of an experiment.

#include <hauberk/experiment/task_format.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// A way of solving: what it sets, usually below /solver.
struct StabilityMethod {
  std::string name;
  std::vector<Assignment> set;
};

/// Variants of one scene, from easy to hard.
struct StabilityFamily {
  std::string name, why;
  std::vector<std::string> labels;               ///< of the members
  std::vector<std::vector<Assignment>> members;  ///< what makes each of them out of the base scene
  std::vector<std::optional<double>> exact;      ///< of the members; null: not known
  bool solvable = true;                          ///< there is a locked state to find
};

/// The section `stability`.
struct ExperimentStability : TaskSection {
  double tolerance = 0.0;  ///< of 1 + value
  std::vector<StabilityMethod> methods;
  std::vector<StabilityFamily> families;
  VariantBase base;
};

/// One member of a family, by one method.
VariantReading read_stability_member(const ExperimentStability& stability, std::size_t family,
                                     std::size_t member, std::size_t method, const PluginLookup& lookup,
                                     Diagnostics& diagnostics);

/// Its fields.
Field stability_field();

/// Reads it.
std::shared_ptr<const TaskSection> read_stability(Node& section, SectionContext& context);

}  // namespace hauberk
