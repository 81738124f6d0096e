#include "tasks/transition/evaluation.hpp"

#include "contact/body_pair.hpp"
#include "geometry/separation.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Calls f(A, B, a, b) for every body A of the fixed and B of the moving element, a and b their places in it.
template <typename F>
void for_bodies(const MovingPair& pair, F&& f)
{
  const Model& m = *pair.model;
  const std::size_t i = pair.fixed, j = pair.moving;
  for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
    for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
      f(m.bodies[a], m.bodies[b], a - m.first_body[i], b - m.first_body[j]);
    }
  }
}

const Pose& rest_of(const MovingPair& pair, int element) { return pair.model->rest[element]; }

/// What pair_contact gives in (x_A - x_B, w_A, w_B) for the unknowns (x_B, w_B) of the moving element B.
struct MovingTerms {
  double energy = 0.0;
  Vec6 gradient = Vec6::Zero();
  Mat6 hessian = Mat6::Zero();
};

void add_moving(const PairTerms& t, MovingTerms& out)
{
  constexpr std::array<int, 6> from{0, 1, 2, 6, 7, 8};
  const auto sign = [](int k) { return k < 3 ? -1.0 : 1.0; };
  out.energy += t.energy;
  for (int i = 0; i < 6; ++i) {
    const int row = from[i];
    out.gradient[i] += sign(i) * t.gradient[row];
    for (int j = 0; j < 6; ++j) out.hessian(i, j) += sign(i) * sign(j) * t.hessian(row, from[j]);
  }
}

}  // namespace

PathPoint evaluate(const MovingPair& pair, const ContactSettings& settings, double s, int order)
{
  const Pose& rest = rest_of(pair, pair.moving);
  const Pose pose = moved(pair.motion, rest, s);
  PathPoint out;
  out.s = s;
  MovingTerms sum;
  for_bodies(pair, [&](const Body& A, const Body& B, int, int) {
    const PairContact c = pair_contact(A, rest_of(pair, pair.fixed), B, pose, settings, order);
    add_moving(c.terms, sum);
    out.regularity = std::min(out.regularity, c.regularity);
    // An overlapping contact has no energy: it would look like a discontinuity.
    if (!(c.min_gap > 0.0))
      throw ComputationError(fmt::format("the surfaces touch or overlap at s = {:g}", s));
  });
  out.energy = sum.energy;
  if (order < 1) return out;
  const Vec6 v = velocity(pair.motion, rest, s);
  out.gradient = sum.gradient;
  out.slope = sum.gradient.dot(v);
  if (order < 2) return out;
  // The unknown w turns the pose as it is, so its derivative along the path is not the Hessian's product
  // alone: exp(u) exp(w ds) = exp(u + w ds + 1/2 u x w ds + ...), which adds 1/2 w x dE/du.
  out.gradient_slope = sum.hessian * v;
  const Vec3 w = v.tail<3>(), torque = sum.gradient.tail<3>();
  out.gradient_slope.tail<3>() += 0.5 * w.cross(torque);
  return out;
}

std::vector<TransitionMinimum> minima_at(const MovingPair& pair, double range, double s)
{
  const Pose pose = moved(pair.motion, rest_of(pair, pair.moving), s);
  const double length = pair.model->length;
  std::vector<TransitionMinimum> out;
  for_bodies(pair, [&](const Body& A, const Body& B, int a, int b) {
    int evaluations = 0;
    for (const ContactMinimum& m :
         contact_minima(A, rest_of(pair, pair.fixed), B, pose, range, pair.model->clearance, evaluations)) {
      TransitionMinimum found;
      found.primitives = {a, b};
      found.distance = m.distance * length;
      if (std::isfinite(m.chart_eigenvalue)) found.eigenvalue = m.chart_eigenvalue * length * length;
      found.relative_curvature = m.relative_curvature;
      found.on_fixed = m.on_a * length;
      found.on_moving = m.on_b * length;
      out.push_back(found);
    }
  });
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return out;
}

double gap_at(const MovingPair& pair, double s, double enough)
{
  const Pose pose = moved(pair.motion, rest_of(pair, pair.moving), s);
  double gap = enough;
  for_bodies(pair, [&](const Body& A, const Body& B, int, int) {
    gap =
        std::min(gap, separation(A, rest_of(pair, pair.fixed), B, pose, pair.model->clearance, enough).lower);
  });
  return gap;
}

}  // namespace hauberk
