#pragma once
/// Error against time: scenes with known limits times methods times settings (a work-precision diagram).

#include "tasks/variants/row_status.hpp"

#include <hauberk/direction.hpp>

#include <boost/json/object.hpp>
#include <boost/json/value.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// Errors below count as this one: sums of a few numbers are no more exact.
inline constexpr double least_error = 1e-16;

/// What one solve of all limits of a variant gave, and what it took.
struct PrecisionRun {
  RowStatus status = RowStatus::interrupted;
  std::string message;
  std::vector<std::optional<double>> values;     ///< by limit
  std::vector<std::optional<double>> estimates;  ///< of their errors, by limit
  int locked = 0;                                ///< how many limits are
  std::int64_t iterations = 0;                   ///< Newton steps
  std::int64_t evaluations = 0;                  ///< of closest points
  std::optional<double> seconds;                 ///< wall time; null: nothing was solved
};

/// A scene and what its limits are compared with.
struct PrecisionScene {
  struct Limit {
    Direction direction;
    std::string sense;
  };
  std::string name;
  std::vector<Limit> limits;
  std::vector<std::optional<double>> exact;  ///< by limit, null: not compared; empty: not known yet
  bool has_reference = false;                ///< `exact` comes from a solve of higher accuracy
  std::optional<PrecisionRun> reference;     ///< that solve, once it is done

  /// Largest error estimate of the reference, as a relative error; null where one has none.
  std::optional<double> floor() const;
};

struct PrecisionMethod {
  std::string name;
  std::vector<std::string> settings;  ///< their names
};

/// A scene by a method in a setting with a number of threads.
struct PrecisionPoint {
  std::size_t scene = 0, method = 0, setting = 0;
  int threads = 1;  ///< as asked for; 0: all processors
  RowStatus status = RowStatus::interrupted;
  std::string message;
  std::optional<PrecisionRun> first;  ///< of the runs; null before
  std::vector<double> seconds;        ///< of all runs
  std::optional<std::int64_t> peak_memory_bytes;
  bool reproducible = true;     ///< all runs, with whatever number of threads, gave the same
  std::optional<double> error;  ///< largest |value - exact|/(1 + |exact|); null where there is none
  /// No other point of the scene and number of threads is better in error or time (work: evaluations) without
  /// being worse in the other.
  bool pareto = false, pareto_work = false;

  std::optional<double> median_seconds() const;
};

struct PrecisionChart {
  int repeats = 1;
  std::vector<int> threads;
  std::vector<PrecisionScene> scenes;
  std::vector<PrecisionMethod> methods;
  std::vector<PrecisionPoint> points;  ///< by scene, method, setting, threads
};

/// What limits amount to; `seconds` is the wall time of all. The work on those that are `unreported`, solved
/// for their states alone, counts too.
PrecisionRun precision_run(const std::vector<LimitResult>& limits, const std::vector<LimitResult>& unreported,
                           double seconds);

/// Enters the solve of a scene's reference: its values are exact from now on. Where it has not every limit,
/// or no value at all, the scene's points fail, with a message that says why.
void enter_reference(PrecisionChart& chart, std::size_t scene, PrecisionRun run);

/// Enters a run of a point. The point is done after `repeats` of them, or has failed when the run did, when
/// it lacks a value that is known, or when it differs in anything but time from another run of the same
/// scene, method and setting. Interrupted runs are not entered. Evaluates anew.
void enter_run(PrecisionChart& chart, std::size_t point, PrecisionRun run);

/// Errors and Pareto fronts from what was entered. Points with some runs left to do count, by those that they
/// have.
void evaluate(PrecisionChart& chart);

/// The points of a scene that pictures show: those of the first number of threads, that have an error.
std::vector<const PrecisionPoint*> shown_points(const PrecisionChart& chart, std::size_t scene);

/// "chain, arc, 0.001", and the number of threads where several were asked for.
std::string point_name(const PrecisionChart& chart, const PrecisionPoint& point);

/// The part `chart` of results.json; share/doc/results.md explains every field.
boost::json::object chart_json(const PrecisionChart& chart);

/// Enters what `chart_json` recorded of runs into a chart of the same experiment, and evaluates it. False
/// when it is of other points. Throws what boost::json throws for a value that lacks something.
bool take_chart(const boost::json::value& recorded, PrecisionChart& chart);

/// One row per point, a header first; as limits.csv.
std::string chart_csv(const PrecisionChart& chart);

/// What pictures have along x.
enum class PrecisionCost { seconds, evaluations };

/// Error against cost on logarithmic axes, a panel per scene, a line per method through its settings in the
/// order of cost. Methods differ by marker and dash as well as by colour; points of the Pareto front have a
/// heavy ring. Errors below `least_error` are drawn there. Points without an error are listed below. Same
/// results, same bytes.
std::string chart_svg(const PrecisionChart& chart, PrecisionCost cost, const std::string& title);

}  // namespace hauberk
