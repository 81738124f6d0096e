#include "nlopt_optimizer.hpp"

#include <common/fields.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace hauberk {
namespace {

const std::array<std::string, 5> names = {"slsqp", "mma", "ccsaq", "lbfgs", "cobyla"};

}  // namespace

void nlopt_fields(std::vector<Field>& out)
{
  out.push_back(choice_field("algorithm", {names.begin(), names.end()},
                             "Algorithm of NLopt; cobyla asks for no gradients."));
  out.push_back(count_field("max_iterations", "1000", 1e6,
                            "Improved points after which to stop; 0 only evaluates the start."));
  out.push_back(max_evaluations_field());
  out.push_back(count_field("memory", "20", 1e4, "Steps that lbfgs remembers; 0: NLopt's choice."));
  out.push_back(tolerance_field());
  out.push_back(constraint_tolerance_field());
  out.push_back(fraction_field("initial_step", "0.05",
                               "First step of cobyla, as part of a variable's range. The others choose."));
  out.push_back(min_step_field());
}

std::unique_ptr<Optimizer> make_nlopt(const Node& section, Problems& problems)
{
  NloptSettings settings;
  const auto name = std::find(names.begin(), names.end(), section.at("algorithm").string);
  settings.algorithm = static_cast<NloptAlgorithm>(name - names.begin());
  settings.walk.max_iterations = integer(section, "max_iterations");
  settings.walk.max_evaluations = integer(section, "max_evaluations");
  settings.memory = static_cast<unsigned>(integer(section, "memory"));
  settings.walk.tolerance = section.at("tolerance").number;
  settings.walk.constraint_tolerance = section.at("constraint_tolerance").number;
  settings.initial_step = section.at("initial_step").number;
  settings.min_step = section.at("min_step").number;
  if (settings.min_step * 10.0 > settings.initial_step) {
    problems.add(section.at("min_step"), "min_step must be at most a tenth of initial_step");
    return nullptr;
  }
  return std::make_unique<NloptOptimizer>(settings);
}

}  // namespace hauberk
