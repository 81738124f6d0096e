#pragma once
/// States that limits learn from: those of every task, and what the scene's symmetries make of them.

#include "limits/lessons.hpp"
#include "limits/symmetry.hpp"

namespace hauberk {

/// True for a limit that has room to be short of the furthest state: that of a cell which repeats under a
/// load that pushes it together along some line, as compressions do and, along components that links bound,
/// shears, or bends it, where elements may gather along what repeats. Fabrics that are stretched alone are
/// taut.
bool may_fold(const Model& model, const LimitTask& task);

/// True for a stretch of a periodic cell, at an angle, which links hold together along it and across: a sheet
/// that is pulled until nothing gives, as a rule at once to where it locks for good, though not always.
bool is_taut(const Model& model, const LimitTask& task);

/// Whether a limit begins again from states of others that are not further than its own: compressions that
/// may fold, and stretches of taut sheets, but for gaps as constraints (ContactChoice::constrained),
/// which touch at such a state and take thousands of steps from there.
bool begins_again(const Model& model, const LimitTask& task, ContactChoice contact);

/// Whether limits of its sense beside it are among these others: not for large cells that are taut and hold a
/// strain, which states of other directions break.
bool learns_beside(const Model& model, const LimitTask& task);

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

  /// Pairs of learners, those of the first `learners` tasks that begin again, and donors whose states are
  /// starting points for them: beside, the donors whose loads are the next two to either side of the
  /// learner's, among loads of its sense within 30 degrees (a longer stride at times leaves a fold that a
  /// short one keeps), those that are no learners counted as one; across, for one that is taut, that of the
  /// other sense at right angles.
  std::vector<Lesson> starting_points(std::size_t learners, ContactChoice contact) const;

 private:
  void add_beside(std::size_t task, std::size_t learners, std::vector<Lesson>& out) const;
  void add_across(std::size_t task, std::vector<Lesson>& out) const;

  const Model& model_;
  const std::vector<LimitTask>& tasks_;
  std::vector<SceneSymmetry> symmetries_;
  std::vector<std::optional<LimitTask>> images_;  ///< per donor: its task, carried over
};

}  // namespace hauberk
