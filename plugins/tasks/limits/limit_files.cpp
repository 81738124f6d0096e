#include "tasks/limits/limit_files.hpp"

#include "pictures/boundary.hpp"
#include "pictures/polar_svg.hpp"
#include "results/csv.hpp"
#include "run/labels.hpp"

namespace hauberk {

std::vector<ResultFile> limit_files(const Prepared& prepared, const RunResult& run)
{
  const auto& [limits, profile, surface, picture] = limit_file_names;
  const std::vector<std::string> names = macro_names(*prepared.experiment.load_case);
  const PlotLabels labels = plot_labels(prepared.experiment);
  std::vector<ResultFile> out{{"limits", limits, limits_csv(run.limits, names)}};
  if (!run.boundary) {
    out.push_back({"profile", profile, polar_svg(run, labels)});
  } else if (run.limits.front().direction.components().size() == 3) {
    out.push_back({"boundary", surface, boundary_ply(run, labels.unit, names)});
    out.push_back({"picture", picture, boundary_svg(run, labels, names)});
  }
  return out;
}

}  // namespace hauberk
