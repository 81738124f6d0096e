#include "document/node_access.hpp"
#include "limits/boundary.hpp"
#include "sections.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hauberk {
namespace {

/// Distance of two unit vectors of the metric below which they count as one direction.
constexpr double same_components = 1e-9;

/// What keeps `directions` from meaning anything here.
bool applies(const Node& section, const Node& directions, bool angles_only, const Experiment& experiment,
             Problems& problems)
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
  if (angles_only)
    refuse(directions, "targets and profiles of a design are taken at angles: use directions_deg");
  if (experiment.load_case && !experiment.load_case->takes_components()) {
    refuse(directions,
           fmt::format("the unknowns of '{}' do not have the unit of its value: use directions_deg",
                       experiment.load_case_plugin));
  } else if (experiment.load_case && directions.is(Node::Type::object) &&
             experiment.load_case->macro_count() != 3) {
    refuse(directions, fmt::format("'{}' has {} unknowns, and a sphere of directions needs three: list them",
                                   experiment.load_case_plugin, experiment.load_case->macro_count()));
  }
  return good;
}

/// Of unit length in the metric.
std::vector<double> unit_vector(std::vector<double> d, const std::vector<double>& metric)
{
  double largest = 0.0, length = 0.0;
  for (const double x : d) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < d.size(); ++k) {
    d[k] *= std::sqrt(metric[k]) / largest;
    length = std::hypot(length, d[k]);
  }
  for (double& x : d) x /= length;
  return d;
}

std::vector<Direction> read_list(const Node& list, const LoadCase& load_case, Problems& problems)
{
  std::vector<Direction> out;
  std::vector<std::vector<double>> units;
  const std::size_t count = load_case.macro_count();
  std::vector<double> metric(count);
  load_case.metric(metric);
  for (const Node& item : list.items) {
    const std::vector<double> d = item.numbers();
    if (d.size() != count) {
      problems.add(item, fmt::format("expected as many components as there are unknowns, {}, found {}", count,
                                     d.size()));
      continue;
    }
    if (std::all_of(d.begin(), d.end(), [](double x) { return x == 0.0; })) {
      problems.add(item, "expected a direction, found all zeros");
      continue;
    }
    out.push_back(Direction::along(d));
    const std::vector<double> x = unit_vector(d, metric);
    const bool repeated = std::any_of(units.begin(), units.end(), [&x](const std::vector<double>& o) {
      double apart = 0.0;
      for (std::size_t k = 0; k < x.size(); ++k) apart = std::hypot(apart, o[k] - x[k]);
      return apart < same_components;
    });
    if (repeated)
      problems.add(item, fmt::format("direction {} is given twice: lengths do not count", out.back().text()));
    units.push_back(x);
  }
  return out;
}

}  // namespace

void read_directions(const Node& section, bool angles_only, Problems& problems, Experiment& experiment)
{
  const Node* directions = section.find("directions");
  if (directions == nullptr || !applies(section, *directions, angles_only, experiment, problems)) return;
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
