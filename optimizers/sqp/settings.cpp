#include "sqp.hpp"

#include <common/fields.hpp>

namespace hauberk {
void sqp_fields(std::vector<Field>& out)
{
  out.push_back(count_field("max_iterations", "100", 1e6,
                            "Accepted steps after which to stop; 0 only evaluates the start."));
  out.push_back(max_evaluations_field());
  out.push_back(choice_field(
      "hessian", {"gauss_newton", "bfgs"},
      "Curvature of the model: Gauss-Newton where the problem is a sum of squares, or damped BFGS always."));
  out.push_back(tolerance_field());
  out.push_back(constraint_tolerance_field());
  out.push_back(fraction_field("initial_step", "0.05", "Longest first step, as part of a variable's range."));
  out.push_back(fraction_field("max_step", "0.5", "Longest step, as part of a variable's range."));
  out.push_back(min_step_field());
}

std::unique_ptr<Optimizer> make_sqp(const Node& section, Problems& problems)
{
  SqpSettings settings;
  settings.max_iterations = integer(section, "max_iterations");
  settings.max_evaluations = integer(section, "max_evaluations");
  settings.gauss_newton = section.at("hessian").string == "gauss_newton";
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
  if (!sound) return nullptr;
  return std::make_unique<Sqp>(settings);
}

}  // namespace hauberk
