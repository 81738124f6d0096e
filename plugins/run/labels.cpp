#include "run/labels.hpp"

#include <fmt/format.h>

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

PlotLabels plot_labels(const Experiment& e)
{
  PlotLabels labels;
  labels.title = e.name;
  labels.subtitle =
      fmt::format("{}, measure {}, clearance {:g} {}", e.load_case_plugin,
                  e.directions.empty() ? e.load_case->measure() : e.load_case->measure(e.directions.front()),
                  e.solver.clearance, e.length_unit);
  std::tie(labels.positive, labels.negative) = e.load_case->sense_names();
  labels.unit = unit_of(e);
  return labels;
}

}  // namespace hauberk
