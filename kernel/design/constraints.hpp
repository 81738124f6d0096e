#pragma once
/// Constraints of a design: room in the holes of linked rings, and clearance of close pairs at rest.

#include "design/design_point.hpp"
#include "design/design_scene.hpp"

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// Violation of a constraint (L) that counts as none.
inline constexpr double negligible_violation = 1e-6;
/// Pairs up to this far apart at the first rest state (L) have a constraint of their own; all others are held
/// apart by the collision check alone.
inline constexpr double constrained_range = 0.3;

/// c(x) >= 0 in scaled lengths: paper's C_ij > eps_c for both sides of every link of two primitives, then the
/// rest distance of close pairs. Which they are is decided at the start. Immutable; thread safe.
class DesignConstraints {
 public:
  DesignConstraints(std::shared_ptr<const DesignScene> scene, const DesignPoint& start);

  int count() const { return static_cast<int>(holes_.size() + pairs_.size()); }
  /// Values at a design and their Jacobian, row-major count x variables (empty: not wanted). Of a design
  /// without a model holes are those of `otherwise`.
  void evaluate(const DesignPoint& point, const Model& otherwise, std::span<double> c,
                std::span<double> jacobian) const;
  /// Whether no constraint is violated by more than a negligible bit.
  bool satisfied(const DesignPoint& point, const Model& otherwise) const;
  /// The hole that misses the hole clearance most in every design within the bounds, a sentence; empty when
  /// none does. Each hole is measured at the bounds that the derivatives at `point` point to (exact for sizes
  /// that are monotone in the variables). Throws InputError when that design is inadmissible.
  std::string impossible_hole(const DesignPoint& point) const;

 private:
  /// One side of a hole constraint: hole of body `ring` against half-width `size_index` of body `thread`.
  struct Hole {
    int ring, thread, size_index;
  };
  /// A pair of bodies whose rest clearance is a constraint.
  struct Pair {
    int a, b;
    Image image;
  };

  void add_hole(const Model& model, int ring, int thread);
  /// Room of a hole around its thread beyond the hole clearance, scaled.
  double hole_room(const Model& model, const Hole& hole) const;
  void add_hole_derivatives(const Model& model, const Hole& hole, std::span<double> row) const;

  std::shared_ptr<const DesignScene> scene_;
  std::vector<Hole> holes_;
  std::vector<Pair> pairs_;
};

/// The point nearest to `goal` within bounds where constraints that are `c` at `from`, linearised there,
/// hold: by cyclic projections.
std::vector<double> project(std::span<const double> c, std::span<const double> jacobian,
                            std::span<const double> from, const std::vector<double>& goal,
                            const std::vector<DesignVariable>& bounds);

}  // namespace hauberk
