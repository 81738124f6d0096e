#include "tasks/transition/transition_run.hpp"

#include "contact/published.hpp"
#include "numerics/parallel.hpp"
#include "tasks/transition/jumps.hpp"
#include "tasks/transition/tracks.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

namespace hauberk {
namespace {

/// Intervals of a path that the search for discontinuities starts from, and how often it halves one: enough
/// to follow a dozen discontinuities down to 1e-9 of the path.
constexpr int first_intervals = 64;
constexpr int most_splits = 400;

/// Discontinuities below this part of the largest value are not looked for.
constexpr double smallest_jump = 1e-9;

/// Panels that the quadrature is measured against, relative to those in use: Gauss's rule is then better by
/// orders of magnitude where the integrand is analytic, 16 times where the barrier sets in.
constexpr double finer_panels = 0.5;

/// A contact that moves farther than this between two samples counts as another one; L.
constexpr double contact_reach = 0.5;

MovingPair pair_of(const TransitionSpec& spec, std::size_t path)
{
  return {spec.model, spec.fixed, spec.moving, spec.paths[path].motion};
}

/// The gradient with forces as torques with the arm L: all components in one unit.
double size_of(const PathPoint& p) { return p.gradient.norm(); }

TransitionForce in_file_units(const PathPoint& p, double length)
{
  TransitionForce f;
  f.energy = p.energy;
  for (int k = 0; k < 6; ++k) f.wrench[k] = -p.gradient[k] / (k < 3 ? length : 1.0);
  f.along = -p.slope;
  return f;
}

/// One formulation on one path: an item of work for the threads.
struct CurveItem {
  std::size_t path = 0, curve = 0;
  MovingPair pair;
  ContactSettings settings;
  std::vector<PathPoint> points;
  TransitionCurve result;
  double regularity = std::numeric_limits<double>::infinity();  ///< smallest of all points
  std::size_t same_as = 0;  ///< item of the same path and formulation, itself if it is the first
};

bool is_automatic(const TransitionSpec& spec, std::size_t curve)
{
  return contact_named(spec.contacts[curve]) == ContactChoice::automatic;
}

/// Thrown where KeepGoing says no.
struct Stopped {};

/// `evaluate` that can be interrupted.
PathPoint evaluated(const CurveItem& item, const ContactSettings& settings, double s, int order,
                    const KeepGoing& keep_going)
{
  if (!keep_going()) throw Stopped{};
  return evaluate(item.pair, settings, s, order);
}

void sample_curve(const TransitionSpec& spec, CurveItem& item, const KeepGoing& keep_going)
{
  const int steps = spec.paths[item.path].steps;
  for (int k = 0; k <= steps; ++k) {
    item.points.push_back(evaluated(item, item.settings, static_cast<double>(k) / steps, 1, keep_going));
    item.result.largest_energy = std::max(item.result.largest_energy, std::abs(item.points.back().energy));
    item.result.largest_force = std::max(item.result.largest_force, size_of(item.points.back()));
  }
}

TransitionJump relative(const Jump& jump, double largest)
{
  if (largest <= 0.0) return {};
  return {jump.size / largest, jump.at, jump.resolution / largest};
}

void search_jumps(CurveItem& item, const KeepGoing& keep_going)
{
  // Both searches halve many of the same intervals.
  std::map<double, PathPoint> known;
  const auto f = [&](double s) {
    const auto found = known.find(s);
    return found != known.end()
               ? found->second
               : known.emplace(s, evaluated(item, item.settings, s, 2, keep_going)).first->second;
  };
  const auto search = [&](Quantity quantity, double largest) {
    const Jump jump = largest_jump(f, quantity, first_intervals, most_splits, smallest_jump * largest);
    return relative(jump, largest);
  };
  item.result.energy = search(Quantity::energy, item.result.largest_energy);
  item.result.force = search(Quantity::force, item.result.largest_force);
  item.result.evaluations = static_cast<int>(known.size());
  for (const auto& [s, point] : known) item.regularity = std::min(item.regularity, point.regularity);
}

void measure_quadrature(CurveItem& item, const KeepGoing& keep_going)
{
  if (!traits(item.settings.formulation).is_integral) return;
  ContactSettings finer = item.settings;
  finer.panel_ratio *= finer_panels;
  double energy = 0.0, force = 0.0;
  for (const PathPoint& p : item.points) {
    const PathPoint better = evaluated(item, finer, p.s, 1, keep_going);
    energy = std::max(energy, std::abs(better.energy - p.energy));
    force = std::max(force, (better.gradient - p.gradient).norm());
  }
  const auto over = [](double x, double largest) { return largest > 0.0 ? x / largest : 0.0; };
  item.result.quadrature = {over(energy, item.result.largest_energy), over(force, item.result.largest_force)};
}

void compute_curve(const TransitionSpec& spec, CurveItem& item, const KeepGoing& keep_going)
{
  sample_curve(spec, item, keep_going);
  search_jumps(item, keep_going);
  const bool merges = item.settings.formulation == Formulation::nearest &&
                      item.regularity < least_regular_curvature(item.settings.g_hat);
  if (is_automatic(spec, item.curve) && merges) {
    // What a stage does that meets a merge on its way: it begins again with arc.
    item.settings.formulation = Formulation::arc;
    item.result.formulation = name_of(Formulation::arc);
    item.result.largest_energy = item.result.largest_force = 0.0;
    item.points.clear();
    sample_curve(spec, item, keep_going);
    search_jumps(item, keep_going);
  }
  measure_quadrature(item, keep_going);
}

TransitionPath sampled_path(const TransitionSpec& spec, std::size_t path)
{
  const TransitionMotion& from = spec.paths[path];
  const MovingPair pair = pair_of(spec, path);
  const double length = spec.model->length;
  TransitionPath out;
  out.name = from.name;
  out.rotates = from.motion.angle_from != from.motion.angle_to;
  out.axis = out.rotates ? "rotation (degrees)" : fmt::format("translation ({})", spec.length_unit);
  for (int k = 0; k <= from.steps; ++k) {
    TransitionSample sample;
    sample.s = static_cast<double>(k) / from.steps;
    sample.degrees = from.motion.angle(sample.s) / degree;
    sample.shift = (from.motion.shift(sample.s) - from.motion.shift_from).norm() * length;
    sample.minima = minima_at(pair, spec.range, sample.s);
    out.samples.push_back(std::move(sample));
  }
  number_contacts(out.samples, contact_reach * length);
  return out;
}

}  // namespace

std::vector<std::pair<std::size_t, std::string>> transition_problems(const TransitionSpec& spec)
{
  std::vector<std::pair<std::size_t, std::string>> out;
  for (std::size_t p = 0; p < spec.paths.size(); ++p) {
    const MovingPair pair = pair_of(spec, p);
    for (int k = 0; k <= spec.paths[p].steps; ++k) {
      const double s = static_cast<double>(k) / spec.paths[p].steps;
      if (gap_at(pair, s, 1e-6) > 0.0) continue;
      out.emplace_back(p,
                       fmt::format("the surfaces touch or overlap at step {} of {}; keep them apart on the "
                                   "whole path",
                                   k, spec.paths[p].steps));
      break;
    }
  }
  return out;
}

namespace {

/// A curve for every path and formulation asked for; what is the same as an earlier one is computed once.
std::vector<CurveItem> curve_items(const TransitionSpec& spec)
{
  std::vector<CurveItem> items;
  for (std::size_t p = 0; p < spec.paths.size(); ++p) {
    for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
      CurveItem item;
      item.path = p;
      item.curve = c;
      item.pair = pair_of(spec, p);
      item.settings = {formulation_at(contact_named(spec.contacts[c]), spec.g_hat, spec.schedule), spec.g_hat,
                       spec.model->clearance};
      item.result.contact = spec.contacts[c];
      item.result.formulation = name_of(item.settings.formulation);
      item.same_as = items.size();
      for (std::size_t k = 0; k < items.size(); ++k) {
        // Automatic with nearest may change to arc on the way.
        const bool same = items[k].path == p && items[k].settings.formulation == item.settings.formulation &&
                          (item.settings.formulation != Formulation::nearest ||
                           is_automatic(spec, items[k].curve) == is_automatic(spec, c));
        if (same) item.same_as = std::min(item.same_as, k);
      }
      items.push_back(std::move(item));
    }
  }
  return items;
}

/// Paths and curves as far as they were computed.
struct Computed {
  std::vector<TransitionPath> paths;
  std::vector<CurveItem> items;
  std::vector<char> done;             ///< paths, then items
  std::vector<std::string> failures;  ///< of the same
};

void compute(const TransitionSpec& spec, unsigned threads, const TransitionObserver& observer,
             const KeepGoing& keep_going, Computed& out)
{
  const std::size_t paths = out.paths.size(), total = out.done.size();
  std::mutex mutex;  // guards the observer and its count
  std::size_t finished = 0;
  parallel_for(total, threads, [&](std::size_t i) {
    if (!keep_going()) return;
    try {
      if (i < paths) {
        out.paths[i] = sampled_path(spec, i);
      } else if (CurveItem& item = out.items[i - paths]; item.same_as == i - paths) {
        compute_curve(spec, item, keep_going);
      }
    } catch (const Stopped&) {
      return;
    } catch (const ComputationError& error) {
      const std::size_t path = i < paths ? i : out.items[i - paths].path;
      out.failures[i] = fmt::format("path {}: {}", spec.paths[path].name, error.what());
      return;
    }
    out.done[i] = 1;
    const std::lock_guard lock(mutex);
    observer(++finished, total);
  });
}

/// Rows and pictures have the same curves on every path: one that lacks some is left out.
bool is_whole(const Computed& computed, std::size_t path)
{
  const std::size_t paths = computed.paths.size();
  return computed.done[path] != 0 &&
         std::all_of(computed.items.begin(), computed.items.end(), [&](const CurveItem& item) {
           return item.path != path || computed.done[paths + item.same_as] != 0;
         });
}

/// The path with its curves.
TransitionPath with_curves(const TransitionSpec& spec, Computed& computed, std::size_t index)
{
  TransitionPath& path = computed.paths[index];
  for (CurveItem& item : computed.items) {
    if (item.path != index) continue;
    if (const CurveItem& same = computed.items[item.same_as]; &same != &item) {
      const std::string contact = item.result.contact;
      item.points = same.points;
      item.result = same.result;
      item.result.contact = contact;
    }
    path.curves.push_back(item.result);
    for (std::size_t k = 0; k < path.samples.size(); ++k)
      path.samples[k].forces.push_back(in_file_units(item.points[k], spec.model->length));
  }
  return std::move(path);
}

}  // namespace

TransitionResult run_transition(const TransitionSpec& spec, unsigned threads,
                                const TransitionObserver& observer, const KeepGoing& keep_going)
{
  const Model& m = *spec.model;
  TransitionResult out;
  out.length = m.length;
  out.length_unit = spec.length_unit;
  out.activation_distance = spec.g_hat * m.length;
  out.range = spec.range * m.length;
  out.clearance = m.clearance * m.length;
  out.eigenvalue_threshold = published::lambda_bar * out.activation_distance * out.activation_distance;

  Computed computed;
  computed.items = curve_items(spec);
  computed.paths.resize(spec.paths.size());
  computed.done.resize(computed.paths.size() + computed.items.size());
  computed.failures.resize(computed.done.size());
  compute(spec, threads, observer, keep_going, computed);
  for (const std::string& failure : computed.failures)
    if (out.message.empty()) out.message = failure;
  for (std::size_t p = 0; p < computed.paths.size(); ++p)
    if (is_whole(computed, p)) out.paths.push_back(with_curves(spec, computed, p));
  return out;
}

}  // namespace hauberk
