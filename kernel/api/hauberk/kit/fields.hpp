#pragma once
/// Fields of a plugin's section, one line each.
///
///     void fields(std::vector<hauberk::Field>& out)
///     {
///       out = {kit::boolean_field("crossed", false, "Whether the second ring is turned."),
///              kit::number_field("tolerance", "1e-6", 0.0, 1.0, "Decrease at which to stop.")};
///     }
///
/// `doc` is one sentence. What is rarer (arrays, objects, open bounds, units) is set in the field that is
/// returned.

#include <hauberk/section.hpp>

#include <string>
#include <utility>
#include <vector>

namespace hauberk::kit {

/// A field of any kind with its default as JSON text; empty: none.
inline Field field(Field::Kind kind, std::string name, std::string default_json, std::string doc)
{
  Field result;
  result.name = std::move(name);
  result.kind = kind;
  result.doc = std::move(doc);
  result.default_json = std::move(default_json);
  return result;
}

inline Field boolean_field(std::string name, bool by_default, std::string doc)
{
  return field(Field::Kind::boolean, std::move(name), by_default ? "true" : "false", std::move(doc));
}

/// A number in [minimum, maximum].
inline Field number_field(std::string name, std::string default_json, double minimum, double maximum,
                          std::string doc)
{
  Field result = field(Field::Kind::number, std::move(name), std::move(default_json), std::move(doc));
  result.minimum = minimum;
  result.maximum = maximum;
  return result;
}

/// A whole number in [minimum, maximum].
inline Field integer_field(std::string name, std::string default_json, double minimum, double maximum,
                           std::string doc)
{
  Field result = number_field(std::move(name), std::move(default_json), minimum, maximum, std::move(doc));
  result.kind = Field::Kind::integer;
  return result;
}

/// One of `choices`, of which there is at least one; the first is the default.
inline Field choice_field(std::string name, std::vector<std::string> choices, std::string doc)
{
  Field result = field(Field::Kind::choice, std::move(name), "\"" + choices.at(0) + "\"", std::move(doc));
  result.choices = std::move(choices);
  return result;
}

/// The value of a field of whole numbers. Throws std::out_of_range where the section has none.
inline int integer(const Node& section, std::string_view name)
{
  return static_cast<int>(section.at(name).number);
}

}  // namespace hauberk::kit
