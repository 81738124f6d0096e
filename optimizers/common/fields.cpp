#include "fields.hpp"

#include <utility>

namespace hauberk {
namespace {

constexpr double most_evaluations = 1e9;

Field field(std::string name, Field::Kind kind, std::string default_json, std::string doc)
{
  Field result;
  result.name = std::move(name);
  result.kind = kind;
  result.default_json = std::move(default_json);
  result.doc = std::move(doc);
  return result;
}

}  // namespace

Field count_field(std::string name, std::string default_json, double largest, std::string doc)
{
  Field result = field(std::move(name), Field::Kind::integer, std::move(default_json), std::move(doc));
  result.minimum = 0.0;
  result.maximum = largest;
  return result;
}

Field fraction_field(std::string name, std::string default_json, std::string doc)
{
  Field result = field(std::move(name), Field::Kind::number, std::move(default_json), std::move(doc));
  result.minimum = 0.0;
  result.exclusive_minimum = true;
  result.maximum = 1.0;
  return result;
}

Field choice_field(std::string name, std::vector<std::string> choices, std::string doc)
{
  Field result = field(std::move(name), Field::Kind::choice, "\"" + choices.front() + "\"", std::move(doc));
  result.choices = std::move(choices);
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

int integer(const Node& section, std::string_view name) { return static_cast<int>(section.at(name).number); }

}  // namespace hauberk
