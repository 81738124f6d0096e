#pragma once
/// Scenes with less freedom than another one: whatever state they lock in is a state of that one, too.

#include "model/model.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// A scene under a load case that another one contains.
struct Relative {
  std::string name;  ///< what it holds more ("z fixed"), or of which cells it is ("2 x 1 cells")
  SceneSpec scene;
  std::shared_ptr<const LoadCase> load;  ///< null: the same
};

/// Those of a scene as it is simulated: the same elements under each stricter load case
/// (LoadCase::stricter), and, where the cell is one repeated and all its copies are alike, the cells that
/// this one repeats a prime number of times along one axis.
std::vector<Relative> relatives(const Model& model, const SceneSpec& spec);

/// Whether every state of a scene is one of another one, up to where its rest is: the same elements at the
/// same places of one cell repeated at least as often, a multiple each way, in a load case that contains the
/// other's, with no more clearance. Lengths are compared to rounding.
bool contains(const Model& outer, const SceneSpec& outer_spec, const Model& inner,
              const SceneSpec& inner_spec);

/// Carries states of a scene over to one that contains it: elements of every copy of its cell have the poses
/// of their images. Their scaled lengths may differ (Model::length). Models and specifications must outlive
/// it. Immutable, thread safe.
class Carrier {
 public:
  Carrier(const Model& from, const SceneSpec& from_spec, const Model& to, const SceneSpec& to_spec);

  /// Whether a straight certified motion joins the rest of the one to that of the other, so that what is
  /// reached from the one is reached from the other.
  bool joined() const { return joined_; }
  /// The state with these poses; null where the other scene's unknowns have none.
  std::optional<State> state(const State& from) const;

 private:
  const Model &from_, &to_;
  std::array<int, 3> from_repeat_, to_repeat_;
  bool joined_ = false;
};

}  // namespace hauberk
