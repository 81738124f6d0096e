#include "document/field_helpers.hpp"
#include "tasks/sweep/sweep_section.hpp"

namespace hauberk {

using namespace fields;

namespace {

Field vary_field()
{
  Field scaled = object("pointer", "A place that gets factor times value plus offset.",
                        {required(string("pointer", "JSON pointer into the experiment.")),
                         with_default(number("factor", "Factor of the value.", "1"), "1"),
                         with_default(number("offset", "What is added.", "as the place"), "0")});
  Field range = object(
      "range", "Numbers evenly spaced, both ends included.",
      {required(number("from", "First value.", "as the place")),
       required(number("to", "Last value.", "as the place")),
       required(at_least(integer("count", "How many."), 2)),
       with_default(choice("scale", "Evenly spaced themselves, or their logarithms.", {"linear", "log"}),
                    "\"linear\"")});
  return object(
      "vary", "A quantity that is varied.",
      {required(string("name", "Name in tables and pictures.")),
       required(at_least_items(
           list("pointers", "The places that it goes to; they move together.",
                any_of("pointer", "A place.",
                       {string("pointer", "JSON pointer into the experiment; gets the value itself."),
                        std::move(scaled)})),
           1)),
       at_least_items(list("values", "The values.", any("value", "A value.")), 1), std::move(range)});
}

}  // namespace

Field sweep_field()
{
  Field measure = object(
      "measure", "A quantity to record.",
      {required(string("name", "Name in tables and pictures.")),
       required(string("pointer", "JSON pointer into the results of a row, such as /profiles/0/eta."))});
  return object(
      "sweep",
      "Limits of this experiment with other values in it: every combination of the values is a row of one "
      "table. Needed by task sweep.",
      {required(at_least_items(list("vary",
                                    "What is varied; of several every combination is a row, the last "
                                    "the fastest. The first is the axis of the picture.",
                                    vary_field()),
                               1)),
       at_least_items(list("measure", "What is recorded of every row; absent: the value of every limit.",
                           std::move(measure)),
                      1)});
}

}  // namespace hauberk
