#include "document/field_helpers.hpp"
#include "tasks/stability/stability_section.hpp"
#include "tasks/variants/variant_fields.hpp"

namespace hauberk {

using namespace fields;

namespace {

Field method_field()
{
  return object(
      "method", "A way of solving. A new one needs no code.",
      {required(string("name", "Name in tables and pictures.")),
       set_field("What it sets, by JSON pointer, after the family: {\"/solver/contact\": \"arc\"}.")});
}

Field family_field()
{
  return object(
      "family", "Variants of one scene, from easy to hard.",
      {required(string("name", "Name in tables and pictures.")), string("why", "What makes it hard."),
       set_field(
           "What makes the family's scene out of this experiment, by JSON pointer; whole sections too."),
       required(vary_field("member")), labels_field("member"),
       list("exact", "Exact values of the members, where they are known; else null.",
            any("value", "A number or null.")),
       with_default(
           boolean("solvable", "There is a locked state to find. False: any value that is claimed is wrong."),
           "true")});
}

}  // namespace

Field stability_field()
{
  return object(
      "stability",
      "Families of scenes times methods. Each is solved, checked independently, and classified: verified, "
      "local (a further state is known), honest failure, silently wrong. Needed by task stability.",
      {with_default(
           at_least(number("tolerance",
                           "A value is at the best known state when 1 + value falls short of it by no more "
                           "than this fraction and what closing its remaining gaps would gain.",
                           "1"),
                    0.0, true),
           "1e-6"),
       required(at_least_items(list("methods", "The ways of solving.", method_field()), 1)),
       required(at_least_items(list("families", "The scenes.", family_field()), 1))});
}

}  // namespace hauberk
