#include "checks.hpp"
#include "read.hpp"

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// Relative to the ends of a range: its values come from a formula, not from the file.
constexpr double range_rounding = 1e-12;
constexpr double most_values = 1e6;

struct Axis {
  std::string name;
  std::vector<json::value> values;
  double rounding = 0.0;  ///< within which numbers are the same
};

double number_or(const json::value& object, const char* key, double otherwise, const std::string& where)
{
  return optional_number(object, key, where).value_or(otherwise);
}

/// The values that a range of the experiment stands for.
void read_range(const json::value& range, const std::string& where, Axis& axis)
{
  const double from = number(member(range, "from", where), where),
               to = number(member(range, "to", where), where),
               count = number(member(range, "count", where), where);
  if (!(count >= 2.0 && count <= most_values)) throw Malformed(where + "/count: a number of values expected");
  const json::value* scale = range.as_object().if_contains("scale");
  const bool log = scale != nullptr && text(*scale, where) == "log";
  for (double k = 0.0; k < count; k += 1.0) {
    const double t = k / (count - 1.0);
    axis.values.emplace_back(log ? std::exp((1.0 - t) * std::log(from) + t * std::log(to))
                                 : (1.0 - t) * from + t * to);
  }
  axis.rounding = range_rounding * std::max(std::abs(from), std::abs(to));
}

Axis read_axis(const json::value& entry, const std::string& where)
{
  Axis axis{text(member(entry, "name", where), where), {}, 0.0};
  if (const json::value* range = entry.as_object().if_contains("range")) {
    read_range(*range, where + "/range", axis);
  } else {
    for (const json::value& value : array(member(entry, "values", where), where + "/values"))
      axis.values.push_back(value);
  }
  if (axis.values.empty()) throw Malformed(where + ": no values");
  return axis;
}

bool same(const json::value& a, const json::value& b, double rounding)
{
  if (!a.is_number() || !b.is_number()) return a == b;
  return std::abs(a.to_number<double>() - b.to_number<double>()) <= rounding;
}

/// A place of the experiment is a pointer, or a pointer with factor and offset.
bool same_place(const json::value& given, const json::value& place, const std::string& where)
{
  const std::string pointer = text(member(place, "pointer", where), where);
  const double factor = number(member(place, "factor", where), where),
               offset = number(member(place, "offset", where), where);
  if (given.is_string()) return text(given, where) == pointer && factor == 1.0 && offset == 0.0;
  return text(member(given, "pointer", where), where) == pointer &&
         number_or(given, "factor", 1.0, where) == factor && number_or(given, "offset", 0.0, where) == offset;
}

void check_axes(const json::array& vary, const json::array& axes, Sentences& problems)
{
  if (vary.size() != axes.size()) {
    problems.push_back(fmt::format("axes: {} expected, found {}", vary.size(), axes.size()));
    return;
  }
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const std::string where = fmt::format("/sweep/axes/{}", k);
    const json::array& given = array(member(vary[k], "pointers", "/experiment/sweep/vary"), where);
    const json::array& places = array(member(axes[k], "places", where), where);
    bool equal = given.size() == places.size() &&
                 text(member(vary[k], "name", where), where) == text(member(axes[k], "name", where), where);
    for (std::size_t i = 0; equal && i < places.size(); ++i)
      equal = same_place(given[i], places[i], fmt::format("{}/places/{}", where, i));
    if (!equal) problems.push_back(fmt::format("axes/{}: not what the experiment varies", k));
  }
}

/// Every combination once, the last axis the fastest.
void check_rows(const std::vector<Axis>& axes, const json::array& rows, Sentences& problems)
{
  double expected = 1.0;
  for (const Axis& axis : axes) expected *= static_cast<double>(axis.values.size());
  if (static_cast<double>(rows.size()) != expected) {
    problems.push_back(fmt::format("rows: {:g} expected, found {}", expected, rows.size()));
    return;
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::string where = fmt::format("/sweep/rows/{}", row);
    const json::value& values = member(rows[row], "values", where);
    std::size_t rest = row;
    for (std::size_t k = axes.size(); k-- > 0;) {
      const Axis& axis = axes[k];
      const json::value& found = member(values, axis.name.c_str(), where + "/values");
      if (!same(found, axis.values[rest % axis.values.size()], axis.rounding))
        problems.push_back(fmt::format("rows/{}: '{}' is not the value of this row", row, axis.name));
      rest /= axis.values.size();
    }
  }
}

/// Where the experiment says what is measured, the table records that.
void check_measures(const json::value& asked, const json::value& sweep, Sentences& problems)
{
  const json::value* measure = asked.as_object().if_contains("measure");
  if (measure == nullptr) return;
  const json::array& given = array(*measure, "/experiment/sweep/measure");
  const json::array& recorded = array(member(sweep, "measures", "/sweep"), "/sweep/measures");
  bool equal = given.size() == recorded.size();
  for (std::size_t k = 0; equal && k < given.size(); ++k) {
    for (const char* key : {"name", "pointer"})
      equal = equal && member(given[k], key, "/experiment/sweep/measure") ==
                           member(recorded[k], key, "/sweep/measures");
  }
  if (!equal) problems.emplace_back("measures: not what the experiment asks for");
}

}  // namespace

VerifyLine check_sweep_table(const json::value& experiment, const json::value& sweep)
{
  const json::value& asked = member(experiment, "sweep", "/experiment");
  const json::array& vary = array(member(asked, "vary", "/experiment/sweep"), "/experiment/sweep/vary");
  const json::array& rows = array(member(sweep, "rows", "/sweep"), "/sweep/rows");
  Sentences problems;
  check_axes(vary, array(member(sweep, "axes", "/sweep"), "/sweep/axes"), problems);
  check_measures(asked, sweep, problems);
  std::vector<Axis> axes;
  axes.reserve(vary.size());
  for (const json::value& entry : vary)
    axes.push_back(read_axis(entry, fmt::format("/experiment/sweep/vary/{}", axes.size())));
  check_rows(axes, rows, problems);
  std::vector<std::string> statuses;
  for (const json::value& row : rows)
    statuses.push_back(text(member(row, "status", "/sweep/rows"), "/sweep/rows"));
  check_counts(member(sweep, "counts", "/sweep"), statuses, "rows", problems);
  if (problems.empty())
    return {true, fmt::format("/sweep: {} rows, one for every combination of the values", rows.size())};
  std::string all;
  for (const std::string& problem : problems) all += (all.empty() ? "" : "; ") + problem;
  return {false, "/sweep: " + all};
}

}  // namespace hauberk::verification
