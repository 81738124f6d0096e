#include "weave_files.hpp"

#include "document/json_text.hpp"
#include "export/page.hpp"
#include "export/picture.hpp"
#include "maker/weave_page.hpp"
#include "run/provenance.hpp"
#include "say.hpp"
#include "tasks/table.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace hauberk::command {
namespace {

using namespace exporting;

constexpr std::array<const char*, 4> sheet_files{"weave.html", "weave.txt", "weave.json", "experiment.json"};
constexpr int width = 480, height = 360;  // pixels of a picture

/// What the rings of a state look like, and how it is called.
struct Shown {
  std::string caption;
  Assembly assembly;
};

std::string strain_text(const std::optional<double>& strain)
{
  return strain ? fmt::format(", {:+.1f} %", 100.0 * *strain) : "";
}

/// Rest, and both states of every way that has them.
std::vector<Shown> states_of(const maker::Sheet& sheet, const boost::json::value& results)
{
  const Prepared& prepared = *sheet.job->prepared;
  const Fabric rest = fabric_of(prepared.scene, sheet.weave.name, prepared.experiment.length_unit);
  const std::array<int, 3> cells = shown_cells(rest);
  std::vector<Shown> out{{"at rest", assemble(rest, cells, std::nullopt, 0.0)}};
  const std::vector<detail::JsonPlace> limits = detail::JsonPlace(results, results_file).at("limits").items();
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const maker::WayAnswer& way = sheet.ways[k / 2];
    const bool stretches = k % 2 == 0;
    const std::optional<double>& strain = stretches ? way.stretch : way.compress;
    if (!strain) continue;
    out.push_back({(stretches ? "taut " : "pushed together ") + way.name + strain_text(strain),
                   assemble(at_limit(rest, limits[k]), cells, std::nullopt, 0.0)});
  }
  return out;
}

/// From above, all at one scale.
std::vector<maker::SheetPicture> pictures_of(const std::vector<Shown>& states)
{
  const View view = view_of("top");
  double scale = std::numeric_limits<double>::infinity();
  for (const Shown& state : states)
    scale = std::min(scale, scale_that_fits(state.assembly, view, width, height));
  std::vector<maker::SheetPicture> out;
  try {
    for (const Shown& state : states)
      out.push_back({state.caption, png(render(state.assembly, view, width, height, scale))});
  } catch (const InputError& error) {
    say_error("hauberk: warning: {} has no pictures: {}\n", sheet_files[0], error.what());
    return {};
  }
  return out;
}

}  // namespace

std::vector<const char*> weave_file_names()
{
  std::vector<const char*> out = result_names();
  out.insert(out.end(), sheet_files.begin(), sheet_files.end());
  return out;
}

std::vector<NamedContent> weave_files(const maker::Sheet& sheet, const std::filesystem::path& folder,
                                      unsigned threads)
{
  const Job& job = *sheet.job;
  boost::json::object results = blank_document(job, provenance(*job.prepared, threads, false));
  std::vector<NamedContent> out = result_content(job, folder, results, {});
  const std::vector<Shown> states = states_of(sheet, boost::json::value(results));
  const std::array<std::string, sheet_files.size()> contents{
      sheet_page(sheet, pictures_of(states)), sheet_text(sheet), write_json(sheet_json(sheet)),
      maker::experiment_text(sheet.weave, sheet.question, 0.0)};
  // results.json last, as it says that all of the others are there.
  for (std::size_t k = 0; k < contents.size(); ++k)
    out.insert(out.end() - 1, NamedContent{sheet_files[k], contents[k]});
  return out;
}

}  // namespace hauberk::command
