#include "run/limit_tasks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {

std::vector<LimitTask> profile_tasks(const Experiment& experiment)
{
  std::vector<LimitTask> tasks;
  tasks.reserve(experiment.directions_deg.size() * experiment.senses.size() + experiment.directions.size());
  for (const double direction : experiment.directions_deg) {
    for (const Sense sense : experiment.senses) tasks.push_back({Direction::at_degrees(direction), sense});
  }
  for (const Direction& direction : experiment.directions) tasks.push_back({direction, Sense::positive});
  return tasks;
}

std::string limits_check_line(const Plan& plan, std::size_t limits)
{
  const auto unbounded = std::count_if(plan.bounded.begin(), plan.bounded.end(), [](const auto& task) {
    return task.second == Boundedness::unbounded;
  });
  const std::string free =
      fmt::format(" ({} not held by links: only a try shows whether they are unbounded)", unbounded);
  return fmt::format("{} elements, {} limits{}", plan.elements, limits, unbounded > 0 ? free : "");
}

}  // namespace hauberk
