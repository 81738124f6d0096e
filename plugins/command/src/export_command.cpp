#include "dispatch.hpp"
#include "document/atomic_file.hpp"
#include "export_formats.hpp"
#include "geometry/joined.hpp"
#include "opened_fabric.hpp"
#include "option_numbers.hpp"
#include "say.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

namespace hauberk::command {
namespace {

namespace fs = std::filesystem;
using namespace exporting;

std::array<int, 3> repeat_of(const Options& options)
{
  std::array<int, 3> repeat{1, 1, 1};
  if (!options.has("repeat")) return repeat;
  const std::vector<int> counts = counts_of(options, "repeat", 1000, "3,2");
  if (counts.size() > 3) throw UsageError("--repeat: expected two or three numbers", options.usage());
  for (std::size_t k = 0; k < counts.size(); ++k) repeat[k] = counts[k];
  return repeat;
}

std::optional<Outline> outline_of(const Options& options)
{
  if (!options.has("outline")) return std::nullopt;
  const auto& text = options.get<std::string>("outline");
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::vector<double> sizes =
      colon == std::string::npos ? std::vector<double>{} : numbers_in(text.substr(colon + 1));
  if (kind == "disk" && sizes.size() == 1 && sizes[0] > 0.0) return Outline{sizes[0], {}};
  if (kind == "rectangle" && sizes.size() == 2 && sizes[0] > 0.0 && sizes[1] > 0.0)
    return Outline{0.0, {0.5 * sizes[0], 0.5 * sizes[1]}};
  throw UsageError(fmt::format("--outline {}: expected disk:RADIUS or rectangle:A,B", text), options.usage());
}

/// Refuses copies that are nearer than asked for. What differs from that in digits that are not printed is as
/// asked for: a rest state keeps its clearance to the accuracy of its search.
void require_gap(const Assembly& assembly, const std::optional<Nearest>& nearest, double wanted)
{
  constexpr double unseen = 5e-6;  // of what is wanted
  if (!(wanted > 0.0) || !nearest || nearest->distance >= (1.0 - unseen) * wanted) return;
  throw ComputationError(fmt::format(
      "--require-gap {:g}: {} and {} are {}{:.6g} {} apart in this state; make the wire thinner or the rings wider by "
      "the difference, `hauberk room` says by how much, or export another state",
      wanted, nearest->names[0], nearest->names[1], nearest->known ? "" : "not known to be more than ",
      std::max(0.0, nearest->distance), assembly.unit));
}

/// A line for every shape of which not all primitives hang together.
std::vector<std::string> loose_parts(const Assembly& assembly)
{
  std::vector<std::string> out;
  for (std::size_t k = 0; k < assembly.primitives.size(); ++k) {
    const std::size_t parts = joined_primitives(assembly.primitives[k]).size();
    const auto copy = std::ranges::find_if(
        assembly.copies, [k](const Assembly::Copy& one) { return static_cast<std::size_t>(one.mesh) == k; });
    if (parts > 1 && copy != assembly.copies.end())
      out.push_back(
          fmt::format("{} and its like are of {} bodies each that nothing joins\n", copy->name, parts));
  }
  return out;
}

/// What a person who prints it wants to know.
std::string summary(const Assembly& assembly, const std::optional<Nearest>& nearest)
{
  std::size_t triangles = 0;
  constexpr double none = std::numeric_limits<double>::infinity();
  double total = 0.0, thin = none;
  Vec3 lowest = Vec3::Constant(none), highest = -lowest;
  for (const auto& copy : assembly.copies) {
    const Mesh& mesh = assembly.meshes[copy.mesh];
    triangles += mesh.triangles.size();
    total += volume(mesh);
    for (const Vec3& x : mesh.points) {
      const Vec3 placed = copy.pose.position + copy.pose.rotation * x;
      lowest = lowest.cwiseMin(placed);
      highest = highest.cwiseMax(placed);
    }
  }
  for (const auto& primitives : assembly.primitives) thin = std::min(thin, wire_radius(primitives));
  const std::string& unit = assembly.unit;
  std::string text = fmt::format("{} of {}: {} elements, {} triangles, volume {:.6g} {}^3\n", assembly.state,
                                 assembly.name, assembly.copies.size(), triangles, total, unit);
  const Vec3 size = highest - lowest;
  text +=
      fmt::format("{:.6g} x {:.6g} x {:.6g} {}, thinnest wire {:.6g} {} across, lowest point z = {:.6g} {}\n",
                  size.x(), size.y(), size.z(), unit, 2.0 * thin, unit, lowest.z(), unit);
  for (const std::string& line : loose_parts(assembly)) text += line;
  if (!nearest) return text + "no two elements are near each other\n";
  text += fmt::format("smallest gap {}{:.6g} {}: {} and {}\n", nearest->known ? "" : "at least ",
                      std::max(0.0, nearest->distance), unit, nearest->names[0], nearest->names[1]);
  constexpr double touching = 1e-3;  // of the wire
  if (nearest->known && nearest->distance < touching * thin)
    text += "elements touch in this state: a printer fuses them; --require-gap refuses that\n";
  return text;
}

}  // namespace

Description export_description()
{
  return {
      .name = "export",
      .form = fmt::format("FILE.json -o OUT.{{{}}} [--state S]", export_endings_between_commas()),
      .line = "a fabric to print, to look at or to compute with",
      .synopsis = "export FILE.json -o OUT [options]",
      .summary = fmt::format(
          "Writes the elements of an experiment or of results (or of a folder of results) as closed "
          "surfaces, in the format that the file's name ends in: {}. PNG is a picture, HTML a page that "
          "shows all states, to be turned by hand.",
          export_endings()),
      .more =
          "Primitives of one element that overlap become one surface. What is said of gaps is certified, and "
          "is that of the exact surfaces, not of their triangles.",
      .arguments = {{.name = "FILE.json", .offer = Offer::results}},
      .options = joined(
          {{.name = "output",
            .letter = 'o',
            .takes = Takes::text,
            .value = "OUT",
            .help = "the file to write; its ending says in which format",
            .offer = Offer::files},
           {.name = "force", .help = "replace a file of that name"},
           {.name = "state",
            .takes = Takes::text,
            .value = "S",
            .help =
                "`rest` (default), of results `limit:K` or SENSE:DEGREES, as `stretch:90`, `initial` or `final` of a "
                "design"},
           {.name = "row",
            .takes = Takes::integer,
            .value = "K",
            .help = "of results of a sweep: its K-th row, counted from 0 in the order of sweep.csv"},
           {.name = "repeat",
            .takes = Takes::text,
            .value = "M,N",
            .help =
                "copies of the cell along its vectors; default 1, of a page about two dozen elements, with "
                "--outline as many as fill it"},
           {.name = "outline",
            .takes = Takes::text,
            .value = "SHAPE",
            .help = "keep elements whose middle is within `disk:RADIUS` or `rectangle:A,B` at rest"},
           {.name = "chord",
            .takes = Takes::real,
            .value = "X",
            .help =
                "how far triangles may leave the surface; default a fortieth of the thinnest wire's radius"},
           {.name = "require-gap",
            .takes = Takes::real,
            .value = "X",
            .help = "write nothing if two elements are nearer than this"},
           {.name = "separate",
            .help = "of .3mf: an object for each kind of element and an item for each copy, which slicers "
                    "lay on the bed one by one; default: one object, so that what is linked stays so"},
           {.name = "forces",
            .help = "with `--state` of a limit, of .vtu: contact points with their forces and gaps"},
           {.name = "view",
            .takes = Takes::text,
            .value = "V",
            .help = "of a picture: `top`, `front`, `side`, `iso` (default), or AZIMUTH,ELEVATION in degrees"},
           {.name = "size", .takes = Takes::text, .value = "W,H", .help = "of a picture; default 800,600"},
           {.name = "scale",
            .takes = Takes::real,
            .value = "X",
            .help = "of a picture: pixels per unit of length, as pictures to be compared have to have it; "
                    "default: all of it fits"}},
          experiment_options())};
}

int export_command(const std::vector<std::string>& words)
{
  Options options(export_description());
  options.parse(words);
  if (!options.has("output"))
    throw UsageError(fmt::format("--output: expected a file that ends in {}", export_endings()),
                     options.usage());
  const fs::path file = options.get<std::string>("output");
  const ExportFormat& format = export_format_of(file.string(), options);
  const std::array<int, 3> repeat = repeat_of(options);
  const std::optional<Outline> outline = outline_of(options);
  const double chord = positive(options, "chord"), gap = positive(options, "require-gap");
  if (!options.has("force"))
    refuse_existing_file(file, "give another name with -o, or --force, which replaces it");
  refuse_options_of_others(format, options);
  const Opened opened = open_fabric(options);
  auto cells = repeat;
  if (!options.has("repeat") && outline)
    cells = cells_that_fill(opened.fabric, *outline);
  else if (!options.has("repeat") && format.shows_all_states)
    cells = shown_cells(opened.fabric);
  const Assembly assembly = assemble(opened.fabric, cells, outline, chord);
  const auto nearest = nearest_copies(assembly, std::numeric_limits<double>::infinity());
  require_gap(assembly, nearest, gap);
  const std::string content = format.content({opened, assembly, {cells, outline, chord, {}}, options});
  if (options.has("force"))
    write_files_atomically(file.has_parent_path() ? file.parent_path() : ".",
                           {{file.filename().string(), content}}, {});
  else
    write_new_file_atomically(file, content);
  say("{}written to {}\n", summary(assembly, nearest), file.string());
  return exit_done;
}

}  // namespace hauberk::command
