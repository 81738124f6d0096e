#pragma once
/// The plan for people and for programs.

#include "limits/plan.hpp"
#include "run/prepared.hpp"

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <string>
#include <vector>

namespace hauberk {

/// What links say of a limit: "attained", "unbounded", "not attained".
std::string to_string(Boundedness bounded);

/// As in results.json, share/doc/results.md.
boost::json::object plan_json(const Prepared& prepared, const Plan& plan);

/// `tightest` of `hauberk plan --json`, share/doc/results.md.
boost::json::array tightest_json(const std::vector<TightPair>& pairs);

/// Several lines, ended by a line break. `task`: what the task itself plans (TaskRun::plan), by name.
/// `tightest`: the pairs to list (tightest_pairs).
std::string plan_text(const Prepared& prepared, const Plan& plan, const boost::json::object& task,
                      const std::vector<TightPair>& tightest);

}  // namespace hauberk
