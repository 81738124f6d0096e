#include "equilibrium/relaxation.hpp"

#include "equilibrium/gaps.hpp"
#include "model/links.hpp"
#include "numerics/interrupted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk {
namespace {

/// Weight of staying where the rest state was, against violated gaps; the violation left behind is about
/// this fraction of the motion.
constexpr double anchor_weight = 1e-6;
constexpr double room = 1e-3;  ///< relative to the target: aim a little beyond it

/// Sum of squared violations and the anchor, with Gauss-Newton terms.
struct Penalty {
  double value = 0.0, worst = 0.0, smallest = 0.0;
  Vector gradient;
  Matrix hessian;
};

Penalty penalty(const Model& m, const State& start, const State& s, double target, Cell cell)
{
  Penalty p;
  const Vector away = difference(m, start, s).cwiseProduct(m.metric);
  p.value = 0.5 * anchor_weight * away.dot(difference(m, start, s));
  p.gradient = anchor_weight * away;
  p.hessian = Matrix::Zero(m.dofs(), m.dofs());
  p.hessian.diagonal() = anchor_weight * m.metric;
  p.smallest = std::numeric_limits<double>::infinity();
  for (const Gap& g : find_gaps(m, s, target, true)) {
    const double r = target - g.gap;
    p.smallest = std::min(p.smallest, g.gap);
    if (r <= 0.0) continue;
    p.worst = std::max(p.worst, r);
    p.value += 0.5 * r * r;
    p.gradient -= r * g.dy;
    p.hessian.noalias() += g.dy * g.dy.transpose();
  }
  for (const LinearInequality& w : m.walls) {
    double g = w.offset;
    for (const auto& t : w.terms) g += t.coefficient * s.e[t.element * m.coordinate_count + t.coordinate];
    if (g < 0.0) {
      p.value += 0.5 * g * g;
      for (const auto& t : w.terms) {
        p.gradient[m.offset(t.element) + t.coordinate] += g * t.coefficient;
        for (const auto& r : w.terms) {
          p.hessian(m.offset(t.element) + t.coordinate, m.offset(r.element) + r.coordinate) +=
              t.coefficient * r.coefficient;
        }
      }
    }
  }
  if (cell == Cell::free) return p;
  p.gradient.head(m.macro_count).setZero();
  p.hessian.leftCols(m.macro_count).setZero();
  p.hessian.topRows(m.macro_count).setZero();
  p.hessian.diagonal().head(m.macro_count).setOnes();
  return p;
}

}  // namespace

Relaxed relax(const Model& m, const State& start, double target, Cell cell, int most_iterations,
              const std::function<bool()>& keep_going)
{
  Relaxed out;
  out.state = start;
  const double aim = target * (1.0 + room);
  Penalty now = penalty(m, start, start, aim, cell);
  double damping = 1e-4;
  for (int it = 0; it < most_iterations && now.smallest < target; ++it) {
    if (!keep_going()) throw Interrupted();
    Matrix A = now.hessian;
    A.diagonal() += damping * m.metric;
    Vector dy = free_part(m, -A.llt().solve(now.gradient));
    const double size = step_norm(m, dy);
    if (size > 0.1) dy *= 0.1 / size;
    const State trial = advanced(m, out.state, dy, 1.0);
    const Penalty next = penalty(m, start, trial, aim, cell);
    if (next.value < now.value) {
      out.state = trial;
      const double gain = (now.value - next.value) / std::max(now.value, 1e-300);
      now = next;
      out.moved = true;
      damping = std::max(0.1 * damping, 1e-12);
      if (gain < 1e-10) break;
    } else {
      damping *= 10.0;
      if (damping > 1e6) break;
    }
  }
  out.smallest = now.smallest;
  out.largest_motion = largest_motion(m, difference(m, start, out.state));
  if (!links_kept(m, out.state)) {
    out.problem = "relaxation would undo a link";
  } else if (now.smallest < target - 1e-12) {
    out.problem = fmt::format("the nearest state with room leaves a gap of {:.3g} where {:.3g} is needed",
                              now.smallest * m.length, target * m.length);
  }
  return out;
}

}  // namespace hauberk
