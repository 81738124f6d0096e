#include "node_access.hpp"
#include "sections.hpp"

#include <hauberk/error.hpp>
#include <hauberk/limits/boundary.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hauberk {
namespace {

/// Distance of two unit vectors of the metric below which they count as one direction.
constexpr double same_components = 1e-9;

/// What keeps `directions` from meaning anything here.
bool applies(const Node& section, const Node& directions, const Experiment& experiment, Problems& problems)
{
  bool good = true;
  const auto refuse = [&](const Node& at, const std::string& why) {
    problems.add(at, why);
    good = false;
  };
  if (section.find("directions_deg") != nullptr)
    refuse(directions, "directions and directions_deg are both given: expected one of them");
  if (const Node* senses = section.find("senses"))
    refuse(*senses,
           "directions have one sense, further along them: leave out senses, and give the opposite "
           "direction for the other one");
  if (experiment.task == Task::design)
    refuse(directions, "targets and profiles of a design are taken at angles: use directions_deg");
  if (experiment.load_case &&
      (experiment.load_case->macro_count() != 3 || !experiment.load_case->takes_components())) {
    refuse(directions, fmt::format("'{}' does not have three unknowns in the unit of its value: use "
                                   "directions_deg",
                                   experiment.load_case_plugin));
  }
  return good;
}

std::vector<Direction> read_list(const Node& list, const LoadCase& load_case, Problems& problems)
{
  std::vector<Direction> out;
  std::vector<Vec3> units;
  std::array<double, 3> metric{};
  load_case.metric(metric);
  for (const Node& item : list.items) {
    const std::vector<double> d = item.numbers();
    if (d.size() != 3) continue;  // reported
    if (std::all_of(d.begin(), d.end(), [](double x) { return x == 0.0; })) {
      problems.add(item, "expected a direction, found all zeros");
      continue;
    }
    out.push_back(Direction::along(d));
    Vec3 x = Vec3(d[0], d[1], d[2]) / Vec3(d[0], d[1], d[2]).cwiseAbs().maxCoeff();
    for (int k = 0; k < 3; ++k) x[k] *= std::sqrt(metric[static_cast<std::size_t>(k)]);
    x.normalize();
    const bool repeated = std::any_of(units.begin(), units.end(),
                                      [&x](const Vec3& o) { return (o - x).norm() < same_components; });
    if (repeated)
      problems.add(item, fmt::format("direction {} is given twice: lengths do not count", out.back().text()));
    units.push_back(x);
  }
  return out;
}

}  // namespace

void read_directions(const Node& section, Problems& problems, Experiment& experiment)
{
  const Node* directions = section.find("directions");
  if (directions == nullptr || !applies(section, *directions, experiment, problems)) return;
  if (!experiment.load_case) return;
  if (directions->is(Node::Type::array)) {
    experiment.directions = read_list(*directions, *experiment.load_case, problems);
  } else if (const Node* parts = find_typed(*directions, "sphere", Node::Type::number)) {
    DirectionSphere sphere = direction_sphere(static_cast<int>(parts->number), *experiment.load_case);
    experiment.directions = std::move(sphere.directions);
    experiment.triangles = std::move(sphere.triangles);
  }
}

}  // namespace hauberk
