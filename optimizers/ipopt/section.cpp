#include "ipopt_optimizer.hpp"

#include <common/fields.hpp>

namespace hauberk {

void ipopt_fields(std::vector<Field>& out)
{
  out.push_back(count_field("max_iterations", "1000", 1e6,
                            "Accepted steps after which to stop; 0 only evaluates the start."));
  out.push_back(max_evaluations_field());
  Field memory = count_field("memory", "20", 1e3, "Steps that the Hessian is made of.");
  memory.minimum = 1.0;
  out.push_back(memory);
  out.push_back(tolerance_field());
  out.push_back(constraint_tolerance_field());
  out.push_back(fraction_field("barrier", "0.01", "First barrier parameter, relative to the objective."));
  Field push = fraction_field(
      "push", "0.01", "Distance of the first iterate from the bounds, as part of a variable's range.");
  push.maximum = 0.4;
  out.push_back(push);
  out.push_back(min_step_field());
}

std::unique_ptr<Optimizer> make_ipopt(const Node& section, Problems& /*problems*/)
{
  IpoptSettings settings;
  settings.walk.max_iterations = integer(section, "max_iterations");
  settings.walk.max_evaluations = integer(section, "max_evaluations");
  settings.walk.tolerance = section.at("tolerance").number;
  settings.walk.constraint_tolerance = section.at("constraint_tolerance").number;
  settings.memory = integer(section, "memory");
  settings.barrier = section.at("barrier").number;
  settings.push = section.at("push").number;
  settings.min_step = section.at("min_step").number;
  return std::make_unique<IpoptOptimizer>(settings);
}

}  // namespace hauberk
