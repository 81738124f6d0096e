#pragma once
/// Settings that line-search methods share.

#include <hauberk/section.hpp>

#include <vector>

namespace hauberk {

/// Steps and optimality are measured in variables scaled by their ranges.
struct SearchSettings {
  int max_iterations = 100;
  int max_evaluations = 100000;
  double tolerance = 1e-6;             ///< of decrease and optimality, relative to the objective
  double constraint_tolerance = 1e-8;  ///< violation that counts as none, in the constraints' unit
  double initial_step = 0.05;          ///< longest first step, part of a variable's range
  double max_step = 0.5;               ///< longest step, part of a variable's range
  double min_step = 1e-7;              ///< shortest step worth an evaluation, part of a variable's range
};

/// Fields of these settings: `own` are those of the method, which stand between the counts and the
/// tolerances. `max_iterations` is its default, as JSON.
std::vector<Field> search_fields(const char* max_iterations, std::vector<Field> own);

/// Fills `settings` from a section checked against the fields. What contradicts itself goes to `problems`;
/// then false is returned.
bool read_search_settings(const Node& section, SearchSettings& settings, Problems& problems);

}  // namespace hauberk
