#pragma once
/// What is told of a limit, as written to results.json (format "hauberk-results/2"). Lengths, curvatures and
/// forces are in file units; conversion from scaled quantities happens where these are filled.

#include "model/scene.hpp"

#include <hauberk/direction.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

enum class LimitStatus { locked, unbounded, not_attained, stalled, failed, interrupted, not_a_sheet };
/// All of them, in the order of the enumeration.
inline constexpr std::array all_limit_statuses = {
    LimitStatus::locked, LimitStatus::unbounded,   LimitStatus::not_attained, LimitStatus::stalled,
    LimitStatus::failed, LimitStatus::interrupted, LimitStatus::not_a_sheet};
std::string to_string(LimitStatus status);
/// True of what ends a question: there is a limit, or there is none. False: nothing is known.
bool is_answer(LimitStatus status);

/// One contact force at a locked state. For `arc`, one resultant per pair and side.
struct ContactForce {
  std::array<int, 2> elements{};                           ///< placed elements; walls: second is -1
  std::array<int, 2> primitives{};                         ///< index within the element; walls: -1
  std::array<int, 3> image{};                              ///< lattice image of the second element
  std::array<Vec3, 2> points{Vec3::Zero(), Vec3::Zero()};  ///< on the two surfaces, absolute
  Vec3 normal = Vec3::Zero();                              ///< unit, from first to second element
  double gap = 0.0;                                        ///< surface distance minus clearance
  double force = 0.0;  ///< -dE/dg >= 0, 1/length (times the unit of the value)
  std::string wall;    ///< name of the wall, empty for contacts between elements
};

/// A distinct locked state found from one or more starts.
struct LockedState {
  double value = 0.0;
  std::vector<double> macro;
  double z_range = 0.0;
  std::uint64_t seed = 0;  ///< of the start that came furthest to it (the first of equals)
  std::string origin;      ///< what found it: start, tilt, or from another limit
  int count = 0;
};

/// A search for a limit that ended in no locked state.
struct FailedSearch {
  std::string origin;  ///< as LockedState::origin
  std::uint64_t seed = 0;
  std::string status;
  std::optional<double> reached;  ///< value of the state in which it gave up
};

/// How far a limit may be taken for the furthest: no search proves that it is, so what was done is told.
///
/// Words: `confirmed`: independent searches ended here, or a relation that must hold between true limits
/// does; `single`: one search ended here; `unsettled`: confirmed, but of ten or more that locked
/// several, and more than a tenth, did so in states that no other came to, so that more searches would come
/// to new ones; `contradicted`: a relation that must hold does not, or a search that failed came further;
/// `none`: there is no locked state. In partial results also `alone`: the limit's own searches are done,
/// others may still teach it; and `unfinished`: it was learning from others.
struct Confidence {
  std::string word = "none";
  int searches = 0;    ///< all of them
  int ended_here = 0;  ///< of these, at the value that is reported
  int distinct = 0;    ///< locked states of the fabric that were found
  int seen_once = 0;   ///< of these, those that one search alone came to
  std::vector<std::string> confirmed_by, contradicted_by;
  std::vector<FailedSearch> failed_searches;

  /// Nothing of the run that this is of can change it.
  bool is_final() const { return word != "alone" && word != "unfinished"; }
};

/// A state of the motion that shows that nothing stops a load.
struct WitnessState {
  std::vector<std::pair<std::string, double>> macro;
  std::vector<Pose> poses;
};

struct LimitResult {
  bool resumed = false;  ///< read from a former run's results, without poses and contacts
  std::string load_case;
  Direction direction;
  std::string sense;
  std::string measure;
  LimitStatus status = LimitStatus::failed;
  std::string message;            ///< what happened, for people; empty when locked without remark
  std::optional<double> value;    ///< null unless a state was reached
  std::optional<double> infimum;  ///< for not_attained, if known
  std::vector<std::pair<std::string, double>> companions;  ///< e.g. line_stretch
  std::vector<std::pair<std::string, double>> macro;       ///< names and values
  int iterations = 0;
  long evaluations = 0;
  double seconds = 0.0;
  std::optional<double> min_gap;  ///< smallest surface distance minus clearance, over all pairs
  std::optional<double> error_estimate;
  bool links_kept = false;
  double z_range = 0.0;
  std::vector<LockedState> starts;
  bool better_state = false;  ///< further than the state that the first start from rest led to
  Confidence confidence;
  std::optional<double> sensitivity_clearance;
  std::vector<std::pair<std::string, double>>
      sensitivity_parameters;  ///< "k/ring.R" -> d value / d parameter
  /// At a kink, where contact forces are not unique: derivatives towards smaller and larger clearances or
  /// parameters (in the order of sensitivity_parameters).
  using OneSided = std::array<double, 2>;
  bool kink = false;
  OneSided clearance_one_sided{};
  std::vector<OneSided> parameters_one_sided;
  std::vector<Pose> poses;  ///< of the cell's elements at the limit, absolute
  std::vector<ContactForce> contacts;
  /// Of unbounded and not_attained: states from rest until a strain passes its bound. Between two of them
  /// macroscopic unknowns and displacements change linearly and elements turn about fixed axes.
  std::vector<WitnessState> witness;
  std::optional<double> force_balance;
  std::vector<std::string> hold;  ///< what the limit holds
  /// d value / d(held component) of the conditions among them, in their order.
  std::vector<std::pair<std::string, double>> reactions;
  std::string contact;                     ///< what finished: name_of(Formulation), or "constrained"
  std::optional<double> quadrature_error;  ///< of arc: part of the load by which finer panels change forces
  std::optional<double> finite_target;     ///< of the published objective; none: a constant load
  std::string certificate;                 ///< what is certified, for people
};

struct ProfilePoint {
  double direction_deg = 0.0;
  std::optional<double> e_s, e_c, eta;
};

/// Indices of three limits, counter-clockwise seen from outside.
using Triangle = std::array<int, 3>;

/// Limits along components as one surface, file units.
struct BoundarySurface {
  /// A limit that is not the furthest state: that of limit `state` is further along it.
  struct Shortfall {
    int limit = 0, state = 0;
    double by = 0.0;
  };
  std::vector<Triangle> triangles;    ///< between neighbouring directions of a sphere; empty for a list
  double margin = 0.0;                ///< what falls short by no more is left out
  std::vector<Shortfall> shortfalls;  ///< ascending by limit, each with the furthest of such states
};

}  // namespace hauberk
