#include "pagmo_optimizer.hpp"

#include <common/fields.hpp>

#include <string>
#include <utility>

namespace hauberk {
namespace {

/// A count that has a least value.
Field count_from(double least, std::string name, std::string default_json, double largest, std::string doc)
{
  Field field = count_field(std::move(name), std::move(default_json), largest, std::move(doc));
  field.minimum = least;
  return field;
}

}  // namespace

void pagmo_fields(std::vector<Field>& out)
{
  out.push_back(seed_field());
  out.push_back(count_from(8.0, "population", "20", 1e5, "Points of a generation."));
  out.push_back(count_from(1.0, "generations", "200", 1e6, "Generations after which to stop."));
  out.push_back(count_field("max_iterations", "100000", 1e6,
                            "Improved points after which to stop; 0 only evaluates the start."));
  out.push_back(max_evaluations_field());
  out.push_back(tolerance_field());
  out.push_back(constraint_tolerance_field());
  out.push_back(fraction_field("initial_step", "0.1",
                               "Standard deviation of the first draws, as part of a variable's range."));
  out.push_back(fraction_field("min_step", "1e-7",
                               "Size of a population that has converged, as part of a variable's range."));
}

std::unique_ptr<Optimizer> make_pagmo(const Node& section, Problems& problems)
{
  PagmoSettings settings;
  settings.seed = static_cast<unsigned>(section.at("seed").number);
  settings.population = static_cast<unsigned>(integer(section, "population"));
  settings.generations = static_cast<unsigned>(integer(section, "generations"));
  settings.walk.max_iterations = integer(section, "max_iterations");
  settings.walk.max_evaluations = integer(section, "max_evaluations");
  settings.walk.tolerance = section.at("tolerance").number;
  settings.walk.constraint_tolerance = section.at("constraint_tolerance").number;
  settings.initial_step = section.at("initial_step").number;
  settings.min_step = section.at("min_step").number;
  if (settings.min_step * 10.0 > settings.initial_step) {
    problems.add(section.at("min_step"), "min_step must be at most a tenth of initial_step");
    return nullptr;
  }
  return std::make_unique<PagmoOptimizer>(settings);
}

}  // namespace hauberk
