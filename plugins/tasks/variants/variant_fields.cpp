#include "tasks/variants/variant_fields.hpp"

#include "document/field_helpers.hpp"

namespace hauberk {

using namespace fields;

Field set_field(const std::string& doc)
{
  return with_default(
      map("set", doc, any("value", "Replaces what is at the place; a whole section or a single value.")),
      "{}");
}

Field vary_field(const std::string& each)
{
  Field one = string("pointer", "One place.");
  Field several = at_least_items(
      list("pointer", "Several places that get the same value.", string("pointer", "A place.")), 1);
  Field entry = object(
      "vary", "What differs between the " + each + "s.",
      {required(any_of("pointer", "JSON pointer into the experiment.", {one, several})),
       required(at_least_items(list("values", "A value per " + each + ".", any("value", "A value.")), 1))});
  return at_least_items(
      list("vary", "The " + each + "s: " + each + " k has value k of every entry, so all are equally long.",
           std::move(entry)),
      1);
}

Field labels_field(const std::string& each)
{
  return list("labels", "Names of the " + each + "s; absent: the values of the first entry of vary.",
              string("label", "A name."));
}

}  // namespace hauberk
