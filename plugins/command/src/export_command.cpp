#include "dispatch.hpp"
#include "document/atomic_file.hpp"
#include "document/json_place.hpp"
#include "document/json_text.hpp"
#include "document/read_file.hpp"
#include "experiment_options.hpp"
#include "export/formats.hpp"
#include "export/picture.hpp"
#include "geometry/joined.hpp"
#include "page_files.hpp"
#include "run/weave_library.hpp"
#include "say.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace hauberk::command {
namespace {

namespace fs = std::filesystem;
using namespace exporting;

constexpr const char* formats = "stl, obj, 3mf, glb, vtu, html or png";

/// Numbers between commas, all of the text.
std::vector<double> numbers_in(const std::string& text)
{
  std::vector<double> out;
  const char *at = text.data(), *end = at + text.size();
  while (at != end) {
    double x = 0.0;
    const auto read = std::from_chars(at, end, x);
    if (read.ec != std::errc{} || !std::isfinite(x)) return {};
    out.push_back(x);
    if (read.ptr == end) return out;
    if (*read.ptr != ',') return {};
    at = read.ptr + 1;
  }
  return {};
}

/// Whole numbers between commas, from 1 to `most`.
std::vector<int> counts_of(const Options& options, const char* name, int most, const char* example)
{
  const auto& text = options.get<std::string>(name);
  std::vector<int> out;
  for (const double x : numbers_in(text)) {
    if (x < 1.0 || x > most || x != std::floor(x)) break;
    out.push_back(static_cast<int>(x));
  }
  if (out.size() != numbers_in(text).size() || out.empty())
    throw UsageError(
        fmt::format("--{} {}: expected whole numbers from 1 to {}, as {}", name, text, most, example),
        options.usage());
  return out;
}

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

double positive(const Options& options, const char* name)
{
  if (!options.has(name)) return 0.0;
  const double value = options.get<double>(name);
  if (!(value > 0.0) || !std::isfinite(value))
    throw UsageError(fmt::format("--{} {:g}: expected a number above 0", name, value), options.usage());
  return value;
}

/// A file, and the fabric that it speaks of.
struct Opened {
  std::string file;
  boost::json::value results;  ///< null of an experiment
  Job job;                     ///< of the experiment, also of that in results
  Fabric fabric;
};

/// Results, of a sweep those of the row that is asked for.
boost::json::value row_of(boost::json::value results, const Options& options, const std::string& file)
{
  const detail::JsonPlace document(results, file);
  const auto sweep = document.find("sweep");
  if (!options.has("row")) {
    if (sweep && options.has("state") && options.get<std::string>("state") != "rest")
      throw InputError(
          fmt::format("--state {}: {} are results of a sweep, whose rows have limits; give --row K",
                      options.get<std::string>("state"), file));
    return results;
  }
  const int number = options.get<int>("row");
  if (!sweep)
    throw InputError(fmt::format("--row {}: {} are no results of a sweep; leave it out", number, file));
  const std::vector<detail::JsonPlace> rows = sweep->at("rows").items();
  if (number < 0 || static_cast<std::size_t>(number) >= rows.size())
    throw InputError(fmt::format("--row {}: {} has {} rows, 0 to {}", number, file, rows.size(),
                                 static_cast<int>(rows.size()) - 1));
  const detail::JsonPlace row = rows[static_cast<std::size_t>(number)];
  const auto result = row.find("result");
  if (!result)
    throw InputError(fmt::format("--row {}: it has no result: {}, {}", number, row.at("status").text(),
                                 row.at("message").text()));
  boost::json::value out = result->value();
  // Rows are of the program that their sweep is of.
  if (const auto provenance = document.find("provenance"))
    out.as_object()["provenance"] = provenance->value();
  return out;
}

/// Of an experiment, of results, or of a folder of results.
Opened open_fabric(const Options& options)
{
  std::string file = options.positional();
  std::error_code unknown;
  if (fs::is_directory(file, unknown)) file = (fs::path(file) / results_file).string();
  const std::string state = options.has("state") ? options.get<std::string>("state") : "rest";
  const std::string text = read_whole_file(file, largest_results);
  const bool is_results = text.find("\"hauberk-results/") != std::string::npos;
  if (!is_results) {
    if (options.has("row")) throw InputError("--row: an experiment has none; run it, and give its results");
    if (state != "rest")
      throw InputError(fmt::format("--state {}: an experiment has only its rest; run it, and give its {}",
                                   state, results_file));
    Job job = prepare_job(open_registry(options), {file, text, options.list("set"), weave_lookup(file)});
    const Prepared& prepared = *job.prepared;
    Fabric fabric = fabric_of(prepared.scene, prepared.experiment.name, prepared.experiment.length_unit);
    return {file, nullptr, std::move(job), std::move(fabric)};
  }
  if (!options.list("set").empty()) throw InputError("--set: results are as they are; give an experiment");
  boost::json::value results = row_of(parse_json(text, file), options, file);
  Job job = job_of_results(open_registry(options), results, file);
  Fabric fabric = fabric_in_results(results, file, job.prepared->scene, state);
  return {file, std::move(results), std::move(job), std::move(fabric)};
}

/// The page of all states.
std::string page_content(const Opened& opened, const PageView& view)
{
  const PageParts parts = installed_page_parts();
  return page(
      {opened.results.is_null() ? page_entry(opened.fabric, view)
                                : page_entry(opened.results, opened.file, opened.job.prepared->scene, view)},
      parts);
}

std::string content_of(const std::string& format, const Assembly& assembly, const Opened& opened,
                       const Options& options)
{
  if (format == ".stl") return stl(assembly);
  if (format == ".obj") return obj(assembly);
  if (format == ".3mf") return three_mf(assembly, options.has("separate") ? Objects::separate : Objects::one);
  if (format == ".glb") return glb(assembly);
  if (format == ".vtu")
    return vtu(assembly, options.has("forces") ? contacts_in_results(opened.results, opened.file,
                                                                     options.get<std::string>("state"))
                                               : std::vector<ShownContact>());
  const View view = view_of(options.has("view") ? options.get<std::string>("view") : "iso");
  std::vector<int> size{800, 600};
  if (options.has("size")) size = counts_of(options, "size", 8000, "800,600");
  if (size.size() != 2) throw UsageError("--size: expected width and height, as 800,600", options.usage());
  constexpr double largest_scale = 1e6;
  if (options.has("scale") && positive(options, "scale") > largest_scale)
    throw UsageError(fmt::format("--scale: expected at most {:g} pixels per unit", largest_scale),
                     options.usage());
  const double scale =
      options.has("scale") ? positive(options, "scale") : scale_that_fits(assembly, view, size[0], size[1]);
  return png(render(assembly, view, size[0], size[1], scale));
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
  for (const auto& primitives : assembly.primitives) thin = std::min(thin, thinnest(primitives));
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
      .form = "FILE.json -o OUT.{stl,obj,3mf,glb,vtu,html,png} [--state S]",
      .line = "a fabric to print, to look at or to compute with",
      .synopsis = "export FILE.json -o OUT [options]",
      .summary =
          "Writes the elements of an experiment or of results (or of a folder of results) as closed surfaces: "
          "STL, OBJ, 3MF, GLB, VTU by the ending of the file's name, a picture as PNG, or as HTML a page that "
          "shows all states, to be turned by hand.",
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
    throw UsageError(fmt::format("--output: expected a file that ends in {}", formats), options.usage());
  const fs::path file = options.get<std::string>("output");
  std::string format = file.extension().string();
  std::transform(format.begin(), format.end(), format.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (format != ".stl" && format != ".obj" && format != ".3mf" && format != ".glb" && format != ".vtu" &&
      format != ".html" && format != ".png")
    throw UsageError(fmt::format("--output {}: expected an ending of {}", file.string(), formats),
                     options.usage());
  const std::array<int, 3> repeat = repeat_of(options);
  const std::optional<Outline> outline = outline_of(options);
  const double chord = positive(options, "chord"), gap = positive(options, "require-gap");
  if (!options.has("force"))
    refuse_existing_file(file, "give another name with -o, or --force, which replaces it");
  if (options.has("forces") && (format != ".vtu" || !options.has("state")))
    throw UsageError(
        "--forces: only of a limit (--state limit:K or SENSE:DEGREES), and only .vtu holds them; a page shows them anyway",
        options.usage());
  if (options.has("separate") && format != ".3mf")
    throw UsageError("--separate: only .3mf has objects and items", options.usage());
  if (format != ".png")
    for (const char* name : {"view", "size", "scale"})
      if (options.has(name))
        throw UsageError(fmt::format("--{}: only of a picture (.png)", name), options.usage());
  if (format == ".html" && options.has("state"))
    throw UsageError("--state: a page has all states; leave it out", options.usage());
  const Opened opened = open_fabric(options);
  const bool is_page = format == ".html";
  auto cells = repeat;
  if (!options.has("repeat") && outline)
    cells = cells_that_fill(opened.fabric, *outline);
  else if (!options.has("repeat") && is_page)
    cells = shown_cells(opened.fabric);
  const Assembly assembly = assemble(opened.fabric, cells, outline, chord);
  const auto nearest = nearest_copies(assembly, std::numeric_limits<double>::infinity());
  require_gap(assembly, nearest, gap);
  const std::string content = is_page ? page_content(opened, {cells, outline, chord, {}})
                                      : content_of(format, assembly, opened, options);
  if (options.has("force"))
    write_files_atomically(file.has_parent_path() ? file.parent_path() : ".",
                           {{file.filename().string(), content}}, {});
  else
    write_new_file_atomically(file, content);
  say("{}written to {}\n", summary(assembly, nearest), file.string());
  return exit_done;
}

}  // namespace hauberk::command
