#include <hauberk/transition/run.hpp>

#include <hauberk/contact/published.hpp>
#include <hauberk/parallel.hpp>
#include <hauberk/transition/jumps.hpp>
#include <hauberk/transition/tracks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
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

ContactChoice choice_of(const std::string& contact)
{
  if (contact == "nearest") return ContactChoice::nearest;
  if (contact == "arc") return ContactChoice::arc;
  return contact == "published" ? ContactChoice::published : ContactChoice::automatic;
}

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
  for (int k = 0; k < 6; ++k) f.wrench[static_cast<std::size_t>(k)] = -p.gradient[k] / (k < 3 ? length : 1.0);
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
  std::size_t same_as = 0;  ///< item of the same path and formulation, itself if it is the first
};

void sample_curve(const TransitionSpec& spec, CurveItem& item)
{
  const int steps = spec.paths[item.path].steps;
  for (int k = 0; k <= steps; ++k) {
    item.points.push_back(evaluate(item.pair, item.settings, static_cast<double>(k) / steps, 1));
    item.result.largest_energy = std::max(item.result.largest_energy, std::abs(item.points.back().energy));
    item.result.largest_force = std::max(item.result.largest_force, size_of(item.points.back()));
  }
}

TransitionJump relative(const Jump& jump, double largest)
{
  if (largest <= 0.0) return {};
  return {jump.size / largest, jump.at, jump.resolution / largest};
}

void search_jumps(CurveItem& item)
{
  // Both searches halve many of the same intervals.
  std::map<double, PathPoint> known;
  const auto f = [&](double s) {
    const auto found = known.find(s);
    return found != known.end() ? found->second
                                : known.emplace(s, evaluate(item.pair, item.settings, s, 2)).first->second;
  };
  const auto search = [&](Quantity quantity, double largest) {
    const Jump jump = largest_jump(f, quantity, first_intervals, most_splits, smallest_jump * largest);
    return relative(jump, largest);
  };
  item.result.energy = search(Quantity::energy, item.result.largest_energy);
  item.result.force = search(Quantity::force, item.result.largest_force);
  item.result.evaluations = static_cast<int>(known.size());
}

void measure_quadrature(CurveItem& item)
{
  if (item.settings.formulation != Formulation::arc) return;
  ContactSettings finer = item.settings;
  finer.panel_ratio *= finer_panels;
  double energy = 0.0, force = 0.0;
  for (const PathPoint& p : item.points) {
    const PathPoint better = evaluate(item.pair, finer, p.s, 1);
    energy = std::max(energy, std::abs(better.energy - p.energy));
    force = std::max(force, (better.gradient - p.gradient).norm());
  }
  const auto over = [](double x, double largest) { return largest > 0.0 ? x / largest : 0.0; };
  item.result.quadrature = {over(energy, item.result.largest_energy), over(force, item.result.largest_force)};
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

TransitionResult run_transition(const TransitionSpec& spec, unsigned threads,
                                const TransitionObserver& observer)
{
  const Model& m = *spec.model;
  TransitionResult out;
  out.length = m.length;
  out.length_unit = spec.length_unit;
  out.activation_distance = spec.g_hat * m.length;
  out.range = spec.range * m.length;
  out.clearance = m.clearance * m.length;
  out.eigenvalue_threshold = published::lambda_bar * out.activation_distance * out.activation_distance;

  std::vector<CurveItem> items;
  for (std::size_t p = 0; p < spec.paths.size(); ++p) {
    for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
      CurveItem item{p, c, pair_of(spec, p), {}, {}, {}, 0};
      item.settings = {formulation_at(choice_of(spec.contacts[c]), spec.g_hat, spec.schedule), spec.g_hat,
                       m.clearance};
      item.result.contact = spec.contacts[c];
      item.result.formulation = name_of(item.settings.formulation);
      item.same_as = items.size();
      for (std::size_t k = 0; k < items.size(); ++k) {
        const bool same = items[k].path == p && items[k].settings.formulation == item.settings.formulation;
        if (same) item.same_as = std::min(item.same_as, k);
      }
      items.push_back(std::move(item));
    }
  }
  const std::size_t paths = spec.paths.size(), total = paths + items.size();
  std::vector<TransitionPath> sampled(paths);
  std::vector<char> done(total, 0);
  std::mutex mutex;  // guards the observer and its count
  std::size_t finished = 0;
  std::atomic<bool> stop = false;
  parallel_for(total, threads, [&](std::size_t i) {
    if (stop) return;
    if (i < paths) {
      sampled[i] = sampled_path(spec, i);
    } else {
      CurveItem& item = items[i - paths];
      if (item.same_as == i - paths) {
        sample_curve(spec, item);
        search_jumps(item);
        measure_quadrature(item);
      }
    }
    done[i] = 1;
    const std::lock_guard lock(mutex);
    if (!observer(++finished, total)) stop = true;
  });
  for (std::size_t p = 0; p < paths; ++p) {
    if (done[p] == 0) continue;
    TransitionPath& path = sampled[p];
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::size_t same = items[i].same_as;
      if (items[i].path != p || done[paths + same] == 0) continue;
      if (same != i) {
        const std::string contact = items[i].result.contact;
        items[i].points = items[same].points;
        items[i].result = items[same].result;
        items[i].result.contact = contact;
      }
      path.curves.push_back(items[i].result);
      for (std::size_t k = 0; k < path.samples.size(); ++k)
        path.samples[k].forces.push_back(in_file_units(items[i].points[k], m.length));
    }
    out.paths.push_back(std::move(path));
  }
  return out;
}

}  // namespace hauberk
