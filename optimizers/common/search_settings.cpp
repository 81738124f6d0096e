#include "search_settings.hpp"

#include "fields.hpp"

#include <utility>

namespace hauberk {

std::vector<Field> search_fields(const char* max_iterations, std::vector<Field> own)
{
  std::vector<Field> out{count_field("max_iterations", max_iterations, 1e6,
                                     "Accepted steps after which to stop; 0 only evaluates the start."),
                         max_evaluations_field()};
  for (Field& field : own) out.push_back(std::move(field));
  out.push_back(tolerance_field());
  out.push_back(constraint_tolerance_field());
  out.push_back(fraction_field("initial_step", "0.05", "Longest first step, as part of a variable's range."));
  out.push_back(fraction_field("max_step", "0.5", "Longest step, as part of a variable's range."));
  out.push_back(min_step_field());
  return out;
}

bool read_search_settings(const Node& section, SearchSettings& settings, Problems& problems)
{
  settings.max_iterations = integer(section, "max_iterations");
  settings.max_evaluations = integer(section, "max_evaluations");
  settings.tolerance = section.at("tolerance").number;
  settings.constraint_tolerance = section.at("constraint_tolerance").number;
  settings.initial_step = section.at("initial_step").number;
  settings.max_step = section.at("max_step").number;
  settings.min_step = section.at("min_step").number;
  bool sound = true;
  if (settings.initial_step > settings.max_step) {
    problems.add(section.at("initial_step"), "initial_step must not be larger than max_step");
    sound = false;
  }
  if (settings.min_step * 10.0 > settings.initial_step) {
    problems.add(section.at("min_step"), "min_step must be at most a tenth of initial_step");
    sound = false;
  }
  return sound;
}

}  // namespace hauberk
