#pragma once
/// Fields as optimizers declare them.

#include <hauberk/kit/fields.hpp>

#include <string>

namespace hauberk {

using kit::choice_field, kit::integer;

/// A whole number in [0, largest].
Field count_field(std::string name, std::string default_json, double largest, std::string doc);
/// A number in (0, 1].
Field fraction_field(std::string name, std::string default_json, std::string doc);

/// Fields that mean the same for every optimizer: `max_evaluations`, `tolerance`, `constraint_tolerance`,
/// `min_step`.
Field max_evaluations_field();
Field tolerance_field();
Field constraint_tolerance_field();
Field min_step_field();
/// `seed` of an optimizer that draws random numbers (OptimizerTraits).
Field seed_field();

}  // namespace hauberk
