#include "document/field_helpers.hpp"
#include "equilibrium/locking.hpp"
#include "rotation.hpp"
#include "values.hpp"
#include "weave.hpp"

#include <hauberk/experiment/fields.hpp>
#include <hauberk/experiment/task_format.hpp>
#include <hauberk/experiment/union_shape.hpp>

#include <algorithm>

namespace hauberk {

using namespace fields;

namespace {

std::vector<std::string> contact_names()
{
  std::vector<std::string> out;
  for (const auto& [name, choice] : contact_choices) out.emplace_back(name);
  return out;
}

Field elements_field()
{
  Field parameters =
      map("parameters", "Values of the shape's parameters by name; the others keep the shape's defaults.",
          number("parameter", "Value of one parameter.", "as declared by the shape"));
  Field element =
      object("element", "One kind of element.",
             {required(string("shape", "Plugin that turns parameters into primitives, or union.")),
              with_default(std::move(parameters), "{}")});
  Field elements = map("elements", "The kinds of elements, by name. Needed unless cell.weave brings them.",
                       std::move(element));
  elements.min_items = 1;
  return elements;
}

Field place_field()
{
  Field overrides = map("parameters", "Values for this placement only, over those of the element.",
                        number("parameter", "Value of one parameter.", "as declared by the shape"));
  Field entry = object("placement", "One placed element.",
                       {required(string("element", "Name of an entry of elements.")),
                        required(in_unit(numbers("position", "Place of the element's origin.", 3), "length")),
                        rotation_field("element"), std::move(overrides)});
  Field place = list("place", "What is in the cell, before it is repeated. Needed unless weave brings it.",
                     std::move(entry));
  place.min_items = 1;
  return place;
}

Field patch_field()
{
  Field outline = object("outline", "Which cells belong to the patch; exactly one of these.",
                         {at_least(number("disk", "Radius of a disk.", "length"), 0.0, true),
                          at_least(integer("hexagon", "Rings of cells around the middle one."), 0),
                          integers("rectangle", "Cells along both vectors.", 2, 1)});
  return object(
      "patch",
      "A finite patch instead of vectors and repeat, laid out so that the mean of its elements is above the "
      "origin.",
      {vectors_field("vectors", "The two vectors that the patch is laid out with; of a weave its own.", 2, 2),
       required(std::move(outline)),
       with_default(integers("tile", "Period, in cells, with which element parameters repeat.", 2, 1),
                    "[1, 1]")});
}

Field strip_field()
{
  return object(
      "strip",
      "A strip without end instead of a sheet: of the cell's two vectors one lattice vector is left, which "
      "is turned to x, the axis of a roll, and rows of cells beside each other, their mean above the origin.",
      {with_default(
           integers("axis",
                    "The lattice vector along the strip: so many of the first vector and of the second.", 2,
                    -1000),
           "[1, 0]"),
       required(at_least(integer("rows", "Cells across the strip."), 1))});
}

Field cell_field()
{
  return required(object(
      "cell", "What is simulated: a periodic cell, or a finite patch.",
      {vectors_field("vectors",
                     "The two lattice vectors (x, y) of the cell before it is repeated; three (x, y, z) for "
                     "load cases of solids, one (x) for those of strips.",
                     1, 3),
       with_default(
           at_least_items(
               integers("repeat", "m and n (and l): the m x n (x l) supercell becomes the cell.", 3, 1), 1),
           "[1, 1]"),
       patch_field(), strip_field(), place_field(), weave_field(),
       with_default(
           boolean("relax", "Allow a rest state that violates the clearance, to be relaxed before loading."),
           "false")}));
}

Field directions_field()
{
  Field list_of = at_least_items(
      list("list",
           "Components in the load case's unknowns: (exx, eyy, exy), or (A, B, C). Their lengths do not "
           "count.",
           any_numbers("direction", "Components, one for each unknown.")),
      1);
  Field parts = at_least(
      integer(
          "sphere",
          "Parts into which the edges of an icosahedron are divided: 10 n^2 + 2 directions, evenly over the "
          "sphere in the load case's metric, and the triangles between them."),
      1);
  parts.maximum = 32;
  return any_of(
      "directions",
      "Directions of the macroscopic unknowns instead of directions_deg, each with one sense, further "
      "along it: a list, or a sphere. The other unknowns are free. Not for designs.",
      {std::move(list_of),
       object("sampling", "An even sampling of all directions.", {required(std::move(parts))})});
}

Field load_case_field()
{
  return required(object(
      "load_case", "How the fabric is loaded, and which value is reported.",
      {required(string("plugin", "Plugin that defines the load.")),
       in_unit(
           any_numbers("directions_deg",
                       "Directions of loading, modulo 180. A design uses them for its final profile; absent "
                       "there, the directions of its targets are used."),
           "degree"),
       directions_field(),
       at_least_items(list("senses",
                           "Senses to load in, as the load case names them; absent: both. Not with "
                           "directions.",
                           string("sense", "stretch or compress, up or down.")),
                      1)}));
}

Field solver_field()
{
  return with_default(
      object(
          "solver", "How limits are computed.",
          {with_default(choice("preset", "Goal of the settings that are not given.", {"accurate", "paper"}),
                        "\"accurate\""),
           with_default(at_least(number("clearance", "Surface distance at which surfaces count as touching.",
                                        "length"),
                                 0.0),
                        "0"),
           with_default(
               choice(
                   "contact",
                   "Contact formulation; auto: arc, then nearest, with solids that are probed over their "
                   "surface nearest, with preset paper published; for comparison, mesh: of triangle meshes, "
                   "what others compute, and constrained: gaps as constraints of sequential quadratic "
                   "programs, without energy or certificate.",
                   contact_names()),
               "\"auto\""),
           at_most(at_least(integer("facets",
                                    "Of contact mesh: every primitive is a mesh of facets x facets "
                                    "quadrilaterals, each of two triangles; absent: 20."),
                            3),
                   1000),
           choice("closest_points",
                  "How closest points of contact published are found: certified, or from samples; absent: "
                  "as the preset says.",
                  {"certified", "sampled"}),
           choice("ccd",
                  "Collision check along steps: certified, or from samples; absent: as the preset says.",
                  {"certified", "sampled"}),
           at_least(number("finite_target",
                           "T of the published objective, half the squared distance of the macroscopic "
                           "unknowns to T times the load; absent: as the preset says.",
                           "1"),
                    0.0, true),
           with_default(
               at_least(integer("starts",
                                "Perturbed starts per limit; those of loads that push small periodic cells "
                                "together, such as compressions and shears along components, have at "
                                "least 32, those that stretch sheets of small cells at least 2."),
                        1),
               "1"),
           with_default(
               at_least(number("perturbation",
                               "Size of the random displacement of the first start, in characteristic "
                               "lengths and radians; further starts take at least 0.1.",
                               "1"),
                        0.0),
               "0.01"),
           with_default(
               boolean("lessons",
                       "Whether limits learn from each other, from symmetric images, from the loads beside "
                       "their own and from scenes that theirs contains, and compressions have many starts "
                       "and random loads; false: each stands alone."),
               "true"),
           with_default(
               at_least(
                   number(
                       "neighbours",
                       "On each side without another of its sense within this many degrees a limit at an "
                       "angle learns from one that far, which is not reported; a compression also from one "
                       "at half of that, likewise, a stretch of a sheet also from the compression across. "
                       "0: none.",
                       "degree"),
                   0.0),
               "20"),
           with_default(
               at_least(
                   integer("tilts",
                           "Random loads beside its own under which each limit is locked; it learns from "
                           "their states."),
                   0),
               "0"),
           with_default(
               at_least(number("tilt", "Angle between such a load and the limit's own.", "degree"), 0.0),
               "20"),
           seed_field("start_seed", "Seed of the first perturbed start; absent: seed."),
           at_least(integer("max_stages", "Most stages of falling stiffness; absent: as the preset says."),
                    1),
           at_least(integer("max_iterations",
                            "Most Newton steps of one stage in which the energy does not fall noticeably; "
                            "absent: as the preset says."),
                    1),
           at_least(
               number("tolerance", "Relative error of 1 + value to reach; absent: as the preset says.", "1"),
               0.0, true)}),
      "{}");
}

Field expect_field()
{
  Field entry =
      object("expectation", "A value the results must hold.",
             {required(string("pointer", "JSON pointer into results.json.")),
              any("value", "Expected value; numbers may deviate by rel or abs, anything else must be equal."),
              at_least(number("rel", "Allowed deviation, relative to value.", "1"), 0.0),
              at_least(number("abs", "Allowed deviation.", "as the value"), 0.0),
              number("min", "Smallest allowed number.", "as the value"),
              number("max", "Largest allowed number.", "as the value")});
  return with_default(
      list(
          "expect",
          "Checked after a run; one that fails makes it exit with 1. Emptied where --set makes another experiment "
          "of the file: of anything but its labels, the seed, and how solver or design search.",
          std::move(entry)),
      "[]");
}

}  // namespace

Field experiment_fields(TaskFormats formats)
{
  std::vector<std::string> tasks{"limits"};
  std::vector<Field> sections;
  for (const TaskFormat& task : formats) {
    tasks.emplace_back(task.name);
    sections.push_back(task.field());
  }
  Field root = object(
      "experiment", "A Hauberk experiment.",
      {string("$schema", "Place of the schema file, for editors."),
       string(
           "extends",
           "Another experiment that this one is, but for what it says itself: a path relative to this file. "
           "Objects are joined key by key, null takes a key away, anything else replaces what was there. "
           "The other's name, description and expect are not taken over; paths in it are seen from here."),
       required(string("name", "Name of the experiment.")), string("description", "What it shows."),
       with_default(choice("task", "What is computed.", std::move(tasks)), "\"limits\""),
       with_default(choice("length_unit",
                           "What lengths in this file mean; a label in everything that is written, and "
                           "what preset paper, whose lengths are absolute, converts by.",
                           {"m", "mm", "um"}),
                    "\"mm\""),
       values_field(), with_default(seed_field("seed", "Seed of everything random."), "1"), elements_field(),
       cell_field(), load_case_field(), solver_field()});
  for (Field& section : sections) root.children.push_back(std::move(section));
  root.children.push_back(expect_field());
  return root;
}

std::optional<PluginSection> plugin_section(const Field& object)
{
  if (object.name == "element") return PluginSection{PluginKind::shape, "shape"};
  if (object.name == union_part_field) return PluginSection{PluginKind::shape, "shape"};
  if (object.name == "load_case") return PluginSection{PluginKind::load_case, "plugin"};
  if (object.name == "optimizer") return PluginSection{PluginKind::optimizer, "plugin"};
  return std::nullopt;
}

}  // namespace hauberk
