#pragma once
/// Limits as a table, for spreadsheets and plotting programs.

#include "limits/limit_result.hpp"

#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// One row per limit, a header first; separator comma, decimal point, empty where there is no value. Columns:
/// load_case, direction_deg, direction_<unknown> (only where limits are along components), sense, measure,
/// value, companions and macroscopic unknowns by name, status, iterations, evaluations, min_gap,
/// error_estimate, links_kept, z_range, better_state, force_balance, starts, contacts (counts). Numbers read
/// back exactly. `macro_names` are columns even where no limit has a state. Thread safe.
std::string limits_csv(std::span<const LimitResult> limits, const std::vector<std::string>& macro_names);

}  // namespace hauberk
