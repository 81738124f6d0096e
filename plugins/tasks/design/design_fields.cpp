#include "document/field_helpers.hpp"
#include "tasks/design/design_section.hpp"

namespace hauberk {

using namespace fields;

namespace {

/// What `hauberk report` prints beside a design; no computation reads it.
Field published_field()
{
  return object(
      "published", "What a publication reports of this design, for `hauberk report`; it is never used.",
      {required(string("source", "Where it stands.")),
       number("lowest", "Smallest value reached, where only a range is published.", "as the quantity"),
       number("highest", "Largest value reached, where only a range is published.", "as the quantity"),
       at_least(integer("iterations", "Iterations that were needed."), 1),
       at_least(number("seconds_per_iteration", "Time of an iteration.", "s"), 0.0, true),
       list("profile", "Its profile, drawn behind the design's.",
            numbers("point", "Direction in degrees, and value.", 2)),
       list("measured", "Ranges measured of samples, drawn as bars.",
            numbers("range", "Direction in degrees, smallest and largest value.", 3))});
}

}  // namespace

Field design_field()
{
  Field optimizer = object("optimizer", "What searches the design space.",
                           {required(string("plugin", "Plugin that minimises."))});
  Field name = string("parameters", "One parameter.");
  Field names = at_least_items(
      list("parameters", "Several parameters, a variable each.", string("parameter", "A name.")), 1);
  Field variable = object(
      "variable", "A group of design variables with the same bounds.",
      {required(any_of("parameters", "Parameters to vary, as the shapes name them.", {name, names})),
       with_default(
           choice("per", "One variable per placed element, per entry of elements, or for all of them.",
                  {"element", "type", "all"}),
           "\"element\""),
       with_default(boolean("tied", "Several parameters share one variable instead of having one each."),
                    "false"),
       required(number("lower", "Lower bound.", "as declared by the shape")),
       required(number("upper", "Upper bound.", "as declared by the shape"))});
  Field target = object(
      "target", "A value to reach in one direction, or a bound to keep.",
      {required(number("direction_deg", "Direction, modulo 180.", "degree")),
       required(number("value", "Value of the quantity to reach.", "as the quantity")),
       with_default(at_least(number("weight", "Weight of the squared residual.", "1"), 0.0, true), "1"),
       with_default(
           choice(
               "aim",
               "Reach the value, or keep it as a bound: end no further than it, or no nearer, further being "
               "away from zero. What keeps its bound adds nothing to the objective; a bound counts as met "
               "to within a thousandth. Two bounds in one direction are a band.",
               {"reach", "no_further", "no_nearer"}),
           "\"reach\""),
       number("published",
              "Value that a publication reached here. `hauberk report` prints it beside the result; it is "
              "never used.",
              "as the quantity")});
  return object(
      "design", "What is designed, and for which limits. Needed by task design.",
      {with_default(std::move(optimizer), "{\"plugin\": \"sqp\"}"),
       required(choice("quantity", "What the targets prescribe; eta is (e_s - e_c)/(1 + e_c).",
                       {"eta", "stretch", "compress", "curvature"})),
       required(at_least_items(
           list("variables", "What may change; parameters named by no entry are fixed.", variable), 1)),
       required(at_least_items(
           list("targets", "Values to reach; their directions are those of the design.", target), 1)),
       at_least(
           number(
               "hole_clearance",
               "Least clearance between a ring's hole and the cross-section threaded through it, for every "
               "linked pair; absent: solver.clearance.",
               "length"),
           0.0),
       at_least(number("rest_clearance",
                       "Least surface distance of every pair at rest; absent: solver.clearance.", "length"),
                0.0),
       with_default(
           at_least(
               integer("starts",
                       "Starting designs, the first one included: each is the given one moved at random."),
               1),
           "1"),
       with_default(
           at_least(number("perturbation",
                           "Size of the random change of a starting design, as a fraction of the distance "
                           "between the bounds; 0 starts from the design as given.",
                           "1"),
                    0.0),
           "0.02"),
       with_default(
           choice("value",
                  "What stands for a limit while the design is searched, as both tend to it: value minus "
                  "contact energy, whose gradient is explicit, or the plain value, with an adjoint one.",
                  {"less_contact", "plain"}),
           "\"less_contact\""),
       at_least(integer("max_iterations", "Most iterations; absent: as the optimizer says."), 0),
       at_least(number("tolerance",
                       "Stop once every target is met to within this fraction of it; absent: go on until "
                       "the optimizer stops.",
                       "1"),
                0.0, true),
       published_field()});
}

}  // namespace hauberk
