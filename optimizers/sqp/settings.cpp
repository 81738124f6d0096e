#include "sqp.hpp"

#include <utility>

namespace hauberk {
namespace {

Field field(std::string name, Field::Kind kind, std::string default_json, std::string doc)
{
  Field result;
  result.name = std::move(name);
  result.kind = kind;
  result.default_json = std::move(default_json);
  result.doc = std::move(doc);
  result.minimum = 0.0;
  return result;
}

/// A number in (0, 1].
Field fraction(std::string name, std::string default_json, std::string doc)
{
  Field result = field(std::move(name), Field::Kind::number, std::move(default_json), std::move(doc));
  result.exclusive_minimum = true;
  result.maximum = 1.0;
  return result;
}

}  // namespace

void sqp_fields(std::vector<Field>& out)
{
  Field iterations = field("max_iterations", Field::Kind::integer, "100",
                           "Accepted steps after which to stop; 0 only evaluates the start.");
  iterations.maximum = 1e6;
  out.push_back(std::move(iterations));
  Field hessian = field(
      "hessian", Field::Kind::choice, "\"gauss_newton\"",
      "Curvature of the model: Gauss-Newton where the problem is a sum of squares, or damped BFGS always.");
  hessian.choices = {"gauss_newton", "bfgs"};
  out.push_back(std::move(hessian));
  out.push_back(fraction("tolerance", "1e-6",
                         "Decrease and optimality below which to stop, relative to the objective."));
  out.push_back(fraction("constraint_tolerance", "1e-8", "Violation of a constraint that counts as none."));
  out.push_back(fraction("initial_step", "0.05", "Longest first step, as part of a variable's range."));
  out.push_back(fraction("max_step", "0.5", "Longest step, as part of a variable's range."));
  out.push_back(
      fraction("min_step", "1e-7", "Shortest step worth an evaluation, as part of a variable's range."));
}

std::unique_ptr<Optimizer> make_sqp(const Node& section, Problems& problems)
{
  SqpSettings settings;
  settings.max_iterations = static_cast<int>(section.at("max_iterations").number);
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
