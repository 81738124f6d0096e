#include "maker/weave_comparison.hpp"

#include <fmt/format.h>

namespace hauberk::maker {
namespace {

std::string rows_of(const Sheet& sheet)
{
  std::string out;
  for (const WayAnswer& way : sheet.ways) {
    const bool first = out.empty();
    out += fmt::format("{:<20}{:>8}  {:<22}{:>10}{:>12}{:>18}{:>10}\n", first ? sheet.weave.name : "",
                       first ? fmt::format("{:.3f}", sheet.weave.smallest_ratio) : "", way.name,
                       strain_text(way.stretch, way.stretch_status, way.stretch_confidence),
                       strain_text(way.compress, way.compress_status, way.compress_confidence),
                       first ? fmt::format("{:.0f} per {}", sheet.rings, sheet.chain ? "m" : "dm^2") : "",
                       first && !sheet.chain ? fmt::format("{:.2f} mm", sheet.thickness) : "");
  }
  return out;
}

}  // namespace

std::string comparison_text(const std::vector<Compared>& all, const Question& question)
{
  std::string text = fmt::format("rings of {:.4g} mm inner diameter, wire of {:.4g} mm: ratio {:.3f}\n\n",
                                 question.inner, question.wire, question.inner / question.wire);
  text += fmt::format("{:<20}{:>8}  {:<22}{:>10}{:>12}{:>18}{:>10}\n", "weave", "needs", "", "taut", "pushed",
                      "rings at rest", "thick");
  std::string marks, others;
  for (const Compared& one : all) {
    if (!one.sheet) {
      others += fmt::format("{:<20}{:>8.3f}  {}\n", one.weave.name, one.weave.smallest_ratio, one.why_not);
      continue;
    }
    text += rows_of(*one.sheet);
    marks += shown_marks(*one.sheet);
  }
  const std::string explained = explained_marks_of_sheets(marks);
  return text + others + (explained.empty() ? "" : "\n" + explained);
}

boost::json::array comparison_json(const std::vector<Compared>& all)
{
  boost::json::array out;
  for (const Compared& one : all) {
    if (one.sheet)
      out.push_back(sheet_json(*one.sheet));
    else
      out.push_back(boost::json::object{
          {"weave", one.weave.name}, {"smallest_ratio", one.weave.smallest_ratio}, {"why_not", one.why_not}});
  }
  return out;
}

}  // namespace hauberk::maker
