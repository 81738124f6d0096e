#pragma once
/// The scenes that a stability map solves.

#include "run/prepared.hpp"
#include "tasks/stability/stability_section.hpp"

namespace hauberk {

/// One member of a family by one method.
struct StabilityItem {
  std::size_t family = 0, member = 0, method = 0;
  VariantReading reading;
  std::size_t scene = 0;  ///< equal numbers: the same scene and load, whatever the solver's settings
};

/// Every member of every family by every method. What is wrong with the form of a member is reported in
/// `diagnostics`; members that are refused as input are items without an experiment.
std::vector<StabilityItem> load_stability(const ExperimentStability& stability, const PluginLookup& lookup,
                                          Diagnostics& diagnostics);

}  // namespace hauberk
