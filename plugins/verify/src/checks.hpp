#pragma once
/// The single checks. Each appends to `problems` one sentence for everything that is wrong: what, and by how
/// much.

#include "model.hpp"
#include "record.hpp"

#include <hauberk/verify/verify.hpp>

#include <boost/json/value.hpp>

#include <string>
#include <vector>

namespace hauberk::verification {

using Sentences = std::vector<std::string>;

/// Contacts belong to the state: indices, points on surfaces, normals, gaps, forces, walls. False where one
/// names an element or a primitive that does not exist, so that nothing can be done with it.
bool check_contacts(const Scene& scene, const Setting& setting, const Limit& limit,
                    const VerifyTolerances& tolerances, Sentences& problems, Record& record);

/// Value, companions and starts follow from macro; sense, F, mean translation and heights are admissible.
void check_values(const Scene& scene, const Setting& setting, const Limit& limit,
                  const VerifyTolerances& tolerances, Sentences& problems);

/// `z_range` is that of the poses.
void check_range(const Scene& scene, const Limit& limit, const VerifyTolerances& tolerances,
                 Sentences& problems);

/// Everything about one limit; the line says what was found. `json` is the limit as the file has it,
/// `experiment` gives the shapes. Throws Malformed, Unknown.
VerifyLine check_limit(const Scene& scene, const Setting& of_all, const Limit& limit,
                       const boost::json::value& json, const boost::json::value& experiment,
                       const VerifyTolerances& tolerances, const VerifyShapes& shapes, Record& record);

/// Derivatives of the value follow from forces and gaps by the envelope theorem; what can be said about it.
void check_sensitivity(const Scene& scene, const Setting& setting, const Limit& limit,
                       const boost::json::value& sensitivity, const boost::json::value& experiment,
                       const std::string& where, const VerifyShapes& shapes, Sentences& problems,
                       Record& record);

/// A value that the design gave to parameters of elements.
struct DesignedValue {
  std::vector<std::pair<std::size_t, std::string>> parameters;
  double value = 0.0;
};

struct SceneCheck {
  const boost::json::value* experiment = nullptr;
  std::string experiment_where;
  const boost::json::value* json = nullptr;  ///< the scene as the file has it
  std::string where;
  const Scene* scene = nullptr;
  Setting setting;
  std::vector<DesignedValue> designed;
  bool relaxed = false;  ///< rest may have been relaxed, whatever the experiment says
  bool initial = false;  ///< of a design: the experiment gives what is designed, too
  const VerifyShapes* shapes = nullptr;
};

/// The scene is what the experiment's text says: cell, types, parameters, primitives, and rest as placed or
/// relaxed from there. Throws Malformed.
VerifyLine check_scene(const SceneCheck& check, const VerifyTolerances& tolerances, Record& record);

/// There is a limit for each direction and sense that the experiment asks for, and each says what it was
/// asked by. Throws Malformed.
void check_asked(const boost::json::value& experiment, const std::string& experiment_where,
                 const std::vector<Limit>& limits, Sentences& problems, Record& record);

/// Whether a limit may name this contact formulation under these settings of the solver.
bool allowed_contact(const boost::json::value& solver, const std::string& contact, bool has_state);

/// Profiles follow from limits. Throws Malformed.
VerifyLine check_profiles(const boost::json::value& results, Load load, const std::vector<Limit>& limits,
                          const VerifyTolerances& tolerances);

/// The surface of limits along components: its triangles join limits, and the limits that it says are not the
/// furthest are those, each by what the state it names says. `complete`: all limits could be read. Throws
/// Malformed.
VerifyLine check_boundary(const boost::json::value& boundary, const std::vector<Limit>& limits, bool complete,
                          const VerifyTolerances& tolerances);

/// What a design's variables are in its two scenes.
struct DesignedScenes {
  std::vector<DesignedValue> initial, final;
};

/// Targets, objectives and variables of a design are the experiment's and follow from limits; `designed` gets
/// what the scenes must have. Throws Malformed.
VerifyLine check_design(const boost::json::value& results, const std::vector<Limit>& initial,
                        const std::vector<Limit>& final, DesignedScenes& designed,
                        const VerifyTolerances& tolerances, Record& record);

/// The map of a stability experiment: families, members and methods are the experiment's, outcomes follow
/// from what the cases say, counts from the cases. A line for the table, and one for each case that is wrong.
/// Throws Malformed.
void check_stability(const boost::json::value& experiment, const boost::json::value& map,
                     std::vector<VerifyLine>& lines, Record& record);

/// The table of a sweep is what its experiment asks for: axes, measures, a row for every combination of the
/// values, and how many there are of each status. Throws Malformed.
VerifyLine check_sweep_table(const boost::json::value& experiment, const boost::json::value& sweep);

/// How many entries there are of each status is what `counts` says; `what` they are called. Throws Malformed.
void check_counts(const boost::json::value& counts, const std::vector<std::string>& statuses,
                  const std::string& what, Sentences& problems);

/// The points of a chart are what its experiment asks for; errors, medians and Pareto fronts follow from what
/// is recorded. A line for the table and one for each point. Throws Malformed.
void check_chart(const boost::json::value& experiment, const boost::json::value& chart,
                 std::vector<VerifyLine>& lines, Record& record);

/// Equal to rounding: |a - b| <= tolerance (1 + |b|).
bool equal(double a, double b, double tolerance);
/// Both absent, or both there and equal.
bool equal(const std::optional<double>& a, const std::optional<double>& b, double tolerance);
/// "0.43" or "null".
std::string show(const std::optional<double>& x);

/// The limit of a direction (modulo 180 degrees) and sense; null when there is none.
const Limit* find_limit(const std::vector<Limit>& limits, double direction_deg, const std::string& sense);
/// (e_s - e_c) / (1 + e_c); nothing where one is absent or 1 + e_c <= 0.
std::optional<double> eta(const std::optional<double>& e_s, const std::optional<double>& e_c);

}  // namespace hauberk::verification
