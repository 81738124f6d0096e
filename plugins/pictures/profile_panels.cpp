#include "pictures/profile_panels.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hauberk::detail {
namespace {

/// Direction modulo 180 degrees, in [0, 180); what rounding put just below 180 counts as 0.
double reduced(double degrees)
{
  const double d = std::fmod(std::fmod(degrees, 180.0) + 180.0, 180.0);
  return d > 180.0 - 1e-9 ? 0.0 : d;
}

/// A profile from limits; the first limit of a direction and sense counts.
std::vector<ProfilePoint> profile_of(const std::vector<LimitResult>& limits)
{
  std::vector<ProfilePoint> out;
  bool strain = true;
  for (const LimitResult& limit : limits) {
    if (!limit.direction.is_angle()) continue;
    strain = strain && limit.sense != "up" && limit.sense != "down";
    const auto same = [&](const ProfilePoint& p) {
      return std::abs(reduced(p.direction_deg) - reduced(limit.direction.degrees())) < 1e-9;
    };
    auto it = std::find_if(out.begin(), out.end(), same);
    if (it == out.end()) it = out.insert(out.end(), ProfilePoint{limit.direction.degrees(), {}, {}, {}});
    auto& slot = limit.sense == "stretch" || limit.sense == "up" ? it->e_s : it->e_c;
    if (!slot && limit.status == LimitStatus::locked) slot = limit.value;
  }
  for (ProfilePoint& p : out)
    if (strain && p.e_s && p.e_c && 1.0 + *p.e_c > 0.0) p.eta = (*p.e_s - *p.e_c) / (1.0 + *p.e_c);
  return out;
}

using Quantity = std::optional<double> ProfilePoint::*;

void fill(Curve& curve, const std::vector<ProfilePoint>& profile, Quantity quantity)
{
  for (const ProfilePoint& p : profile) {
    const double degrees = reduced(p.direction_deg);
    const std::optional<double>& value = p.*quantity;
    if (value && std::isfinite(*value))
      curve.points.emplace_back(degrees, std::abs(*value));
    else
      curve.holes.push_back(degrees);
  }
}

/// Directions in which one of the limits that make up `quantity` is unbounded.
std::vector<double> endless(const std::vector<LimitResult>& limits, Quantity quantity,
                            const PlotLabels& labels)
{
  std::vector<double> out;
  for (const LimitResult& limit : limits) {
    const bool part = quantity == &ProfilePoint::eta ||
                      limit.sense == (quantity == &ProfilePoint::e_s ? labels.positive : labels.negative);
    const double degrees = reduced(limit.direction.degrees());
    if (part && limit.status == LimitStatus::unbounded &&
        std::find(out.begin(), out.end(), degrees) == out.end())
      out.push_back(degrees);
  }
  return out;
}

/// Directions in which a limit that makes up `quantity` is contradicted, or searches do not settle which
/// state is the furthest.
std::vector<double> doubtful(const std::vector<LimitResult>& limits, Quantity quantity,
                             const PlotLabels& labels)
{
  std::vector<double> out;
  for (const LimitResult& limit : limits) {
    const bool part = quantity == &ProfilePoint::eta ||
                      limit.sense == (quantity == &ProfilePoint::e_s ? labels.positive : labels.negative);
    const std::string& word = limit.confidence.word;
    const bool doubt = word == "contradicted" || word == "single" || word == "unsettled";
    const double degrees = reduced(limit.direction.degrees());
    if (limit.direction.is_angle() && part && doubt &&
        std::find(out.begin(), out.end(), degrees) == out.end())
      out.push_back(degrees);
  }
  return out;
}

/// Adds the curve of one quantity, before and after; nothing when there are no values.
void add(Panel& panel, const RunResult& run, const PlotLabels& labels, Quantity quantity,
         const std::string& name, Curve style)
{
  if (run.design) {
    Curve before = style;
    before.label = name + ", " + labels.before;
    before.stroke.colour = "#999";
    before.stroke.width = 1.3;
    before.marker = Curve::Marker::none;
    before.behind = true;
    fill(before, profile_of(run.design->initial_limits), quantity);
    if (!before.points.empty()) panel.curves.push_back(std::move(before));
  }
  style.label = run.design ? name + ", " + labels.after : name;
  fill(style, run.profiles.empty() ? profile_of(run.limits) : run.profiles, quantity);
  style.endless = endless(run.limits, quantity, labels);
  style.hollow = doubtful(run.limits, quantity, labels);
  if (!style.points.empty()) panel.curves.push_back(std::move(style));
}

void add_targets(Panel& panel, const DesignResult& design)
{
  using Values = std::vector<std::pair<double, double>>;
  std::map<Aim, Values> targets;
  for (const DesignTargetResult& t : design.targets) targets[t.aim].emplace_back(t.direction_deg, t.target);
  add_marks(panel, "targets", Curve::Marker::target, "#c00000", targets[Aim::reach]);
  add_marks(panel, "bounds: no further", Curve::Marker::no_further, "#c00000", targets[Aim::no_further]);
  add_marks(panel, "bounds: no nearer", Curve::Marker::no_nearer, "#c00000", targets[Aim::no_nearer]);
}

Curve style(const char* colour, double width, const char* dash, Curve::Marker marker)
{
  return {.label = {},
          .stroke = {colour, width, dash},
          .marker = marker,
          .joined = true,
          .points = {},
          .holes = {},
          .endless = {},
          .hollow = {},
          .bars = {},
          .behind = false};
}

}  // namespace

void add_marks(Panel& panel, const std::string& label, Curve::Marker marker, const std::string& colour,
               const std::vector<std::pair<double, double>>& values)
{
  Curve marks{.label = label,
              .stroke = {colour, 1.0, ""},
              .marker = marker,
              .joined = false,
              .points = {},
              .holes = {},
              .endless = {},
              .hollow = {},
              .bars = {},
              .behind = false};
  for (const auto& [degrees, value] : values) marks.points.emplace_back(reduced(degrees), std::abs(value));
  if (!marks.points.empty()) panel.curves.push_back(std::move(marks));
}

ProfilePanels profile_panels(const RunResult& run, const PlotLabels& labels)
{
  Panel eta{"\u03b7 = (e_s \u2212 e_c) / (1 + e_c), dimensionless", {}, {}};
  add(eta, run, labels, &ProfilePoint::eta, "\u03b7", style("#111", 2.2, "", Curve::Marker::dot));
  Panel limits{
      labels.positive + " and " + labels.negative + " limits (magnitude, " + labels.unit + ")", {}, {}};
  add(limits, run, labels, &ProfilePoint::e_s, labels.positive,
      style("#1f4e79", 2.2, "", Curve::Marker::dot));
  add(limits, run, labels, &ProfilePoint::e_c, labels.negative,
      style("#c55a11", 2.2, "7,4", Curve::Marker::square));
  if (run.design && run.design->quantity == "eta") add_targets(eta, *run.design);
  if (run.design && run.design->quantity != "eta") add_targets(limits, *run.design);
  return {std::move(eta), std::move(limits)};
}

}  // namespace hauberk::detail
