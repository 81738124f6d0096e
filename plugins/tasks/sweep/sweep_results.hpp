#pragma once
/// What a sweep found: one table, a row for every combination of the values that were varied.

#include "results/document.hpp"
#include "tasks/variants/row_status.hpp"

#include <boost/json/object.hpp>
#include <boost/json/value.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

struct SweepRow {
  std::vector<boost::json::value> values;  ///< by axis
  RowStatus status = RowStatus::interrupted;
  std::string message;                          ///< why it is not done
  std::vector<std::optional<double>> measured;  ///< by measure
  /// The row's results as a document of its own, less provenance and plan: format, experiment, scene, limits,
  /// profiles, design (null). Null where there are none.
  boost::json::value result;
};

struct SweepTable {
  struct Axis {
    std::string name;
    boost::json::array places;  ///< {pointer, factor, offset}
    bool logarithmic = false;
  };
  struct Measure {
    std::string name, pointer;
  };
  std::vector<Axis> axes;
  std::vector<Measure> measures;
  std::vector<SweepRow> rows;
};

/// Enters the results of a computed row: the document, what is measured of it, status and message.
void enter_result(const SweepTable& table, SweepRow& row, const RunResult& run,
                  const std::string& experiment_json, const std::vector<std::string>& macro_names);

/// The part `sweep` of results.json; share/doc/results.md explains every field.
boost::json::object sweep_json(const SweepTable& table);

/// Enters status, message, measured and result of an entry of `sweep_json` into a row; false when the entry
/// is of other values. Throws what boost::json throws for an entry that lacks something.
bool take_row(const boost::json::value& entry, const SweepTable& table, SweepRow& row);

/// One row per row, a header first: values, status, measured, evaluations (the sum over the limits),
/// message. As limits.csv.
std::string sweep_csv(const SweepTable& table);

/// What is measured against the values of the first axis; a line for every combination of the others. With
/// one axis all measures share a diagram, else each has its own. Lines are told apart by dashes as well as by
/// colour. Same results, same bytes.
std::string sweep_svg(const SweepTable& table, const std::string& title, const std::string& subtitle);

}  // namespace hauberk
