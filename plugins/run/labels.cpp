#include "run/labels.hpp"

#include "document/jsonc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <tuple>

namespace hauberk {
namespace {

std::string unit_of(const Experiment& experiment)
{
  switch (experiment.load_case->value_length_power()) {
    case 0:
      return "strain";
    case -1:
      return "1/" + experiment.length_unit;
    default:
      return "value";
  }
}

}  // namespace

PlotLabels plot_labels(const Experiment& e, std::span<const std::string> varied)
{
  const auto stands = [&](std::string_view pointer) {
    return std::none_of(varied.begin(), varied.end(), [&](const std::string& other) {
      return pointer_within(pointer, other) || pointer_within(other, "/values");
    });
  };
  PlotLabels labels;
  labels.title = e.name;
  const auto add = [&](const std::string& text) {
    labels.subtitle += (labels.subtitle.empty() ? "" : ", ") + text;
  };
  if (stands("/load_case/plugin")) add(e.load_case_plugin);
  if (stands("/load_case/measure") && stands("/load_case/plugin"))
    add(fmt::format("measure {}", e.directions.empty() ? e.load_case->measure()
                                                       : e.load_case->measure(e.directions.front())));
  if (stands("/solver/clearance") && stands("/length_unit"))
    add(fmt::format("clearance {:g} {}", e.solver.clearance, e.length_unit));
  std::tie(labels.positive, labels.negative) = e.load_case->sense_names();
  labels.unit = unit_of(e);
  return labels;
}

}  // namespace hauberk
