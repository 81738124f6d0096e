#pragma once
/// One design: parameters, relaxed rest state, and the limits that its targets need with their gradients.

#include "design/design.hpp"
#include "equilibrium/gaps.hpp"
#include "equilibrium/newton.hpp"
#include "model/held_model.hpp"

namespace hauberk {

/// End of one stage on the way to a locked state.
struct WarmStart {
  double g_hat = 0.0;
  State state;
};

/// A design whose rest state is relaxed; the reference positions of the model stay those of the scene, so
/// states of different designs can be exchanged.
struct DesignPoint {
  std::vector<double> x;
  SceneSpec spec;  ///< with the parameters of x; rest poses as in the scene
  Model model;
  State rest;                                ///< relaxed
  std::vector<Gap> rest_gaps;                ///< close pairs at rest, with derivatives
  std::vector<std::vector<WarmStart>> warm;  ///< per task, loosest first
  std::vector<int> changed;                  ///< tasks whose state is not the continuation of the iterate's
  std::vector<double> values;                ///< per target
  Matrix value_gradients;                    ///< row per target, column per variable
  double objective = 0.0;
  Vector gradient;
  bool evaluated = false;
  bool states_missing = false;  ///< values are recalled from a former run, `warm` is not
  bool states_kept = false;     ///< the memory has `warm`
  bool continued = false;       ///< some state of it continues one of the iterate before
  int unchecked = 0;            ///< steps since all states were looked for from rest
  bool checked = false;         ///< they were, after this one was accepted
  Look look = Look::usual;      ///< how thoroughly
  bool looked_in_part = false;  ///< the last look ended at a target that was exceeded
  bool keeps_further = false;   ///< a check keeps followed states that are further than where rest led
  std::string why;              ///< why it could not be evaluated
};

/// The design as a scene, its relaxed rest included.
SceneSpec with_relaxed_rest(const DesignPoint& point);

/// Its states in the unknowns of a design whose limits were reported, in their order; none where no straight
/// certified motion leads from the design's relaxed rest to the rest of the report.
std::vector<std::optional<State>> carried_to(const DesignPoint& point, const ReportedStates& reported);

/// Turns variables into element parameters.
SceneSpec with_variables(const SceneSpec& scene, const std::vector<DesignVariable>& variables,
                         std::span<const double> x);

/// Response of the rest poses to the variables: least-squares motion that keeps all close gaps; columns are
/// variables, rows unknowns.
Matrix rest_response(const DesignPoint& point, const std::vector<DesignVariable>& variables);

/// Model of the design at a share of the way between two; null where its sizes are not admissible.
std::optional<Model> intermediate(const DesignPoint& from, const DesignPoint& to,
                                  const std::vector<DesignVariable>& variables, double share);

/// Bound of how far a surface moves in its element's frame between two designs, L.
double largest_change_of_shape(const Model& a, const Model& b);

/// to.x - from.x.
Vector change_of_variables(const DesignPoint& from, const DesignPoint& to);

/// What a warm start is a minimum of.
struct MinimumOf {
  Stage stage;
  MacroLoad load;
};

/// Warm start of design `to` from a stage of design `from`: the state moved as its minimum moves, to first
/// order (response_of_minimum), as far as that leads to a state of the same fabric; from there on, or without
/// `minimum`, by the least-squares response of all unknowns, strain included, that keeps the gaps in contact.
/// Null where that is not a state of the same fabric: some gap is closed, a link is lost, or the change is so
/// large that cores could have crossed unseen (a tube's radius). Large changes are followed in parts. What is
/// between is not a motion of either design, so it need not be free of overlaps. Conditions on the strain
/// that `held` has are kept. Counts closest points of `minimum` in `evaluations`.
std::optional<State> followed(const DesignPoint& from, const WarmStart& warm, const DesignPoint& to,
                              const std::vector<DesignVariable>& variables, const Matrix& held = {},
                              const MinimumOf* minimum = nullptr, long* evaluations = nullptr);

/// d gap / d variables at fixed poses.
Vector gap_parameter_gradient(const Gap& gap, const DesignPoint& point,
                              const std::vector<DesignVariable>& variables);

/// Largest t in [0, 1] such that nothing collides while parameters go from `a` to `b` (same topology) and the
/// state moves along dy, which must not change the strain: conservative advancement of every pair of bodies,
/// with the speeds of both shapes (shape_speed) added to that of their motion.
/// Throws Interrupted where `keep_going` says no.
double safe_parameter_step(
    const Model& a, const Model& b, const State& from, const Vector& dy,
    const KeepGoing& keep_going = [] { return true; });

}  // namespace hauberk
