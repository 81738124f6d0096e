#pragma once
/// Deformation limits: locked states from rest, for directions and senses, with several starts.

#include "equilibrium/locking.hpp"
#include "limits/limit_result.hpp"
#include "limits/search_memory.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace hauberk {

/// A locked state of a scene that this one contains (relatives.hpp), carried over, with the unknowns of this
/// one.
struct GivenState {
  Direction direction;
  Sense sense = Sense::positive;
  State state;
  std::string origin;  ///< for people: "one cell"
};

/// How limits are computed.
struct LimitSettings {
  ContactChoice contact = ContactChoice::automatic;
  Schedule schedule;
  int starts = 1;
  double perturbation = 0.01;         ///< of small perturbations, L: break symmetries without leaving rest
  double further_perturbation = 0.1;  ///< of large ones, L, as far as nothing collides
  /// Degrees: how far from a lone limit others are solved of which it learns; 0: none are
  /// (rest_searches.hpp).
  double neighbours = 0.0;
  /// Whether limits learn from each other, from symmetric images, from loads beside their own and from scenes
  /// that this one contains; otherwise each stands alone, and what contradicts it is told.
  bool lessons = true;
  /// Whether they learn from scenes that this one contains, beside what is `given`.
  bool inherit = true;
  /// Starts of compressions of periodic cells, at least, where limits learn, and, if that is more than one,
  /// as many more under random loads; in cells of eight elements and more divided by how often four goes into
  /// their number.
  int fold_starts = 12;
  /// Starts of any limit, at most, of which then none goes on from locked states; 0: no such bound.
  int most_starts = 0;
  int tilts = 0;       ///< random loads beside the task's own, from whose states it learns
  double tilt = 20.0;  ///< degrees: by how much they differ from it
  std::uint64_t seed = 1;
  std::optional<State> start;     ///< where starts begin; null: at rest
  std::vector<GivenState> given;  ///< with which limits of their direction and sense begin once more
};

/// One limit to be found.
struct LimitTask {
  Direction direction;
  Sense sense = Sense::positive;
};

/// Whether two angles are one direction: directions and their opposites are (degrees, to 1e-9, far below what
/// changes a limit visibly).
bool on_one_line(double degrees, double other);
/// The same of directions that are angles; false of others.
bool on_one_line(const Direction& a, const Direction& b);

/// How elements that are copies of each other (PlacedElement::copy_of) are perturbed.
enum class Copies {
  alike,  ///< all in the same way: the repeated cell behaves like the one that it repeats
  apart   ///< each in its own way
};

/// A state moved at random: for every element a displacement and a turn, normally distributed with
/// standard deviation `size` (L, and radians), drawn in the element's own frame so that turning the scene
/// turns the perturbation; shortened until nothing collides. Deterministic in `seed`.
State perturbed(const Model& model, const State& from, double size, std::uint64_t seed, Copies copies);

/// Where starts begin.
State start_state(const Model& model, const LimitSettings& settings);

/// A load turned by `settings.tilt` towards a random direction of the macroscopic unknowns, in the norm of
/// loads (the dual of that of steps). Deterministic in `seed`.
Vector tilted(const Model& model, const Vector& load, const LimitSettings& settings, std::uint64_t seed);

/// Where the task's load, tilted by `settings.tilt`, leads from a small perturbation of the start.
/// Deterministic in `seed`.
Locked locked_under_tilted_load(const Model& model, const LimitTask& task, const LimitSettings& settings,
                                std::uint64_t seed, const KeepGoing& keep_going = {});

/// Locks a task from where the load that is tilted by `settings.tilt` locks; what that is where it does not.
Locked limit_from_tilted_load(const Model& model, const LimitTask& task, const LimitSettings& settings,
                              std::uint64_t seed, const KeepGoing& keep_going = {});

/// Locked state of one task from a state that another search has found, free of collisions. Stages begin
/// with the second: the first would let the state go back to where it came from.
/// Where they end less far than the state is, and it keeps what the task holds, narrower stages begin once
/// more.
Locked limit_from_state(const Model& model, const LimitTask& task, const LimitSettings& settings,
                        const State& from, const KeepGoing& keep_going);

/// Locked state of one task from one start. Start 0 is a small perturbation that moves copies alike, so that
/// a repeated cell finds at least what the cell finds; where there are copies, start 1 is a small one that
/// moves them apart, so that the repeated cell can fold; all others are large and move everything apart.
Locked limit_from_start(const Model& model, const LimitTask& task, const LimitSettings& settings, int start,
                        const KeepGoing& keep_going);

/// Locked state of one task from where the widest stage of a random load leads, any load of the macroscopic
/// unknowns being as likely (in the norm of loads): a fabric that was folded another way comes to folds that
/// few starts from rest come to. Where contact does not stop the random load, an ordinary start of that
/// number. Deterministic in `settings.seed` and `number`.
Locked limit_from_random_load(const Model& model, const LimitTask& task, const LimitSettings& settings,
                              int number, const KeepGoing& keep_going);

/// The same from a locked state, mostly the furthest that is known, with a random load of that seed: a
/// search that begins there comes to folds that none from rest comes to (monotonic basin hopping, R. H.
/// Leary, Global optimization on funneling landscapes, J. Global Optimization 18, 2000). Not locked where
/// contact does not stop the random load.
Locked limit_refolded(const Model& model, const LimitTask& task, const LimitSettings& settings,
                      const State& from, std::uint64_t seed, const KeepGoing& keep_going);

/// Beginning of the origin of states that began from another limit's.
inline constexpr const char* learnt_origin = "from ";

/// A locked state and where it came from.
struct FoundState {
  Locked locked;
  /// "start", "random load", "start, narrow" (without the widest stage), "tilt", or learnt_origin and the
  /// limit whose state it began with
  std::string origin;
  std::uint64_t seed = 0;  ///< of the start, random load or tilt
};

/// Result of one task out of what was found (in a fixed order, the first start first). Forces, balance,
/// sensitivities and the smallest gap are evaluated at the best state; where `keep_going` says no meanwhile
/// the result is `interrupted` and has nothing of it.
LimitResult summarize(const Model& model, const SceneSpec& spec, const LimitTask& task,
                      const LimitSettings& settings, const std::vector<FoundState>& found,
                      const KeepGoing& keep_going);

/// What links say of a task. `attained` is proved by them; the others mean that links do not stop the load:
/// something else may (elements can be entangled without a link), so the load is tried.
Boundedness bounded_by_links(const Model& model, const LimitTask& task);

/// Who follows a computation of limits. Empty functions are not called.
struct LimitsObserver {
  /// After each start of each task, one call at a time.
  std::function<void(std::size_t done, std::size_t total)> on_start;
  /// Before the first and after each lesson of a round (limits learn from each other), one call at a time.
  /// How many rounds there will be is not known.
  std::function<void(int round, std::size_t done, std::size_t total)> on_lesson;
  /// False: stop as soon as possible. Called from all threads.
  std::function<bool()> keep_going;
  /// After an interrupt: how long it may take to report starts that were done; those that are not ready by
  /// then are not kept.
  std::chrono::milliseconds moment_to_report{200};
  /// After each finished task, one call at a time: all results so far; those not finished are `interrupted`.
  std::function<void(const std::vector<LimitResult>&)> on_limit;
  /// At the end: the furthest locked state of every task that was asked for; null where there is none.
  std::function<void(const std::vector<std::optional<State>>&)> on_states;
  /// Where limits learn: after the first searches from rest, before scenes within, and before each round of
  /// lessons. True where what was found decides what it was wanted for: then nothing more is searched for. A
  /// function of the results alone, on which all that follows depends.
  std::function<bool(const std::vector<LimitResult>&)> is_enough;
  /// At the end: limits that were solved for their states alone and are not reported (company, scenes
  /// that this one contains).
  std::function<void(const std::vector<LimitResult>&)> on_unreported;
  /// Searches that are known, and that are to be remembered, by names within this computation; null: none.
  SearchMemory* memory = nullptr;
};

/// By how much one state must be further than another, as scaled value, to count as further: more than the
/// gaps that the schedule leaves.
double further_than(const LimitSettings& settings);

/// All tasks, every start an item of its own for the threads; results do not depend on `threads`.
///
/// After its starts each task learns from tilted loads. Compressions of periodic cells and stretches of taut
/// sheets then begin once more from where those of every scene lock that this one contains (relatives.hpp),
/// and all tasks from what `settings.given` has for them. Then limits learn from each other: a locked state
/// of any task, and every image that a symmetry of the scene makes of it, is a reachable state for all that
/// hold nothing that it breaks, so where its value along another task's direction is further than that task's
/// own limit, that one is locked again from it, until none is. Compressions of periodic cells, which a
/// fabric's folds keep from their furthest state, are searched from `fold_starts` starts and once more
/// without the widest stage, and walk: each begins again from the states of the loads beside its own, as long
/// as these come to further ones. So do stretches of taut sheets, within an allowance, and from where the
/// fabric locks when it is pushed together across them. Limits that are not reported keep them company
/// (rest_searches.hpp). `known`: results that are there already, by task; empty: none. What one limit throws
/// is its result (status failed) and does not stop the others. Tasks that were not finished when `keep_going`
/// said no are `interrupted`, with the best of the starts that were done. What the observer throws is
/// rethrown.
std::vector<LimitResult> compute_limits(const Model& model, const SceneSpec& spec,
                                        const std::vector<LimitTask>& tasks, const LimitSettings& settings,
                                        unsigned threads, const LimitsObserver& observer = {},
                                        const std::vector<std::optional<LimitResult>>& known = {});

/// Starts and tilts of all tasks and their company, the searches with which compute_limits begins: it does
/// at least these, but for starts of a load that the first one shows to be unbounded.
double count_searches(const Model& model, const std::vector<LimitTask>& tasks, const LimitSettings& settings);

/// Of a computation that is divided: does a share of the searches that stand alone, for `observer.memory`,
/// which must not be null. These are all starts and tilts of the tasks and the starts of the scenes that this
/// one contains; what limits learn from each other needs all of them and is left to compute_limits. Searches
/// that throw are left to it, too. Of the observer only `keep_going` and `on_start` are called. Returns how
/// many all shares of them are; null: interrupted.
std::optional<std::size_t> compute_searches(const Model& model, const SceneSpec& spec,
                                            const std::vector<LimitTask>& tasks,
                                            const LimitSettings& settings, unsigned threads,
                                            const LimitsObserver& observer, const Share& share);

/// Both senses of equal directions joined: e_s, e_c, and for strains eta = (e_s - e_c)/(1 + e_c).
std::vector<ProfilePoint> profiles(const std::vector<LimitResult>& limits, const LoadCase& load);

}  // namespace hauberk
