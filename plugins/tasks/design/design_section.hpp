#pragma once
/// The section `design` of an experiment.

#include <hauberk/experiment/task_format.hpp>

#include "design/target.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// One parameter of one placed element.
struct ParameterRef {
  int element = 0;
  int parameter = 0;  ///< in the order of the element's shape
};

/// One design variable; all its parameters have the same value.
struct ExperimentVariable {
  std::string name;  ///< "3/ring.R" (element 3; of a patch: place 3 of every tile), "link/ring.R" (type),
                     ///< "*/ring.R" (all)
  double initial = 0.0, lower = 0.0, upper = 0.0;
  std::vector<ParameterRef> parameters;
};

struct ExperimentTarget {
  double direction_deg = 0.0, value = 0.0, weight = 1.0;
  Aim aim = Aim::reach;
};

/// The section `design`.
struct ExperimentDesign : TaskSection {
  std::string optimizer_plugin;
  std::shared_ptr<const Optimizer> optimizer;
  std::string quantity;  ///< "eta", "stretch", "compress", "curvature"
  std::vector<ExperimentVariable> variables;
  std::vector<ExperimentTarget> targets;
  bool plain_value = false;                           ///< design.value is "plain"
  double hole_clearance = 0.0, rest_clearance = 0.0;  ///< file units
  int starts = 1;
  double perturbation = 0.0;  ///< fraction of upper - lower
  std::optional<int> max_iterations;
  std::optional<double> tolerance;  ///< relative deviation at which a target counts as reached

  std::vector<double> own_directions() const override;
};

/// design.variables.
std::vector<ExperimentVariable> read_variables(const Node& list, const SectionContext& context);

/// Its fields.
Field design_field();

/// Reads it; needs scene, load case and solver.
std::shared_ptr<const TaskSection> read_design(Node& section, SectionContext& context);

}  // namespace hauberk
