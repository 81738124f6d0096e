#include "design/constraints.hpp"

#include "design/rest_path.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

constexpr int projection_sweeps = 200;

}  // namespace

DesignConstraints::DesignConstraints(std::shared_ptr<const DesignScene> scene, const DesignPoint& start)
    : scene_(std::move(scene))
{
  const Model& m = start.model;
  for (const Link& l : m.links) {
    // Nobody knows how wide a loop is that several primitives form.
    if (std::max(l.a, l.b) >= static_cast<int>(m.bodies.size())) continue;
    add_hole(m, l.a, l.b);
    add_hole(m, l.b, l.a);
  }
  for (const Gap& g : find_gaps(m, start.rest, constrained_range, false)) {
    const bool known = std::any_of(pairs_.begin(), pairs_.end(), [&g](const Pair& p) {
      return p.a == g.a && p.b == g.b && p.image == g.image;
    });
    if (!known) pairs_.push_back({g.a, g.b, g.image});
  }
}

void DesignConstraints::add_hole(const Model& model, int ring, int thread)
{
  // Nor how wide the hole of a tube around a curve, or of a solid, is; links and rest gaps hold it open.
  if (model.bodies[ring].curve || model.bodies[ring].solid || model.bodies[thread].solid) return;
  for (const int k : {quantity_r0, quantity_r1}) {
    const bool known = std::any_of(holes_.begin(), holes_.end(), [&](const Hole& h) {
      return h.ring == ring && h.thread == thread && h.size_index == k;
    });
    if (!known) holes_.push_back({ring, thread, k});
  }
}

double DesignConstraints::hole_room(const Model& model, const Hole& hole) const
{
  const Body& ring = model.bodies[hole.ring];
  const Body& thread = model.bodies[hole.thread];
  return ring.R - ring.r0 - (hole.size_index == quantity_r0 ? thread.r0 : thread.r1) -
         scene_->design.hole_clearance / model.length;
}

void DesignConstraints::add_hole_derivatives(const Model& model, const Hole& hole,
                                             std::span<double> row) const
{
  const auto add = [&](int body, int quantity, double factor) {
    const int element = model.bodies[body].element;
    for (std::size_t v = 0; v < row.size(); ++v) {
      for (const auto& [el, parameter] : scene_->design.variables[v].entries) {
        if (el != element) continue;
        row[v] += factor * model.geometry_derivative(static_cast<std::size_t>(body), quantity, parameter);
      }
    }
  };
  add(hole.ring, quantity_R, 1.0);
  add(hole.ring, quantity_r0, -1.0);
  add(hole.thread, hole.size_index, -1.0);
}

void DesignConstraints::evaluate(const DesignPoint& point, const Model& otherwise, std::span<double> c,
                                 std::span<double> jacobian) const
{
  const std::vector<DesignVariable>& variables = scene_->design.variables;
  const std::size_t nv = variables.size();
  const auto row_of = [&](std::size_t row) { return jacobian.subspan(row * nv, nv); };
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  const Model& m = point.model.bodies.empty() ? otherwise : point.model;
  std::size_t row = 0;
  for (const Hole& h : holes_) {
    c[row] = hole_room(m, h);
    if (!jacobian.empty()) add_hole_derivatives(m, h, row_of(row));
    ++row;
  }
  if (!point.why.empty() && point.rest_gaps.empty()) {  // no rest state: as infeasible as can be said
    for (; row < c.size(); ++row) c[row] = -1.0;
    return;
  }
  const double target = scene_->rest_target(m);
  const Matrix response = jacobian.empty() ? Matrix() : rest_response(point, variables);
  for (const Pair& pair : pairs_) {
    c[row] = response_range;  // farther than that: not binding, no gradient
    const Gap* closest = nullptr;
    for (const Gap& g : point.rest_gaps) {
      if (g.a == pair.a && g.b == pair.b && g.image == pair.image && g.gap - target < c[row]) {
        c[row] = g.gap - target;
        closest = &g;
      }
    }
    if (closest != nullptr && !jacobian.empty()) {
      const Vector d =
          gap_parameter_gradient(*closest, point, variables) + response.transpose() * closest->dy;
      std::copy(d.data(), d.data() + d.size(), row_of(row).begin());
    }
    ++row;
  }
}

bool DesignConstraints::satisfied(const DesignPoint& point, const Model& otherwise) const
{
  std::vector<double> c(count());
  evaluate(point, otherwise, c, {});
  return c.empty() || *std::min_element(c.begin(), c.end()) >= -negligible_violation;
}

std::string DesignConstraints::impossible_hole(const DesignPoint& point) const
{
  const std::vector<DesignVariable>& variables = scene_->design.variables;
  const std::size_t nv = variables.size();
  std::vector<double> c(count()), jacobian(c.size() * nv);
  evaluate(point, point.model, c, jacobian);
  double least = 0.0;
  std::string text;
  for (std::size_t row = 0; row < holes_.size(); ++row) {
    std::vector<double> x = point.x;
    for (std::size_t v = 0; v < nv; ++v) {
      const double slope = jacobian[row * nv + v];
      if (slope != 0.0) x[v] = slope > 0.0 ? variables[v].upper : variables[v].lower;
    }
    const Model most =
        make_model(with_variables(scene_->scene, variables, x), scene_->load, scene_->clearance);
    const double room = hole_room(most, holes_[row]);
    if (room >= least) continue;
    least = room;
    const Gap pair{holes_[row].ring, holes_[row].thread, {}, 0.0, {}, {}, {}};
    text = fmt::format(
        "{0:.6g} {1} is more than the bounds of the variables allow: at most {2:.6g} {1} are left in the "
        "hole of the first of {3}; widen the bounds, or lower it",
        scene_->design.hole_clearance, scene_->scene.length_unit,
        room * most.length + scene_->design.hole_clearance, pair_name(scene_->scene, most, pair));
  }
  return text;
}

std::vector<double> project(std::span<const double> c, std::span<const double> jacobian,
                            std::span<const double> from, const std::vector<double>& goal,
                            const std::vector<DesignVariable>& bounds)
{
  std::vector<double> x = goal;
  for (int sweep = 0; sweep < projection_sweeps; ++sweep) {
    for (std::size_t r = 0; r < c.size(); ++r) {
      const auto row = jacobian.subspan(r * x.size(), x.size());
      double value = c[r], norm = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        value += row[i] * (x[i] - from[i]);
        norm += row[i] * row[i];
      }
      if (value >= 0.0 || norm == 0.0) continue;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] -= value / norm * row[i];
    }
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], bounds[i].lower, bounds[i].upper);
  }
  return x;
}

}  // namespace hauberk
