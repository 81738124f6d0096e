#include "export_formats.hpp"

#include "export/formats.hpp"
#include "export/picture.hpp"
#include "option_numbers.hpp"
#include "page_files.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

namespace hauberk::command {
namespace {

using namespace exporting;

std::string three_mf_content(const Exported& e)
{
  return three_mf(e.assembly, e.options.has("separate") ? Objects::separate : Objects::one);
}

std::string vtu_content(const Exported& e)
{
  if (!e.options.has("forces")) return vtu(e.assembly, {});
  return vtu(e.assembly,
             contacts_in_results(e.opened.results, e.opened.file, e.options.get<std::string>("state")));
}

std::string page_content(const Exported& e)
{
  const PageParts parts = installed_page_parts();
  const Opened& opened = e.opened;
  return page({opened.results.is_null()
                   ? page_entry(opened.fabric, e.view)
                   : page_entry(opened.results, opened.file, opened.job.prepared->scene, e.view)},
              parts);
}

std::string picture_content(const Exported& e)
{
  const Options& options = e.options;
  const View view = view_of(options.has("view") ? options.get<std::string>("view") : "iso");
  std::vector<int> size{800, 600};
  if (options.has("size")) size = counts_of(options, "size", 8000, "800,600");
  if (size.size() != 2) throw UsageError("--size: expected width and height, as 800,600", options.usage());
  constexpr double largest_scale = 1e6;
  if (options.has("scale") && positive(options, "scale") > largest_scale)
    throw UsageError(fmt::format("--scale: expected at most {:g} pixels per unit", largest_scale),
                     options.usage());
  const double scale =
      options.has("scale") ? positive(options, "scale") : scale_that_fits(e.assembly, view, size[0], size[1]);
  return png(render(e.assembly, view, size[0], size[1], scale));
}

constexpr std::array formats{
    ExportFormat{".stl", [](const Exported& e) { return stl(e.assembly); }},
    ExportFormat{".obj", [](const Exported& e) { return obj(e.assembly); }},
    ExportFormat{".3mf", three_mf_content},
    ExportFormat{".glb", [](const Exported& e) { return glb(e.assembly); }},
    ExportFormat{".vtu", vtu_content},
    ExportFormat{".html", page_content, true},
    ExportFormat{".png", picture_content},
};

/// An option that one format alone has a use for, and what is said with any other.
struct OptionOfOne {
  const char* option;
  std::string_view ending;
  const char* refusal;
};

constexpr std::array options_of_one{
    OptionOfOne{
        "forces", ".vtu",
        "--forces: only of a limit (--state limit:K or SENSE:DEGREES), and only .vtu holds them; a page "
        "shows them anyway"},
    OptionOfOne{"separate", ".3mf", "--separate: only .3mf has objects and items"},
    OptionOfOne{"view", ".png", "--view: only of a picture (.png)"},
    OptionOfOne{"size", ".png", "--size: only of a picture (.png)"},
    OptionOfOne{"scale", ".png", "--scale: only of a picture (.png)"},
};

}  // namespace

std::string export_endings_between_commas()
{
  std::string out;
  for (const ExportFormat& f : formats)
    out += fmt::format("{}{}", out.empty() ? "" : ",", f.ending.substr(1));
  return out;
}

std::string export_endings()
{
  std::string out;
  for (const ExportFormat& f : formats) {
    const bool last = f.ending == formats.back().ending;
    out += fmt::format("{}{}", out.empty() ? "" : last ? " or " : ", ", f.ending.substr(1));
  }
  return out;
}

const ExportFormat& export_format_of(const std::string& file, const Options& options)
{
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto format = std::ranges::find(formats, ending, &ExportFormat::ending);
  if (format == formats.end())
    throw UsageError(fmt::format("--output {}: expected an ending of {}", file, export_endings()),
                     options.usage());
  return *format;
}

void refuse_options_of_others(const ExportFormat& format, const Options& options)
{
  for (const OptionOfOne& one : options_of_one)
    if (options.has(one.option) && format.ending != one.ending)
      throw UsageError(one.refusal, options.usage());
  if (options.has("forces") && !options.has("state"))
    throw UsageError(options_of_one.front().refusal, options.usage());
  if (format.shows_all_states && options.has("state"))
    throw UsageError("--state: a page has all states; leave it out", options.usage());
}

}  // namespace hauberk::command
