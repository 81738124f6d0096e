#include "dispatch.hpp"
#include "document/json_text.hpp"
#include "inspect/inspection.hpp"
#include "options.hpp"
#include "say.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hauberk::command {

Description inspect_description()
{
  return {
      .name = "inspect",
      .form = "MODEL.{stl,obj,3mf} [--gap X] [--json]",
      .line = "what a printed model is: bodies, gaps, links",
      .synopsis = "inspect MODEL [options]",
      .summary =
          "Looks at a model of triangles from any program: which bodies it has and whether their surfaces are closed, "
          "the smallest gap between two of them, which are linked with which, what is linked with nothing, and how it "
          "lies on the bed of a printer.",
      .more =
          "Distances are those of the triangles, exact up to rounding. Two bodies are linked where a closed curve on "
          "one is linked with one on the other; what hooks into each other without that is not seen. Exit code 1: a "
          "surface is not closed, two bodies meet, or are nearer than --gap.",
      .arguments = {{.name = "MODEL", .offer = Offer::files}},
      .options = {{.name = "gap",
                   .takes = Takes::real,
                   .value = "X",
                   .help = "bodies nearer than this, in the unit of the file, are listed, and fail"},
                  {.name = "json", .help = "all of it as JSON"}}};
}

int inspect_command(const std::vector<std::string>& words)
{
  Options options(inspect_description());
  options.parse(words);
  const double gap = options.has("gap") ? options.get<double>("gap") : 0.0;
  if (!(gap >= 0.0) || !std::isfinite(gap))
    throw UsageError(fmt::format("--gap {:g}: expected a length, 0 or above", gap), options.usage());
  const std::string file = options.positional();
  const inspecting::Inspection inspection = inspecting::inspect(inspecting::read_model_file(file), file, gap);
  if (options.has("json"))
    say_json(write_json(inspection_json(inspection, gap)));
  else
    say("{}", inspection_text(inspection, gap));
  return inspection.failed() ? exit_failed : exit_done;
}

}  // namespace hauberk::command
