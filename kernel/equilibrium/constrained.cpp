#include "equilibrium/constrained.hpp"

#include "equilibrium/gaps.hpp"
#include "model/links.hpp"
#include "numerics/damped_bfgs.hpp"
#include "numerics/quadratic_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace hauberk {
namespace {

/// Longest step, L, and as part of the thinnest half-axis: no tube passes through another.
constexpr double longest_step = 0.1, longest_step_of_tube = 0.5;
/// Gaps within so many longest steps are looked at.
constexpr double range_of_step = 3.0;
/// At the end: forces miss the load by this part of it, gaps the margin by this part of it or by rounding
/// (L).
constexpr double enough_balance = 1e-7, kept = 1e-3, rounding = 1e-14;
constexpr double penalty_of_force = 1.5;  ///< penalty of a violation over the largest multiplier
constexpr double enough = 1e-4;           ///< part of the predicted improvement that a step must bring
constexpr std::size_t remembered = 5;  ///< values of the penalty function; curved gaps make it rise at times
constexpr int most_halvings = 19;      ///< of a step
constexpr int most_escapes = 5;        ///< saddles left in one solve
/// Steps of Newton's method that tests for a saddle, and the gain (of the value) after which it has left one.
constexpr int steps_of_test = 300;
constexpr double left_behind = 1e-3;
/// A state further by more than so many times what the margin takes is further than the limit would be.
constexpr double beyond_limit = 2.0;

/// A gap or wall with its scaled gradient.
struct Row {
  int a = 0, b = 0;  ///< bodies; walls: a = its number, b = -1
  Image image{};
  double gap = 0.0;
  Vector normal;
  bool same_pair(const Row& o) const { return a == o.a && b == o.b && image == o.image; }
};

struct Point {
  State state;
  std::vector<Gap> gaps;
  std::vector<Row> rows;  ///< gaps, then walls
  Vector gradient;        ///< of the objective, scaled, over the norm of the load
  double objective = 0.0;
  double violation = 0.0;  ///< sum of what gaps lack
  double worst = 0.0;      ///< most that one lacks

  Matrix normals() const
  {
    Matrix out(static_cast<Eigen::Index>(rows.size()), gradient.size());
    for (std::size_t k = 0; k < rows.size(); ++k) out.row(k) = rows[k].normal;
    return out;
  }
};

class ConstrainedSearch {
 public:
  ConstrainedSearch(const Model& m, const State& start, const Vector& load, const Schedule& schedule,
                    const KeepGoing& keep_going)
      : m_(m),
        load_(load),
        schedule_(schedule),
        most_iterations_(schedule.most_iterations),
        keep_going_(keep_going),
        margin_(constrained_margin(schedule)),
        size_(std::sqrt((load.cwiseAbs2().array() / m.metric.head(m.macro_count).array()).sum())),
        root_(m.metric.cwiseSqrt().cwiseInverse())
  {
    double thinnest = std::numeric_limits<double>::infinity();
    for (const Body& b : m.bodies) thinnest = std::min({thinnest, b.r0, b.r1});
    deepest_ = longest_step_of_tube * thinnest;
    longest_ = std::min(longest_step, deepest_);
    out_.stage.contact = {Formulation::nearest, schedule.last, m.clearance};
    out_.stage.contact.threads = schedule.threads;
    out_.stage.ccd = CollisionCheck::sampled;
    out_.stage.mu = 1.0;
    out_.stage.target = schedule.target;
    now_ = at(start);
    forces_ = Vector::Zero(static_cast<Eigen::Index>(now_.rows.size()));
  }

  Locked run()
  {
    bfgs_.reset(m_.dofs(), 1.0);
    bool fresh = true;  // B is the identity
    for (;; ++out_.iterations) {
      if (!keep_going_()) return finish(LockStatus::interrupted, "interrupted");
      if (runaway()) return finish(LockStatus::unbounded, "the strain leaves every bound");
      if (std::string why = not_a_sheet(m_, now_.state); !why.empty())
        return finish(LockStatus::not_a_sheet, std::move(why));
      QuadraticSolution step = direction();
      if (step.status != QuadraticSolution::Status::solved)
        return finish(LockStatus::stalled, "no step keeps the linearised gaps");
      forces_ = step.multipliers;
      residual_ = (now_.gradient - now_.normals().transpose() * forces_).norm();
      const double to_gain =
          std::abs(now_.gradient.dot(step.x));  // by gaps that press and are wider than the margin
      if (residual_ < enough_balance && std::max(now_.worst, to_gain) < std::max(kept * margin_, rounding)) {
        if (!leaves_saddle(fresh)) {
          return keep_going_() ? finish(LockStatus::locked, untested_)
                               : finish(LockStatus::interrupted, "interrupted");
        }
        if (++escapes_ > most_escapes) return stalled("one saddle after the other");
        continue;
      }
      if (out_.iterations >= most_iterations_) return stalled("no balance of forces");
      const double norm = step.x.norm();
      const Vector d = norm > longest_ ? Vector(longest_ / norm * step.x) : step.x;
      if (advance(d)) {
        fresh = false;
        continue;
      }
      if (fresh) return stalled("no step improves the penalty function");
      bfgs_.reset(m_.dofs(), 1.0);
      fresh = true;
    }
  }

 private:
  Vector scaled(const Vector& y) const { return root_.cwiseProduct(free_part(m_, y)); }

  Point at(State state)
  {
    Point p;
    p.gaps = find_gaps(m_, state, range_of_step * longest_, true, &out_.evaluations);
    p.rows.reserve(p.gaps.size() + m_.walls.size());
    for (const Gap& g : p.gaps) p.rows.push_back({g.a, g.b, g.image, g.gap, scaled(g.dy)});
    for (std::size_t w = 0; w < m_.walls.size(); ++w) {
      Row row{static_cast<int>(w), -1, {}, m_.walls[w].offset, Vector::Zero(m_.dofs())};
      for (const LinearTerm& t : m_.walls[w].terms) {
        row.gap += t.coefficient * state.e[t.element * m_.coordinate_count + t.coordinate];
        row.normal[m_.offset(t.element) + t.coordinate] += t.coefficient;
      }
      row.normal = scaled(row.normal);
      p.rows.push_back(std::move(row));
    }
    for (const Row& r : p.rows) {
      p.violation += std::max(0.0, margin_ - r.gap);
      p.worst = std::max(p.worst, margin_ - r.gap);
    }
    Vector slope = Vector::Zero(m_.dofs());
    slope.head(m_.macro_count) = -driving_load(m_, state, load_, out_.stage) / size_;
    p.gradient = scaled(slope);
    p.objective = -load_.dot(state.macro) / size_;
    if (std::isfinite(out_.stage.target))
      p.objective += 0.5 * (load_ - driving_load(m_, state, load_, out_.stage)).dot(state.macro) / size_;
    p.state = std::move(state);
    return p;
  }

  /// Where linearised gaps contradict each other only a part of what they lack is asked for.
  QuadraticSolution direction() const
  {
    QuadraticProgram q;
    q.G = bfgs_.matrix();
    q.a = now_.gradient;
    q.A = now_.normals();
    q.b.resize(q.A.rows());
    QuadraticSolution s;
    for (const double part : {1.0, 0.5, 0.1, 0.0}) {
      for (std::size_t k = 0; k < now_.rows.size(); ++k) {
        const double lacks = margin_ - now_.rows[k].gap;
        q.b[k] = lacks > 0.0 ? part * lacks : lacks;
      }
      s = solve(q);
      if (s.status == QuadraticSolution::Status::solved) break;
    }
    return s;
  }

  /// Takes a part of d that improves the penalty function, and learns its curvature.
  bool advance(const Vector& d)
  {
    penalty_ = std::max(penalty_, forces_.size() > 0 ? penalty_of_force * forces_.maxCoeff() : 0.0);
    const auto value = [this](const Point& p) { return p.objective + penalty_ * p.violation; };
    past_.emplace_back(now_.objective, now_.violation);
    if (past_.size() > remembered) past_.pop_front();
    double worst = value(now_);
    for (const auto& [objective, violation] : past_)
      worst = std::max(worst, objective + penalty_ * violation);
    const double slope = now_.gradient.dot(d) - penalty_ * now_.violation;
    double part = 1.0;
    for (int halved = 0; halved <= most_halvings; ++halved, part *= 0.5) {
      const Vector step = part * d;
      State trial = advanced(m_, now_.state, root_.cwiseProduct(step), 1.0);
      if (!m_.load->admissible(trial.macro_values())) continue;
      Point next = at(std::move(trial));
      if (next.worst > deepest_ || value(next) > worst + enough * part * std::min(slope, 0.0) + rounding ||
          !links_kept(m_, next.state)) {
        continue;
      }
      if (const std::optional<Vector> change = gradient_change(next)) bfgs_.update(step, *change);
      now_ = std::move(next);
      forces_ = Vector::Zero(static_cast<Eigen::Index>(now_.rows.size()));
      return true;
    }
    return false;
  }

  /// Change of the Lagrangian's gradient at the forces of this step; null: a gap that presses is gone.
  std::optional<Vector> gradient_change(const Point& next) const
  {
    Vector out = next.gradient - now_.gradient;
    for (std::size_t k = 0; k < now_.rows.size(); ++k) {
      const double f = forces_[k];
      if (f <= 0.0) continue;
      const Row& old = now_.rows[k];
      const Row* same = nullptr;
      for (const Row& r : next.rows) {
        if (r.same_pair(old) &&
            (same == nullptr || (r.normal - old.normal).norm() < (same->normal - old.normal).norm()))
          same = &r;
      }
      if (same == nullptr) return std::nullopt;
      out -= f * (same->normal - old.normal);
    }
    return out;
  }

  /// Balanced forces may belong to a saddle. A barrier as narrow as the margin has its minimum next to a
  /// limit; from a saddle its Newton's method goes on along the negative curvature, and the search goes on
  /// from there.
  bool leaves_saddle(bool& fresh)
  {
    Stage stage = out_.stage;
    stage.contact.g_hat = 10.0 * margin_;
    stage.ccd = CollisionCheck::certified;
    stage.mu = schedule_.stiffness * stage.contact.g_hat * size_;
    stage.tolerance = schedule_.tolerance;
    stage.most_iterations = schedule_.most_iterations;
    State state = now_.state;
    const auto gain = [&] { return load_.dot(state.macro - now_.state.macro) / size_; };
    int steps = 0;
    const StageResult r = solve_stage(m_, state, load_, stage, [&] {
      return keep_going_() && steps++ < steps_of_test && gain() < left_behind;
    });
    out_.evaluations += r.evaluations;
    if (gain() <= beyond_limit * margin_ * forces_.sum()) {
      if (r.status != StageStatus::minimum) {
        untested_ = fmt::format("whether it is a saddle is not known after {} Newton steps", r.iterations);
      }
      return false;
    }
    out_.iterations += r.iterations;
    most_iterations_ += r.iterations;
    now_ = at(std::move(state));
    forces_ = Vector::Zero(static_cast<Eigen::Index>(now_.rows.size()));
    past_.clear();
    bfgs_.reset(m_.dofs(), 1.0);
    fresh = true;
    return true;
  }

  bool runaway() const
  {
    const auto [lo, hi] = m_.load->stretch_range(now_.state.macro_values());
    return lo < 1e-3 || hi > 1e3;
  }

  Locked stalled(const char* what)
  {
    return finish(
        LockStatus::stalled,
        fmt::format("{} after {} quadratic programs: forces miss the load by {:.1e} of it, gaps lack "
                    "{:.1e} L",
                    what, out_.iterations, residual_, now_.worst));
  }

  Locked finish(LockStatus status, std::string message)
  {
    out_.status = status;
    out_.message = std::move(message);
    out_.state = now_.state;
    StageRecord record;
    record.g_hat = out_.stage.contact.g_hat;
    record.value = load_.dot(now_.state.macro);
    record.formulation = Formulation::nearest;
    record.iterations = out_.iterations;
    record.residual = residual_;
    out_.stages.push_back(record);
    out_.trail.push_back(now_.state);
    out_.pressed = contacts();
    if (status == LockStatus::locked) out_.error_estimate = margin_ * size_ * forces_.sum();
    return std::move(out_);
  }

  /// Contacts with the multipliers as forces; derivatives of -sum f_i gap_i.
  ContactEnergy contacts()
  {
    // The same search as for gaps, so that points come in the order of rows: two of a pair may have equal
    // gaps.
    ContactSettings within = out_.stage.contact;
    within.g_hat = range_of_step * longest_;
    Request request;
    request.order = 1;
    request.parameters = request.points = true;
    const std::vector<ElementPair> pairs = near_pairs(m_, now_.state, within.g_hat + within.clearance);
    ContactEnergy e = contact_energy(m_, now_.state, pairs, within, request);
    e.parameters.setZero();
    e.d_clearance = 0.0;
    std::vector<ContactEnergy::Point> pressing;
    std::vector<bool> taken(e.points.size(), false);
    for (std::size_t k = 0; k < now_.rows.size(); ++k) {
      const Row& row = now_.rows[k];
      const auto is_row = [&row](const ContactEnergy::Point& p) {
        const bool same =
            row.b < 0 ? p.wall == row.a : p.wall < 0 && p.a == row.a && p.b == row.b && p.image == row.image;
        return same && std::abs(p.contact.gap - row.gap) <= rounding;
      };
      std::size_t at = 0;
      while (at < e.points.size() && (taken[at] || !is_row(e.points[at]))) ++at;
      const double f = size_ * forces_[k];
      if (at == e.points.size()) continue;
      taken[at] = true;
      if (f <= 0.0) continue;
      pressing.push_back(e.points[at]);
      pressing.back().contact.force = f;
      if (row.b < 0) continue;
      const Gap& g = now_.gaps[k];
      const int i = m_.bodies[g.a].element, j = m_.bodies[g.b].element;
      e.parameters.col(i).head(g.da.size()) -= f * g.da;
      e.parameters.col(j).head(g.db.size()) -= f * g.db;
      e.d_clearance += f;
    }
    e.points = std::move(pressing);
    return e;
  }

  const Model& m_;
  const Vector& load_;
  const Schedule& schedule_;
  int most_iterations_;
  const KeepGoing& keep_going_;
  double margin_, size_;
  Vector root_;
  double longest_ = 0.0, deepest_ = 0.0;
  Point now_;
  DampedBfgs bfgs_;
  Vector forces_;  ///< multipliers, of the load's norm
  double residual_ = 0.0, penalty_ = 0.0;
  int escapes_ = 0;
  std::string untested_;                        ///< why nothing is known of the second order
  std::deque<std::pair<double, double>> past_;  ///< objective and violation
  Locked out_;
};

}  // namespace

Locked constrained_lock(const Model& model, const State& start, const Vector& load, const Schedule& schedule,
                        const KeepGoing& keep_going)
{
  return ConstrainedSearch(model, start, load, schedule, keep_going).run();
}

}  // namespace hauberk
