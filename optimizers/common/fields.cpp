#include "fields.hpp"

#include <utility>

namespace hauberk {
namespace {

constexpr double most_evaluations = 1e9;

}  // namespace

Field count_field(std::string name, std::string default_json, double largest, std::string doc)
{
  return kit::integer_field(std::move(name), std::move(default_json), 0.0, largest, std::move(doc));
}

Field fraction_field(std::string name, std::string default_json, std::string doc)
{
  Field result = kit::number_field(std::move(name), std::move(default_json), 0.0, 1.0, std::move(doc));
  result.exclusive_minimum = true;
  return result;
}

Field max_evaluations_field()
{
  return count_field("max_evaluations", "100000", most_evaluations,
                     "Evaluations of the objective after which to stop; the start is always evaluated.");
}

Field tolerance_field()
{
  return fraction_field("tolerance", "1e-6",
                        "Decrease and optimality below which to stop, relative to the objective.");
}

Field constraint_tolerance_field()
{
  return fraction_field("constraint_tolerance", "1e-8", "Violation of a constraint that counts as none.");
}

Field min_step_field()
{
  return fraction_field("min_step", "1e-7",
                        "Shortest step worth an evaluation, as part of a variable's range.");
}

Field seed_field()
{
  return count_field("seed", "1", 4294967295.0, "Seed of all draws; the same one gives the same run.");
}

}  // namespace hauberk
