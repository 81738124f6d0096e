#include "document/field_helpers.hpp"
#include "tasks/transition/transition_section.hpp"

namespace hauberk {

using namespace fields;

namespace {

Field rotation_field()
{
  Field degrees = in_unit(numbers("degrees", "Angle at the start and at the end of the path.", 2), "degree");
  return object(
      "rotation", "Rotation about a line, from rest.",
      {required(numbers("axis", "Direction of the line; normalised.", 3)), required(std::move(degrees)),
       in_unit(numbers("through", "A point of the line; absent: the moving element's origin.", 3),
               "length")});
}

Field translation_field()
{
  return object(
      "translation", "Translation from rest, after the rotation.",
      {with_default(in_unit(numbers("from", "At the start of the path.", 3), "length"), "[0, 0, 0]"),
       with_default(in_unit(numbers("to", "At its end.", 3), "length"), "[0, 0, 0]")});
}

Field path_field()
{
  return object(
      "path", "A rigid motion of the moving element; rotation and translation are linear in time.",
      {required(string("name", "Name in tables and pictures.")), rotation_field(), translation_field(),
       with_default(at_least(integer("steps", "Steps at which it is looked at."), 2), "200")});
}

}  // namespace

Field transition_field()
{
  Field contacts = at_least_items(list("contacts", "Contact formulations to compare, as in solver.contact.",
                                       choice("contact", "", {"nearest", "published", "arc", "auto"})),
                                  1);
  return object(
      "transition",
      "Contact of two placed elements, their images left out, while one of them moves: nearest points, "
      "eigenvalues, energy, force, and how far these jump. Needed by task transition.",
      {with_default(at_least(integer("fixed", "The element that stays, by its number in the cell."), 0), "0"),
       with_default(at_least(integer("moving", "The element that moves, likewise."), 0), "1"),
       required(at_least(
           number("activation_distance", "Gap below which surfaces repel each other.", "length"), 0.0, true)),
       at_least(number("range",
                       "Local minima of the distance below this are listed; absent: three activation "
                       "distances above the clearance.",
                       "length"),
                0.0, true),
       with_default(std::move(contacts), "[\"nearest\", \"published\", \"arc\", \"auto\"]"),
       required(at_least_items(list("paths", "The motions.", path_field()), 1))});
}

}  // namespace hauberk
