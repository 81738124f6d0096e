#include "balance.hpp"
#include "checks.hpp"
#include "kinematics.hpp"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk::verification {
namespace {

void check_heights(const Scene& scene, const Setting& setting, const Limit& limit,
                   const VerifyTolerances& tolerances, Sentences& problems)
{
  if (is_bent(setting.load) || !std::isfinite(setting.half_height)) return;
  double mean = 0.0, highest = 0.0;
  for (std::size_t k = 0; k < limit.poses.size(); ++k)
    mean += (limit.poses[k].position - scene.elements[k].rest.position).z() /
            static_cast<double>(limit.poses.size());
  for (std::size_t k = 0; k < limit.poses.size(); ++k)
    highest =
        std::max(highest, std::abs((limit.poses[k].position - scene.elements[k].rest.position).z() - mean));
  if (highest > setting.half_height + tolerances.gap * scene.length)
    problems.push_back(fmt::format("an element is {:.6g} above or below its place, {:.6g} allowed", highest,
                                   setting.half_height));
}

/// The limit is the furthest of its starts, and that start has its state.
void check_starts(const Limit& limit, const VerifyTolerances& tolerances, Sentences& problems)
{
  if (limit.status != "locked" || limit.starts.empty() || !limit.value) return;
  const double sign = is_positive(limit) ? 1.0 : -1.0;
  bool there = false;
  for (const Start& start : limit.starts) {
    // States that are further by rounding alone count as one.
    constexpr double same_value = 1e-9;
    if (sign * (start.value - *limit.value) > same_value * (1.0 + std::abs(*limit.value)))
      problems.push_back(fmt::format("a start went further: {:.10g}", start.value));
    there = there || (start.macro.values - limit.macro->values).cwiseAbs().maxCoeff() <=
                         tolerances.value * (1.0 + limit.macro->values.cwiseAbs().maxCoeff());
  }
  if (!there) problems.emplace_back("no start has the limit's macro");
}

}  // namespace

void check_range(const Scene& scene, const Limit& limit, const VerifyTolerances& tolerances,
                 Sentences& problems)
{
  if (!limit.z_range || limit.poses.empty()) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < limit.poses.size(); ++k) {
    const double z = limit.poses[k].position.z() - scene.elements[k].rest.position.z();
    low = std::min(low, z);
    high = std::max(high, z);
  }
  if (!(std::abs(*limit.z_range - (high - low)) <= tolerances.gap * scene.length))
    problems.push_back(
        fmt::format("z_range {:.6g} reported, {:.6g} from the poses", *limit.z_range, high - low));
}

bool equal(double a, double b, double tolerance)
{
  return std::abs(a - b) <= tolerance * (1.0 + std::abs(b));
}

bool equal(const std::optional<double>& a, const std::optional<double>& b, double tolerance)
{
  return a.has_value() == b.has_value() && (!a || equal(*a, *b, tolerance));
}

std::string show(const std::optional<double>& x) { return x ? fmt::format("{:.10g}", *x) : "null"; }

void check_values(const Scene& scene, const Setting& setting, const Limit& limit,
                  const VerifyTolerances& tolerances, Sentences& problems)
{
  const Macro& macro = *limit.macro;
  const double expected = value(limit, macro);
  if (!equal(limit.value, expected, tolerances.value))
    problems.push_back(fmt::format("value {} reported, {:.10g} from macro", show(limit.value), expected));
  const bool strain = macro.load == Load::strain;
  const double stretched = limit.direction ? 0.0 : line_stretch(limit.direction_deg, macro);
  if (strain && !limit.direction && !equal(limit.line_stretch, stretched, tolerances.value))
    problems.push_back(
        fmt::format("line_stretch {} reported, {:.10g} from macro", show(limit.line_stretch), stretched));
  for (std::size_t i = 0; i < limit.starts.size(); ++i) {
    const double reached = value(limit, limit.starts[i].macro);
    if (!equal(limit.starts[i].value, reached, tolerances.value))
      problems.push_back(fmt::format("starts/{}: value {:.10g} reported, {:.10g} from macro", i,
                                     limit.starts[i].value, reached));
  }
  const double unit = is_bent(macro.load) ? 1.0 / scene.length : 1.0;
  if ((is_positive(limit) ? expected : -expected) < -tolerances.wrong_side * unit)
    problems.push_back(
        fmt::format("value {:.6g} is on the wrong side of zero for {}", expected, limit.sense));
  const Mat3 F = macro.deformation();  // Sylvester's criterion
  if (!(F(0, 0) > 0.0 && F.topLeftCorner<2, 2>().determinant() > 0.0 && F.determinant() > 0.0))
    problems.push_back("F is not positive definite");
  const Sentences places = misplaced(scene, setting, {macro, limit.poses}, tolerances.translation);
  problems.insert(problems.end(), places.begin(), places.end());
  check_heights(scene, setting, limit, tolerances, problems);
  check_range(scene, limit, tolerances, problems);
  if (limit.infimum) problems.emplace_back("infimum is given, but there is a state");
  check_starts(limit, tolerances, problems);
}

}  // namespace hauberk::verification
