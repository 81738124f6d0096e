#pragma once
/// The plan for people and for programs.

#include "loading.hpp"

#include <boost/json/object.hpp>

#include <string>

namespace hauberk::command {

/// As in results.json, share/doc/results.md.
boost::json::object plan_json(const Loaded& loaded);

/// Several lines, ended by a line break.
std::string plan_text(const Loaded& loaded);

}  // namespace hauberk::command
