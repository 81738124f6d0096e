#pragma once
/// Short constructors that keep the table of fields readable.

#include <hauberk/kit/fields.hpp>

#include <string>
#include <vector>

namespace hauberk::fields {

inline Field make(std::string name, Field::Kind kind, std::string doc, std::string unit = "")
{
  Field field = kit::field(kind, std::move(name), "", std::move(doc));
  field.unit = std::move(unit);
  return field;
}

inline Field number(std::string name, std::string doc, std::string unit)
{
  return make(std::move(name), Field::Kind::number, std::move(doc), std::move(unit));
}
inline Field integer(std::string name, std::string doc)
{
  Field field = make(std::move(name), Field::Kind::integer, std::move(doc));
  field.minimum = -2147483648.0;  // what an int holds
  field.maximum = 2147483647.0;
  return field;
}
inline Field boolean(std::string name, std::string doc)
{
  return make(std::move(name), Field::Kind::boolean, std::move(doc));
}
inline Field string(std::string name, std::string doc)
{
  return make(std::move(name), Field::Kind::string, std::move(doc));
}
inline Field any(std::string name, std::string doc)
{
  return make(std::move(name), Field::Kind::any, std::move(doc));
}

inline Field choice(std::string name, std::string doc, std::vector<std::string> choices)
{
  Field field = make(std::move(name), Field::Kind::choice, std::move(doc));
  field.choices = std::move(choices);
  return field;
}

/// Exactly `count` numbers.
inline Field numbers(std::string name, std::string doc, std::size_t count)
{
  Field field = make(std::move(name), Field::Kind::numbers, std::move(doc));
  field.min_items = field.max_items = count;
  return field;
}

/// One number or more.
inline Field any_numbers(std::string name, std::string doc)
{
  Field field = make(std::move(name), Field::Kind::numbers, std::move(doc));
  field.min_items = 1;
  return field;
}

inline Field list(std::string name, std::string doc, Field item)
{
  Field field = make(std::move(name), Field::Kind::list, std::move(doc));
  field.children.push_back(std::move(item));
  return field;
}

inline Field map(std::string name, std::string doc, Field value)
{
  Field field = make(std::move(name), Field::Kind::map, std::move(doc));
  field.children.push_back(std::move(value));
  return field;
}

inline Field object(std::string name, std::string doc, std::vector<Field> members)
{
  Field field = make(std::move(name), Field::Kind::object, std::move(doc));
  field.children = std::move(members);
  return field;
}

inline Field any_of(std::string name, std::string doc, std::vector<Field> options)
{
  Field field = make(std::move(name), Field::Kind::any_of, std::move(doc));
  field.children = std::move(options);
  return field;
}

inline Field required(Field field)
{
  field.required = true;
  return field;
}

inline Field with_default(Field field, std::string json)
{
  field.default_json = std::move(json);
  return field;
}

inline Field in_unit(Field field, std::string unit)
{
  field.unit = std::move(unit);
  return field;
}

inline Field at_least(Field field, double minimum, bool exclusive = false)
{
  field.minimum = minimum;
  field.exclusive_minimum = exclusive;
  return field;
}

inline Field at_most(Field field, double maximum)
{
  field.maximum = maximum;
  return field;
}

inline Field at_least_items(Field field, std::size_t count)
{
  field.min_items = count;
  return field;
}

/// Exactly `count` integers >= minimum.
inline Field integers(std::string name, std::string doc, std::size_t count, double minimum)
{
  Field field = list(std::move(name), std::move(doc), at_least(integer("count", "A whole number."), minimum));
  field.min_items = field.max_items = count;
  return field;
}

/// So many vectors of so many numbers: from one along x to three in space.
inline Field vectors_field(std::string name, std::string doc, std::size_t least, std::size_t most)
{
  Field vector = numbers("vector", most == 2 ? "x and y." : "x; x and y; or x, y and z.", most);
  vector.min_items = least;
  Field field = list(std::move(name), std::move(doc), in_unit(std::move(vector), "length"));
  field.min_items = least;
  field.max_items = most;
  return in_unit(std::move(field), "length");
}

/// Whole numbers that a double holds exactly.
inline Field seed_field(std::string name, std::string doc)
{
  Field field = at_least(integer(std::move(name), std::move(doc)), 0.0);
  field.maximum = 9007199254740991.0;  // 2^53 - 1
  return field;
}

}  // namespace hauberk::fields
