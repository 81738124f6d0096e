#pragma once
/// The plan for people and for programs.

#include "limits/plan.hpp"
#include "run/prepared.hpp"

#include <boost/json/object.hpp>

#include <string>

namespace hauberk {

/// As in results.json, share/doc/results.md.
boost::json::object plan_json(const Prepared& prepared, const Plan& plan);

/// Several lines, ended by a line break.
std::string plan_text(const Prepared& prepared, const Plan& plan);

}  // namespace hauberk
