#include "limits/room_polish.hpp"

#include "equilibrium/gaps.hpp"
#include "model/links.hpp"
#include "numerics/damped_bfgs.hpp"
#include "numerics/quadratic_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hauberk {
namespace {

/// Longest step, L; gaps that are larger than the smallest by three of them cannot become it.
constexpr double longest_program_step = 0.02, range_of_programs = 3.0;
constexpr int most_programs = 200, most_parts = 16;
constexpr double some_gain = 1e-4;    ///< part of the predicted gain that a step must bring
constexpr double least_gain = 1e-12;  ///< predicted, L
/// Makes the program in t strictly convex; multipliers then add up to 1 less this times t.
constexpr double curvature_of_gain = 1e-6;

/// Gaps that may become the smallest, with gradients in scaled unknowns.
struct Place {
  State state;
  std::vector<Gap> gaps;
  std::vector<Vector> normals;
  double smallest = std::numeric_limits<double>::infinity();
};

class Polish {
 public:
  Polish(const Model& m, Cell cell, const KeepGoing& keep_going)
      : m_(m), cell_(cell), keep_going_(keep_going), root_(m.metric.cwiseSqrt().cwiseInverse())
  {
  }

  State run(const State& state, double smallest)
  {
    Place now = at(state, smallest);
    bfgs_.reset(m_.dofs(), 1.0);
    for (int steps = 0; steps < most_programs && !now.gaps.empty() && keep_going_(); ++steps) {
      const QuadraticSolution program = solve(program_of(now));
      if (program.status != QuadraticSolution::Status::solved) break;
      const double gain = program.x[m_.dofs()];
      if (!(gain > least_gain)) break;
      Vector step = program.x.head(m_.dofs());
      if (step.norm() > longest_program_step) step *= longest_program_step / step.norm();
      std::optional<Place> next = further(now, step, gain);
      if (!next && bfgs_.fresh()) break;
      if (next)
        learn(now, *next, program.multipliers);
      else
        bfgs_.reset(m_.dofs(), 1.0);
      if (next) now = std::move(*next);
    }
    return now.state;
  }

 private:
  /// `near`: the smallest gap here, or of a state a step away.
  Place at(const State& state, double near) const
  {
    Place out{state, {}, {}};
    if (!std::isfinite(near)) return out;
    out.gaps = find_gaps(m_, state, near + range_of_programs * longest_program_step, true);
    for (const Gap& gap : out.gaps) {
      Vector normal = root_.cwiseProduct(free_part(m_, gap.dy));
      if (cell_ != Cell::free) normal.head(m_.macro_count).setZero();
      out.normals.push_back(std::move(normal));
      out.smallest = std::min(out.smallest, gap.gap);
    }
    return out;
  }

  /// In the step and the gain of the smallest gap.
  QuadraticProgram program_of(const Place& now) const
  {
    const Eigen::Index n = m_.dofs(), gaps = static_cast<Eigen::Index>(now.gaps.size()),
                       walls = static_cast<Eigen::Index>(m_.walls.size());
    QuadraticProgram q;
    q.G = Matrix::Zero(n + 1, n + 1);
    q.G.topLeftCorner(n, n) = bfgs_.matrix();
    q.G(n, n) = curvature_of_gain;
    q.a = -Vector::Unit(n + 1, n);
    q.A = Matrix::Zero(gaps + walls, n + 1);
    q.b = Vector::Zero(gaps + walls);
    for (Eigen::Index k = 0; k < gaps; ++k) {
      const auto i = static_cast<std::size_t>(k);
      q.A.row(k).head(n) = now.normals[i];
      q.A(k, n) = -1.0;
      q.b[k] = now.smallest - now.gaps[i].gap;
    }
    for (Eigen::Index w = 0; w < walls; ++w) {
      const LinearInequality& wall = m_.walls[w];
      q.b[gaps + w] = -wall.offset;
      for (const LinearTerm& t : wall.terms) {
        q.b[gaps + w] -= t.coefficient * now.state.e[t.element * m_.coordinate_count + t.coordinate];
        q.A(gaps + w, m_.offset(t.element) + t.coordinate) += t.coefficient;
      }
    }
    return q;
  }

  /// The first of the step, its half, its quarter and so on that brings some of what was predicted.
  std::optional<Place> further(const Place& now, const Vector& step, double gain) const
  {
    double part = 1.0;
    for (int halved = 0; halved <= most_parts; ++halved, part *= 0.5) {
      const State trial = advanced(m_, now.state, root_.cwiseProduct(step), part);
      if (!m_.load->admissible(trial.macro_values())) continue;
      Place next = at(trial, now.smallest);
      if (next.gaps.empty() || !(next.smallest > now.smallest + some_gain * part * gain)) continue;
      if (links_kept(m_, trial) && !meshes_meet(m_, trial)) return next;
    }
    return std::nullopt;
  }

  /// The change of the gradient of -sum f_k g_k; nothing where a gap that presses is gone.
  void learn(const Place& now, const Place& next, const Vector& forces)
  {
    Vector change = Vector::Zero(m_.dofs());
    for (std::size_t k = 0; k < now.gaps.size(); ++k) {
      const double f = forces[k];
      if (f <= 0.0) continue;
      const Vector* same = nullptr;
      for (std::size_t j = 0; j < next.gaps.size(); ++j) {
        const Gap &a = now.gaps[k], &b = next.gaps[j];
        if (a.a != b.a || a.b != b.b || a.image != b.image) continue;
        const Vector& normal = next.normals[j];
        if (same == nullptr || (normal - now.normals[k]).norm() < (*same - now.normals[k]).norm())
          same = &normal;
      }
      if (same == nullptr) return;
      change -= f * (*same - now.normals[k]);
    }
    bfgs_.update(difference(m_, now.state, next.state).cwiseQuotient(root_), change);
  }

  const Model& m_;
  Cell cell_;
  const KeepGoing& keep_going_;
  Vector root_;
  DampedBfgs bfgs_;
};

}  // namespace

State polished_room(const Model& m, const State& state, double smallest, Cell cell,
                    const KeepGoing& keep_going)
{
  if (m.sparse()) return state;
  return Polish(m, cell, keep_going).run(state, smallest);
}

}  // namespace hauberk
