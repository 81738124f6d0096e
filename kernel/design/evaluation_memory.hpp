#pragma once
/// Evaluations of a design that were made before, so that a search that was interrupted can be repeated at
/// once up to where it was.

#include "design/design_point.hpp"

namespace hauberk {

/// Evaluations in the order in which they were made. A search is deterministic, so when it is repeated it
/// asks for the same designs in the same order; what is remembered need not be computed, and the repeated
/// search is the former one, bit for bit, whatever the optimizer. Only limits are remembered: rest states and
/// safe steps are cheap, and are computed again.
///
/// Used by one thread. What cannot be recalled is computed and recorded.
class EvaluationMemory {
 public:
  virtual ~EvaluationMemory() = default;

  /// If the next remembered evaluation is of exactly p.x: enters what it found into `p`, all but warm starts,
  /// and into `evaluations` what it cost, and returns true. Otherwise nothing more is remembered.
  virtual bool recall(DesignPoint& p, long& evaluations) = 0;
  /// Remembers an evaluation that was just made, also one that failed. This and record_states follow what was
  /// recalled: what was not recalled is no longer remembered.
  virtual void record(const DesignPoint& p, long evaluations) = 0;

  /// Warm starts of p.x, recalled before, if that is what comes next: they are remembered where a design is
  /// accepted, as they are large and no other design needs them. False: not remembered.
  virtual bool recall_states(DesignPoint& p) = 0;
  /// Remembers the warm starts of p.x, which is accepted.
  virtual void record_states(const DesignPoint& p) = 0;
};

}  // namespace hauberk
