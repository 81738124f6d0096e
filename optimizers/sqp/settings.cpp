#include "sqp.hpp"

#include <utility>

namespace hauberk {
namespace {

Field positive(const char* name, const char* default_json, const char* doc, double maximum)
{
  Field field;
  field.name = name;
  field.kind = Field::Kind::number;
  field.doc = doc;
  field.unit = "1";
  field.default_json = default_json;
  field.minimum = 0.0;
  field.exclusive_minimum = true;
  field.maximum = maximum;
  return field;
}

}  // namespace

void sqp_fields(std::vector<Field>& out)
{
  Field iterations;
  iterations.name = "max_iterations";
  iterations.kind = Field::Kind::integer;
  iterations.doc = "Accepted steps after which to stop; 0 only evaluates the start.";
  iterations.default_json = "100";
  iterations.minimum = 0.0;
  iterations.maximum = 1e6;
  out.push_back(std::move(iterations));
  out.push_back(positive("tolerance", "1e-6",
                         "Decrease and optimality below which to stop, relative to the objective.", 1.0));
  out.push_back(
      positive("constraint_tolerance", "1e-8", "Violation of a constraint that counts as none.", 1.0));
  out.push_back(positive("initial_step", "0.05", "Longest first step, as part of a variable's range.", 1.0));
  out.push_back(positive("max_step", "0.5", "Longest step, as part of a variable's range.", 1.0));
  out.push_back(
      positive("min_step", "1e-7", "Shortest step worth an evaluation, as part of a variable's range.", 1.0));
}

std::unique_ptr<Optimizer> make_sqp(const Node& section, Problems& problems)
{
  SqpSettings settings;
  settings.max_iterations = static_cast<int>(section.at("max_iterations").number);
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
