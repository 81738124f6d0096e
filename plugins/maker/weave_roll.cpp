#include "maker/weave_roll.hpp"

#include "document/json_text.hpp"
#include "maker/job_limits.hpp"
#include "maker/lattice_step.hpp"
#include "run/confidence_marks.hpp"
#include "run/interrupt.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <boost/json/parse.hpp>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::maker {
namespace {

/// A strip that goes around by more closes into a tube before its elements stop it.
constexpr double most_turns = 0.75;
constexpr int fewest_rows = 2, most_rows = 6;
constexpr double same_radius = 0.01;

std::string strip_text(const Weave& weave, const Question& question, const std::array<int, 2>& axis, int rows)
{
  namespace json = boost::json;
  json::value document = json::parse(experiment_text(weave, question, 0.0));
  json::object& root = document.as_object();
  root["load_case"] = json::object{{"plugin", "strip_roll"}, {"directions_deg", {90}}};
  root["cell"].as_object()["strip"] = json::object{{"axis", {axis[0], axis[1]}}, {"rows", rows}};
  return write_json(document);
}

/// How far around the roll elements are, in turns. They lie on it, its axis along x and above the origin.
double turns(const LimitResult& limit)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Pose& pose : limit.poses) {
    const double angle = std::atan2(*limit.value * pose.position.y(), 1.0 - *limit.value * pose.position.z());
    low = std::min(low, angle);
    high = std::max(high, angle);
  }
  return (high - low) / (2.0 * std::numbers::pi);
}

/// The rod that has room in a roll: what is nearest to the axis is a ring's wire, whose core is a circle.
double rod_diameter(const SceneSpec& scene, const LimitResult& limit)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < scene.elements.size(); ++k) {
    const Pose& pose = limit.poses[k];
    const Shape& shape = *scene.types[scene.elements[k].type].shape;
    for (const Primitive& ring : shape.primitives(scene.elements[k].parameters)) {
      const auto& [R, r0, r1] = ring.size;
      const double core = distance_from_axis(pose.position + pose.rotation * ring.position,
                                             pose.rotation * ring.rotation, R, 1.0 / *limit.value);
      nearest = std::min(nearest, core - std::max(r0, r1));
    }
  }
  return 2.0 * std::max(nearest, 0.0);
}

/// Radii of a strip of so many rows, up and down.
RollAnswer of_rows(const Job& job, RollAnswer roll, unsigned threads, Progress& progress)
{
  const std::vector<LimitTask> tasks = job.task->limit_tasks();
  const std::vector<LimitResult> limits =
      limits_of(job, threads, fmt::format("rolled {}, {} rows", roll.name, roll.rows), progress);
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const bool up = tasks[k].sense == Sense::positive;
    const bool locked = limits[k].status == LimitStatus::locked;
    (up ? roll.up : roll.down) = locked ? std::optional(1.0 / std::abs(*limits[k].value)) : std::nullopt;
    (up ? roll.up_status : roll.down_status) = to_string(limits[k].status);
    (up ? roll.up_confidence : roll.down_confidence) = limits[k].confidence.word;
    if (locked) {
      roll.turns = std::max(roll.turns, turns(limits[k]));
      (up ? roll.up_rod : roll.down_rod) = rod_diameter(job.prepared->scene, limits[k]);
    }
    // What is no sheet any more has gone around, or in a radius below that of its rings.
    if (!locked) roll.turns = 1.0;
  }
  return roll;
}

bool same(const std::optional<double>& a, const std::optional<double>& b)
{
  return a && b && std::abs(*a - *b) <= same_radius * *b;
}

/// From strips of more and more rows the radius of the weave: that of the first strip which one more row does
/// not change. Where two strips on end close into tubes nothing else stops them, and the narrower tube is
/// told.
class Narrowing {
 public:
  bool is_done() const { return done_; }
  RollAnswer answer() const { return tube_ ? *tube_ : open_ ? *open_ : last_; }

  void add(RollAnswer roll)
  {
    const bool locked = roll.up && roll.down;
    if (locked && roll.turns > most_turns) {
      done_ = tube_.has_value();
      if (!tube_) tube_ = roll;
    } else if (locked) {
      done_ = open_ && same(roll.up, open_->up) && same(roll.down, open_->down);
      open_ = roll;
      tube_.reset();
    }
    last_ = std::move(roll);
  }

 private:
  std::optional<RollAnswer> open_, tube_;
  RollAnswer last_;
  bool done_ = false;
};

}  // namespace

double distance_from_axis(const Vec3& centre, const Mat3& axes, double R, double z)
{
  const auto distance = [&](double angle) {
    const Vec3 x = centre + R * (std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1));
    return std::hypot(x.y(), x.z() - z);
  };
  // Its square has at most two minima around the circle.
  constexpr int samples = 64, bits = std::numeric_limits<double>::digits / 2;
  constexpr double step = 2.0 * std::numbers::pi / samples;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < samples; ++k) {
    const double angle = k * step;
    const double here = distance(angle);
    if (here > distance(angle - step) || here > distance(angle + step)) continue;
    least = std::min(
        least, boost::math::tools::brent_find_minima(distance, angle - step, angle + step, bits).second);
  }
  return least;
}

std::vector<RollAnswer> rolls(const Weave& weave, const Question& question, const std::vector<Vec3>& lattice,
                              const WeaveLookup& lookup, const std::shared_ptr<const Registry>& registry,
                              unsigned threads, Progress& progress)
{
  const std::string label = "hauberk weave " + question.weave;
  std::vector<RollAnswer> out;
  for (const Weave::Way& way : weave.ways) {
    const std::optional<LatticeStep> axis = step_along(lattice, way.degrees + 90.0);
    if (!axis) continue;
    Narrowing narrowing;
    try {
      for (int rows = fewest_rows; rows <= most_rows && !narrowing.is_done(); ++rows) {
        const Job job =
            prepare_job(registry, {label, strip_text(weave, question, axis->counts, rows), {}, lookup});
        narrowing.add(of_rows(job, {way.name, way.degrees, rows, 0.0, {}, {}, 0.0, 0.0, "", "", "", ""},
                              threads, progress));
      }
    } catch (const ComputationError&) {
      if (!interrupted()) throw;
      return out;  // ways that are done stay
    }
    out.push_back(narrowing.answer());
  }
  return out;
}

std::string rolls_text(const std::vector<RollAnswer>& rolls)
{
  if (rolls.empty()) return "";
  std::string text =
      "wound onto a rod, the radius of the sheet's middle is at least (and the rod's diameter)\n";
  text += fmt::format("  {:<24}{:>24}{:>24}\n", "", "bent up", "bent down");
  const auto radius = [](const std::optional<double>& r, double rod, const std::string& status,
                         const std::string& confidence) {
    if (!r) return status;
    const std::string around = rod > 0.0 ? fmt::format("{:.2f} mm", rod) : "none";
    return fmt::format("{:.2f} mm{} ({})", *r, confidence_mark(confidence), around);
  };
  for (const RollAnswer& roll : rolls) {
    text += fmt::format("  {:<24}{:>24}{:>24}", roll.name,
                        radius(roll.up, roll.up_rod, roll.up_status, roll.up_confidence),
                        radius(roll.down, roll.down_rod, roll.down_status, roll.down_confidence));
    if (roll.turns > most_turns) text += fmt::format("   ({} rows of cells close into a tube)", roll.rows);
    text += '\n';
  }
  return text + "\n";
}

boost::json::array rolls_json(const std::vector<RollAnswer>& rolls)
{
  boost::json::array out;
  for (const RollAnswer& roll : rolls) {
    boost::json::object entry{{"name", roll.name},
                              {"direction_deg", roll.degrees},
                              {"rows", roll.rows},
                              {"turns", roll.turns},
                              {"up_status", roll.up_status},
                              {"down_status", roll.down_status},
                              {"up_confidence", roll.up_confidence},
                              {"down_confidence", roll.down_confidence}};
    entry["up_radius_mm"] = roll.up ? boost::json::value(*roll.up) : nullptr;
    entry["up_rod_mm"] = roll.up_rod;
    entry["down_rod_mm"] = roll.down_rod;
    entry["down_radius_mm"] = roll.down ? boost::json::value(*roll.down) : nullptr;
    out.push_back(std::move(entry));
  }
  return out;
}

}  // namespace hauberk::maker
