#include "chart_points.hpp"

#include "read.hpp"

#include <boost/json/array.hpp>

namespace hauberk::verification {

namespace json = boost::json;

namespace {

bool flag(const json::value& object, const char* key, const std::string& where)
{
  const json::value& v = member(object, key, where);
  if (!v.is_bool()) throw Malformed(where + "/" + key + ": true or false expected");
  return v.get_bool();
}

}  // namespace

Values read_values(const json::value& list, const std::string& where)
{
  Values out;
  for (const json::value& x : array(list, where))
    out.push_back(x.is_null() ? std::nullopt : std::optional(number(x, where)));
  return out;
}

ChartPoint read_chart_point(const json::value& entry, const std::string& where)
{
  ChartPoint p;
  p.where = where;
  p.scene = text(member(entry, "scene", where), where);
  p.method = text(member(entry, "method", where), where);
  p.setting = text(member(entry, "setting", where), where);
  p.status = text(member(entry, "status", where), where);
  p.threads = number(member(entry, "threads", where), where);
  p.values = read_values(member(entry, "values", where), where + "/values");
  p.error = optional_number(entry, "error", where);
  p.evaluations = number(member(entry, "evaluations", where), where);
  p.iterations = number(member(entry, "iterations", where), where);
  p.pareto = flag(entry, "pareto", where);
  p.pareto_work = flag(entry, "pareto_work", where);
  p.reproducible = flag(entry, "reproducible", where);
  const json::value& seconds = member(entry, "seconds", where);
  if (seconds.is_null()) return p;
  for (const json::value& x : array(member(seconds, "runs", where), where + "/seconds/runs"))
    p.runs.push_back(number(x, where + "/seconds/runs"));
  p.median = number(member(seconds, "median", where + "/seconds"), where + "/seconds/median");
  return p;
}

}  // namespace hauberk::verification
