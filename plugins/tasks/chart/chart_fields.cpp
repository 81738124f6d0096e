#include "document/field_helpers.hpp"
#include "tasks/chart/chart_section.hpp"
#include "tasks/variants/variant_fields.hpp"

namespace hauberk {

using namespace fields;

namespace {

constexpr double most_threads = 4096.0;

Field scene_field()
{
  Field one = number("exact", "Of the only limit.", "as the value");
  Field several = at_least_items(
      list("exact", "One per limit; null: not compared.", any("value", "A number or null.")), 1);
  return object(
      "scene", "A scene whose limits are known. Either exact or reference says how.",
      {required(string("name", "Name in tables and pictures.")),
       set_field("What makes the scene out of this experiment, by JSON pointer; whole sections too."),
       any_of("exact",
              "Known values: a number where there is one limit, else a list with one per limit; null: not "
              "compared.",
              {std::move(one), std::move(several)}),
       object("reference",
              "Settings of a solve of higher accuracy, made once and not timed; its values count as exact, "
              "its error estimates are recorded.",
              {set_field("What it sets, by JSON pointer, after the scene.")})});
}

Field method_field()
{
  return object("method", "A way of solving: a line in each picture, a point per setting.",
                {required(string("name", "Name in tables and pictures.")),
                 set_field("What it sets, by JSON pointer, after the scene: {\"/solver/contact\": \"arc\"}."),
                 vary_field("setting"), labels_field("setting"),
                 at_least_items(list("scenes", "Names of the scenes that it solves; absent: all.",
                                     string("scene", "Name of an entry of scenes.")),
                                1)});
}

}  // namespace

Field chart_field()
{
  Field threads = at_least(integer("count", "A number of threads; 0: as many as there are processors."), 0.0);
  threads.maximum = most_threads;
  return object(
      "chart",
      "Error against time: scenes with known limits times methods times settings, each solved several times. "
      "Needed by task chart.",
      {with_default(at_least(integer("repeats", "Timed runs of a point; the median counts."), 1), "3"),
       required(at_least_items(list("scenes", "The scenes, a panel each.", scene_field()), 1)),
       required(at_least_items(list("methods", "The ways of solving.", method_field()), 1)),
       with_default(at_least_items(list("threads",
                                        "Each point is timed with each of these numbers of threads; pictures "
                                        "show the first.",
                                        std::move(threads)),
                                   1),
                    "[1]")});
}

}  // namespace hauberk
