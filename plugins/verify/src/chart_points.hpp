#pragma once
/// Points of a chart as a results file records them.

#include "checks.hpp"

#include <boost/json/value.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk::verification {

using Values = std::vector<std::optional<double>>;

/// A scene by a method in a setting with a number of threads.
struct ChartPoint {
  std::string where;  ///< its place in the file
  std::string scene, method, setting, status;
  double threads = 1.0;
  Values values;
  std::optional<double> error, median;
  std::vector<double> runs;
  double evaluations = 0.0, iterations = 0.0;
  bool pareto = false, pareto_work = false, reproducible = true;
};

/// Numbers and nulls. Throws Malformed.
Values read_values(const boost::json::value& list, const std::string& where);

/// Throws Malformed.
ChartPoint read_chart_point(const boost::json::value& entry, const std::string& where);

/// `locked` counts the values. Throws Malformed.
void check_locked(const boost::json::value& entry, const Values& values, const std::string& where,
                  Sentences& problems);

/// The points are those that `experiment`, the section of the experiment `whole`, asks for, each once; exact
/// values are the experiment's or the reference's. Throws Malformed.
void check_chart_table(const boost::json::value& whole, const boost::json::value& experiment,
                       const boost::json::value& chart, const std::vector<ChartPoint>& points,
                       Sentences& problems);

}  // namespace hauberk::verification
