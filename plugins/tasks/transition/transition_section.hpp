#pragma once
/// The section `transition` of an experiment.

#include <hauberk/experiment/task_format.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// A rigid motion of one element, linear in time: a rotation about a line and then a translation, from rest.
struct TransitionPathInput {
  std::string name;
  Vec3 axis = Vec3::Zero();     ///< unit; zero: no rotation
  Vec3 through = Vec3::Zero();  ///< a point of the line, file units
  double degrees_from = 0.0, degrees_to = 0.0;
  Vec3 shift_from = Vec3::Zero(), shift_to = Vec3::Zero();  ///< file units
  int steps = 200;
};

/// The section `transition`. Lengths in file units.
struct ExperimentTransition : TaskSection {
  int fixed = 0, moving = 1;  ///< placed elements
  double activation_distance = 0.0, range = 0.0;
  std::vector<std::string> contacts;  ///< "nearest", "published", "arc", "auto"
  std::vector<TransitionPathInput> paths;
};

/// Its fields.
Field transition_field();

/// Reads it; fills in the range.
std::shared_ptr<const TaskSection> read_transition(Node& section, SectionContext& context);

}  // namespace hauberk
