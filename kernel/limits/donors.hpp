#pragma once
/// States that limits learn from: those of every task, and what the scene's symmetries make of them.

#include "limits/lessons.hpp"
#include "limits/symmetry.hpp"

namespace hauberk {

/// True for a limit that has room to be short of the furthest state: that of a cell which repeats under a
/// load that pushes it together along some line, as compressions do and, along components that links bound,
/// shears. Fabrics that are stretched alone are taut.
bool may_fold(const Model& model, const LimitTask& task);

/// Donors are numbered task by task; each has one donor for every symmetry of the scene, the identity first.
/// Immutable, thread safe.
class Donors {
 public:
  Donors(const Model& model, const std::vector<LimitTask>& tasks);

  std::size_t count() const { return images_.size(); }
  std::size_t task(std::size_t donor) const { return donor / symmetries_.size(); }
  /// The donor that is a task's own state.
  std::size_t own(std::size_t task) const { return task * symmetries_.size(); }
  bool is_own(std::size_t donor) const { return donor % symmetries_.size() == 0; }

  /// A locked state of the donor's task as the donor has it; null where the symmetry makes none of it. A
  /// scene is symmetric up to the digits that it is written with, and a locked state has no room for those:
  /// an image is that of the last stage that has.
  std::optional<State> state(std::size_t donor, const Locked& own) const;

  /// Whether the donor's load, carried over, is that of a task: their limits are equal then.
  bool same_load(std::size_t donor, const LimitTask& task) const;

  /// How far a macroscopic state of the donor's task is along another task, once carried over; null where it
  /// does not keep what that task holds.
  std::optional<double> reached(std::size_t donor, const Vector& macro, const LimitTask& along) const;

  /// Each task that may fold with the donors whose loads are the next two to either side of its own, among
  /// loads of its sense within 30 degrees: a longer stride at times leaves a fold that a short one keeps.
  std::vector<Lesson> beside() const;

 private:
  const Model& model_;
  const std::vector<LimitTask>& tasks_;
  std::vector<SceneSymmetry> symmetries_;
  std::vector<std::optional<LimitTask>> images_;  ///< per donor: its task, carried over
};

}  // namespace hauberk
