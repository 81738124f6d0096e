#pragma once
/// From a state to the locked state that a load drives it to: stages of falling activation distance.

#include "equilibrium/newton.hpp"
#include "model/held_model.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace hauberk {

/// How contact is treated along the stages.
enum class ContactChoice {
  automatic,  ///< arc while contacts may merge and split, nearest to finish (see planned_stages); arc again
              ///< where nearest stalls
  nearest,
  arc,
  published,   ///< the paper's, in every stage
  mesh,        ///< of triangle meshes, in every stage; the model must have facets
  constrained  ///< no energy: gaps are constraints of an optimisation, the schedule's last distance sets its
               ///< margin
};

/// All choices by their names in experiments.
inline constexpr std::array<std::pair<const char*, ContactChoice>, 6> contact_choices{{
    {"auto", ContactChoice::automatic},
    {"nearest", ContactChoice::nearest},
    {"arc", ContactChoice::arc},
    {"published", ContactChoice::published},
    {"mesh", ContactChoice::mesh},
    {"constrained", ContactChoice::constrained},
}};

/// The choice of that name. Throws InputError for any other, with those that there are.
ContactChoice contact_named(std::string_view name);

/// Stages of activation distances from `first` to `last` (L), falling by equal factors that are not smaller
/// than `ratio`; mu = stiffness * g_hat * |load|.
struct Schedule {
  double first = 0.03;
  double ratio = 0.1;
  double last = 2e-9;
  double change = 3e-4;     ///< `automatic` changes from arc to nearest here, see planned_stages
  double stiffness = 0.03;  ///< sets gaps at equilibrium to about a tenth of g_hat
  double tolerance = 1e-3;  ///< of a stage, relative to its mu
  double last_tolerance = 1e-8;
  /// A last stage of rough quadrature ends where a whole step that promises less than `tolerance` gains
  /// nothing. Its forces may miss the load by some per cent: enough for a design that is still to change.
  bool ends_at_noise = false;
  /// Of the last stage, if it is not wider than `change`; stages that are are rough.
  Quadrature last_quadrature = Quadrature::fine;
  int most_iterations = 300;  ///< of a stage without noticeable decrease
  CollisionCheck ccd = CollisionCheck::certified;
  MinimaSearch search = MinimaSearch::certified;  ///< of contact `published`
  /// Finite target of the published objective, see Stage; infinite: the load alone.
  double target = std::numeric_limits<double>::infinity();
  bool keep_path = false;  ///< Locked::path is wanted
  unsigned threads = 1;    ///< for the pairs of one large scene; never changes a result
  /// Of closest points (Locked::evaluations): with more of them a path of barriers is `stalled`. Counted, so
  /// that it ends at the same state on every machine. What balances the forces of a last stage that has ended
  /// may be more.
  long most_evaluations = std::numeric_limits<long>::max();
};

/// Activation distances of a schedule's stages, falling.
std::vector<double> activation_distances(const Schedule& schedule);

/// Whether an activation distance is above schedule.change.
bool is_wide(double g_hat, const Schedule& schedule);

/// The formulation that a choice means at an activation distance, whatever the scene: `automatic` is arc
/// above schedule.change, else nearest.
Formulation formulation_at(ContactChoice choice, double g_hat, const Schedule& schedule);

/// A stage as it is decided before anything is solved.
struct PlannedStage {
  double g_hat = 0.0;  ///< activation distance, L
  Formulation formulation = Formulation::arc;
  Quadrature quadrature = Quadrature::fine;  ///< of arc
  Sides sides = Sides::both;                 ///< of arc
  bool last = false;
};

/// The stages that a limit runs, in this order. `automatic` takes arc for one of them again where contacts
/// merge, and for all that follow from where nearest stalls. In scenes of nothing but solids that are probed
/// over their surface it begins with nearest: an integral over two of these costs ten times as many distances
/// as their minima.
std::vector<PlannedStage> planned_stages(const Model& m, ContactChoice choice, const Schedule& schedule);
/// The same for one activation distance.
PlannedStage planned_stage(const Model& m, ContactChoice choice, const Schedule& schedule, double g_hat,
                           bool last);

/// Gap (L) that `constrained` leaves: a tenth of the last activation distance, as barriers do.
double constrained_margin(const Schedule& schedule);

/// Relative curvature (1/L) below which a contact is not regular at the activation distance g_hat (L). Near a
/// merge the gap along the surface is g0 - a t^2/2 + b t^4/24; its two minima have the curvature 2 a, and the
/// hump between them is higher than g_hat only where 2 a > sqrt(8 b g_hat / 3). Taken with b = 1.5 / L^3.
double least_regular_curvature(double g_hat);

/// The schedule without its widest stage, if it has more than one: for states that come from elsewhere, which
/// the widest stage would let go back to where they came from.
Schedule without_widest(const Schedule& schedule);

/// One finished stage.
struct StageRecord {
  double g_hat = 0.0, value = 0.0;
  Formulation formulation = Formulation::arc;
  int iterations = 0;
  double residual = 0.0;
  int escapes = 0;
};

enum class LockStatus { locked, stalled, unbounded, not_a_sheet, interrupted };

/// A locked state and how it was reached.
struct Locked {
  LockStatus status = LockStatus::stalled;
  std::string message;
  State state;
  Stage stage;  ///< the last one finished
  std::vector<StageRecord> stages;
  int iterations = 0;
  long evaluations = 0;
  std::vector<State> trail;  ///< states at the ends of `stages`, for warm starts
  /// Where kept, and where the strain left every bound: states from the start to there, between which
  /// `advanced` along their `difference` is free of intersection.
  std::vector<State> path;
  std::optional<double> error_estimate;
  /// Of `constrained`: contacts with the multipliers of the problem as forces (stage.mu is 1).
  std::optional<ContactEnergy> pressed;
};

/// The load on the macroscopic unknowns for a direction and sense.
Vector load_vector(const Model& model, const Direction& direction, Sense sense);

/// Runs all stages from `start`, or solves the constrained problem. Later stages start from the extrapolation
/// of the last two, along which positions are linear in g_hat. What the load holds is kept from the first
/// stage on; a start that breaks it (another direction's state) is brought there first, on a certified path;
/// where contact keeps it from there the result is `stalled` and has no stages. Derivatives in `pressed` are
/// those of the macroscopic unknowns that conditions leave. Thread safe; deterministic.
Locked lock(const Model& model, const State& start, const MacroLoad& load, ContactChoice choice,
            const Schedule& schedule, const KeepGoing& keep_going);

}  // namespace hauberk
