#include "balance.hpp"
#include "checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

void check_translation(const Scene& scene, const Limit& limit, const VerifyTolerances& tolerances,
                       Sentences& problems)
{
  const Mat3 F = limit.macro->deformation();
  Vec3 moved = Vec3::Zero(), fluctuation = Vec3::Zero();
  for (std::size_t k = 0; k < limit.poses.size(); ++k) {
    moved += limit.poses[k].position - scene.elements[k].rest.position;
    fluctuation += limit.poses[k].position - F * scene.elements[k].rest.position;
  }
  // Either the mean position or the mean of u = x - F X may be the one that is held.
  const double mean = std::min(moved.norm(), fluctuation.norm()) / static_cast<double>(limit.poses.size());
  if (!(mean <= tolerances.translation * scene.length))
    problems.push_back(fmt::format("the mean translation moved by {:.3g}", mean));
}

void check_heights(const Scene& scene, const Setting& setting, const Limit& limit,
                   const VerifyTolerances& tolerances, Sentences& problems)
{
  if (!std::isfinite(setting.half_height)) return;
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

}  // namespace

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
  const Strain& macro = *limit.macro;
  const double expected = value(limit.measure, limit.direction_deg, macro);
  if (!equal(limit.value, expected, tolerances.value))
    problems.push_back(fmt::format("value {} reported, {:.10g} from macro", show(limit.value), expected));
  const double stretched = line_stretch(limit.direction_deg, macro);
  if (!equal(limit.line_stretch, stretched, tolerances.value))
    problems.push_back(
        fmt::format("line_stretch {} reported, {:.10g} from macro", show(limit.line_stretch), stretched));
  for (std::size_t i = 0; i < limit.starts.size(); ++i) {
    const double reached = value(limit.measure, limit.direction_deg, limit.starts[i].macro);
    if (!equal(limit.starts[i].value, reached, tolerances.value))
      problems.push_back(fmt::format("starts/{}: value {:.10g} reported, {:.10g} from macro", i,
                                     limit.starts[i].value, reached));
  }
  if ((limit.sense == "stretch" ? expected : -expected) < -tolerances.wrong_side)
    problems.push_back(
        fmt::format("value {:.6g} is on the wrong side of zero for {}", expected, limit.sense));
  const double trace = 2.0 + macro.exx + macro.eyy;
  const double determinant = (1.0 + macro.exx) * (1.0 + macro.eyy) - macro.exy * macro.exy;
  if (!(trace > 0.0 && determinant > 0.0)) problems.push_back("F is not positive definite");
  check_translation(scene, limit, tolerances, problems);
  check_heights(scene, setting, limit, tolerances, problems);
}

}  // namespace hauberk::verification
