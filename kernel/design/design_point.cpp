#include "design/design_point.hpp"

#include "design/body_between.hpp"
#include "equilibrium/adjoint.hpp"
#include "equilibrium/relaxation.hpp"
#include "equilibrium/rest.hpp"
#include "geometry/separation.hpp"
#include "limits/relatives.hpp"
#include "model/held_model.hpp"
#include "model/links.hpp"
#include "motion/advancement.hpp"

#include <hauberk/error.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

constexpr double response_weight = 1e-3;  ///< weight of staying against keeping gaps, at rest
constexpr double follow_weight = 1e-6;    ///< the same for locked states, whose contacts fix them
constexpr double least_gap = 0.05;        ///< of the smallest gap at the start: the advance stops there
constexpr double shortest_advance = 1e-6, most_of_gap = 0.95;
constexpr double contact_range = 3.0;  ///< activation distances: gaps that a warm start keeps
constexpr double open_enough = 0.01;   ///< activation distances: gaps of a warm start are at least that
/// Parts of the way to a changed design: the longest motion (of what farthest_relative_motion allows), and
/// iterations that may open gaps: where it takes more, a shorter part is cheaper; and how many parts are
/// tried before a search from rest is.
constexpr double longest_motion = 0.5;
constexpr int most_openings = 12;
constexpr int most_tries = 24;
constexpr double shortest_part = 1.0 / 256.0;
/// Shorter parts along the motion of a minimum are not worth it; and the change of shapes, of the smallest
/// gap, from which that motion is told.
constexpr double shortest_along_minimum = 0.25;
constexpr double small_change = 3e-3;

/// Two bodies on a straight way on which their shapes change, too.
struct ChangingPair {
  const Model *a, *b;
  const State* from;
  const Vector* dy;
  ElementPair pair;
  std::size_t p, q;   ///< bodies
  double rate = 0.0;  ///< bound of the speed of their surfaces towards each other, per unit of t
  double gap = 0.0;   ///< lower bound at the beginning; or at least twice the rate

  ChangingPair(const Model& first, const Model& last, const State& state, const Vector& way,
               const ElementPair& elements, std::size_t body_p, std::size_t body_q)
      : a(&first), b(&last), from(&state), dy(&way), pair(elements), p(body_p), q(body_q)
  {
    const int oi = a->offset(pair.i), oj = a->offset(pair.j), nc = a->coordinate_count;
    const auto turn = [&](int offset, std::size_t body) {
      return dy->segment<3>(offset + nc).norm() * std::max(a->bodies[body].reach, b->bodies[body].reach);
    };
    rate = (dy->segment(oi, nc) - dy->segment(oj, nc)).norm() + turn(oi, p) + turn(oj, q) +
           shape_speed(a->bodies[p], b->bodies[p]) + shape_speed(a->bodies[q], b->bodies[q]);
    gap = gap_at(0.0);
  }

  Pose pose_at(int element, const Image& image, double t) const
  {
    const std::size_t k = element;
    const int nc = a->coordinate_count, o = a->offset(element);
    const Vector macro = from->macro + t * dy->head(a->macro_count);
    const Vector e = from->e.segment(element * nc, nc) + t * dy->segment(o, nc);
    PositionMap map;
    a->load->position({macro.data(), static_cast<std::size_t>(macro.size())},
                      {e.data(), static_cast<std::size_t>(nc)}, a->rest[k].position, a->translation(image),
                      map);
    return {map.x, rotation_exp(t * dy->segment<3>(o + nc)) * from->rotation[k]};
  }

  double gap_at(double t) const
  {
    const Body P = body_between(a->bodies[p], b->bodies[p], t),
               Q = body_between(a->bodies[q], b->bodies[q], t);
    const bool none = (a->bodies[p].solid && !P.solid) || (a->bodies[q].solid && !Q.solid);
    if (none) return 0.0;  // nothing is known of solids that cannot be made
    return separation(P, pose_at(pair.i, {0, 0}, t), Q, pose_at(pair.j, pair.image, t), a->clearance,
                      2.0 * rate, 0.9)
        .lower;
  }

  /// How far of the way up to `end` the gap stays above `least`.
  double advance(double end, double least, const KeepGoing& keep_going) const
  {
    double t = 0.0, now = gap;
    while (rate > 0.0 && t + now / rate < end) {
      if (now <= least || now / rate < shortest_advance) return t;
      t += most_of_gap * now / rate;
      if (!keep_going()) throw Interrupted();
      now = gap_at(t);
    }
    return end;
  }
};

/// Largest relative motion, strain and change of shape included, of two elements that could meet, over the
/// distance that their cores keep at least: the thickness of the thinnest tube twice.
double farthest_relative_motion(const Model& m, const State& from, const State& to, const Vector& dy,
                                const Model& changed)
{
  double thinnest = std::numeric_limits<double>::infinity();
  std::vector<double> own(m.element_count(), 0.0);  // turning and shape
  for (std::size_t k = 0; k < m.bodies.size(); ++k) {
    const Body& b = m.bodies[k];
    thinnest = std::min({thinnest, b.r0, b.r1});
    const double turn = dy.segment<3>(m.offset(b.element) + m.coordinate_count).norm();
    double& most = own[b.element];
    most = std::max(most, turn * b.reach + shape_speed(b, changed.bodies[k]));
  }
  double farthest = 0.0;
  for (const ElementPair& pair : near_pairs(m, from, 2.0 * thinnest)) {
    const std::size_t i = pair.i, j = pair.j;
    const Vec3 before =
        image_pose(m, from, pair.i, {0, 0}).position - image_pose(m, from, pair.j, pair.image).position;
    const Vec3 after =
        image_pose(m, to, pair.i, {0, 0}).position - image_pose(m, to, pair.j, pair.image).position;
    farthest = std::max(farthest, (after - before).norm() + own[i] + own[j]);
  }
  return farthest / (2.0 * thinnest);
}

/// Least-squares motion that keeps `gaps` of a point, per unit of the variables.
Matrix gap_response(const DesignPoint& point, const std::vector<Gap>& gaps,
                    const std::vector<DesignVariable>& variables, bool strain_moves, double weight,
                    const Matrix& held = {})
{
  const Model& m = point.model;
  const int n = m.dofs(), nv = static_cast<int>(variables.size());
  Matrix A = Matrix::Zero(n, n), B = Matrix::Zero(n, nv);
  A.diagonal() = weight * m.metric;
  for (const Gap& g : gaps) {
    Vector dy = g.dy;
    if (!strain_moves) dy.head(m.macro_count).setZero();
    dy.head(m.macro_count) = within(held, dy.head(m.macro_count));
    A.noalias() += dy * dy.transpose();
    B.noalias() += dy * gap_parameter_gradient(g, point, variables).transpose();
  }
  Matrix response = -A.ldlt().solve(B);
  if (!strain_moves) response.topRows(m.macro_count).setZero();
  for (Eigen::Index k = 0; k < response.cols(); ++k)
    response.col(k).head(m.macro_count) = within(held, response.col(k).head(m.macro_count));
  return response;
}

/// The state moved by dy, as a state of the model `changed`; where gaps close, the nearest one that has them
/// open by `least`, among those that keep what `held` has where it has conditions. Null where there is none,
/// or where it is so far that cores could have crossed unseen.
std::optional<State> opened(const Model& m, const State& state, const Vector& dy, const Model& changed,
                            double least, const Matrix& held)
{
  State s = advanced(m, state, dy, 1.0);
  const auto acceptable = [&] {
    return m.load->admissible(s.macro_values()) &&
           farthest_relative_motion(m, state, s, difference(m, state, s), changed) <= longest_motion;
  };
  if (!acceptable()) return std::nullopt;
  if (smallest_gap(changed, s, least) < least) {
    Relaxed r;
    if (held.cols() == 0) {
      r = relax(changed, s, 2.0 * least, Cell::free, most_openings);
    } else {
      const HeldModel kept(changed, held);
      r = relax(kept.model(), kept.restricted(s), 2.0 * least, Cell::free, most_openings);
      r.state = kept.full(r.state);
    }
    s = std::move(r.state);
    if (r.smallest < least || !acceptable()) return std::nullopt;
  }
  if (!links_kept(changed, s)) return std::nullopt;
  return s;
}

}  // namespace

SceneSpec with_relaxed_rest(const DesignPoint& point)
{
  return with_rest(point.spec, point.model, point.rest);
}

std::vector<std::optional<State>> carried_to(const DesignPoint& p, const ReportedStates& reported)
{
  std::vector<std::optional<State>> states(reported.states.size());
  const Carrier carrier(reported.model, reported.scene, p.model, p.spec);
  const std::optional<State> rest = carrier.state(rest_state(reported.model));
  if (!rest) return states;
  const Vector way = difference(p.model, p.rest, *rest);
  if (!(step_norm(p.model, way) < rounding_of_scenes) &&
      largest_safe_step(p.model, p.rest, way, 0.0).alpha < 1.0)
    return states;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (reported.states[k]) states[k] = carrier.state(*reported.states[k]);
  return states;
}

SceneSpec with_variables(const SceneSpec& scene, const std::vector<DesignVariable>& variables,
                         std::span<const double> x)
{
  SceneSpec s = scene;
  for (std::size_t v = 0; v < variables.size(); ++v) {
    for (const auto& [element, parameter] : variables[v].entries) {
      s.elements[element].parameters[parameter] = x[v];
    }
  }
  return s;
}

double largest_change_of_shape(const Model& a, const Model& b)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < a.bodies.size(); ++k)
    largest = std::max(largest, shape_speed(a.bodies[k], b.bodies[k]));
  return largest;
}

Vector change_of_variables(const DesignPoint& from, const DesignPoint& to)
{
  const auto n = static_cast<Eigen::Index>(from.x.size());
  return Eigen::Map<const Vector>(to.x.data(), n) - Eigen::Map<const Vector>(from.x.data(), n);
}

Vector gap_parameter_gradient(const Gap& gap, const DesignPoint& point,
                              const std::vector<DesignVariable>& variables)
{
  const int ea = point.model.bodies[gap.a].element;
  const int eb = point.model.bodies[gap.b].element;
  Vector d = Vector::Zero(static_cast<int>(variables.size()));
  for (std::size_t v = 0; v < variables.size(); ++v) {
    for (const auto& [element, parameter] : variables[v].entries) {
      if (element == ea) d[v] += gap.da[parameter];
      if (element == eb) d[v] += gap.db[parameter];
    }
  }
  return d;
}

Matrix rest_response(const DesignPoint& point, const std::vector<DesignVariable>& variables)
{
  Matrix response = gap_response(point, point.rest_gaps, variables, false, response_weight);
  for (Eigen::Index v = 0; v < response.cols(); ++v)
    response.col(v) = free_part(point.model, response.col(v));
  return response;
}

std::optional<Model> intermediate(const DesignPoint& from, const DesignPoint& to,
                                  const std::vector<DesignVariable>& variables, double share)
{
  if (share >= 1.0) return to.model;
  std::vector<double> x = from.x;
  for (std::size_t v = 0; v < x.size(); ++v) x[v] = (1.0 - share) * from.x[v] + share * to.x[v];
  try {
    Model m = make_model(with_variables(from.spec, variables, x), *from.model.load,
                         from.model.clearance * from.model.length);
    m.links = from.model.links;
    return m;
  } catch (const InputError&) {  // sizes between two admissible ones need not be admissible
    return std::nullopt;
  }
}

namespace {

/// How far a state goes on the way between two designs, and where it is then.
struct Followed {
  double share;
  State state;
  Model model;
};

/// The motion of a warm start's minimum, for all of the way to another design; null where it is not known.
std::optional<Vector> motion_of_minimum(const DesignPoint& from, const WarmStart& warm, const DesignPoint& to,
                                        const std::vector<DesignVariable>& variables,
                                        const MinimumOf& minimum, long& evaluations)
{
  const double speed = largest_change_of_shape(from.model, to.model);
  const double gap = smallest_gap(from.model, warm.state, warm.g_hat);
  if (!(gap > 0.0) || !(speed > 0.0)) return std::nullopt;
  const double share = std::min(1.0, small_change * std::min(gap, warm.g_hat) / speed);
  const std::optional<Model> ahead = intermediate(from, to, variables, share);
  if (!ahead) return std::nullopt;
  const Matrix& held = minimum.load.held;
  if (held.cols() == 0)
    return response_of_minimum(from.model, *ahead, share, warm.state, minimum.load.pull, minimum.stage,
                               evaluations);
  const HeldModel here(from.model, held), there(*ahead, held);
  const State state = here.restricted(warm.state);
  const std::optional<Vector> dq = response_of_minimum(
      here.model(), there.model(), share, state, here.pull(minimum.load.pull), minimum.stage, evaluations);
  if (!dq) return std::nullopt;
  return difference(from.model, warm.state, here.full(advanced(here.model(), state, *dq, 1.0)));
}

/// The first part of a way, along the motion of the minimum; null where no part of it that is worth its while
/// leads to a state.
std::optional<Followed> along_minimum(const DesignPoint& from, const WarmStart& warm, const DesignPoint& to,
                                      const std::vector<DesignVariable>& variables, const MinimumOf& minimum,
                                      long& evaluations)
{
  const std::optional<Vector> motion = motion_of_minimum(from, warm, to, variables, minimum, evaluations);
  if (!motion) return std::nullopt;
  for (double part = 1.0; part >= shortest_along_minimum; part *= 0.5) {
    std::optional<Model> next = intermediate(from, to, variables, part);
    if (!next) continue;
    std::optional<State> reached = opened(from.model, warm.state, free_part(from.model, part * *motion),
                                          *next, open_enough * warm.g_hat, minimum.load.held);
    if (reached) return Followed{part, std::move(*reached), std::move(*next)};
  }
  return std::nullopt;
}

/// The rest of a way, in parts that keep the gaps; null where some part cannot be opened.
std::optional<State> keeping_gaps(Followed reached, const DesignPoint& from, const DesignPoint& to,
                                  const std::vector<DesignVariable>& variables, double g_hat,
                                  const Matrix& held)
{
  const Vector change = change_of_variables(from, to);
  DesignPoint at;
  at.model = std::move(reached.model);
  State state = std::move(reached.state);
  double done = reached.share;
  int tries = 0;
  for (double part = 1.0 - done; done < 1.0;) {
    // One linear response serves all lengths of this part.
    const Matrix response = gap_response(at, find_gaps(at.model, state, contact_range * g_hat, true),
                                         variables, true, follow_weight, held);
    std::optional<State> opened_state;
    std::optional<Model> next;
    for (; !opened_state; part *= 0.5) {
      if (part < shortest_part || ++tries > most_tries) return std::nullopt;
      const double end = std::min(1.0, done + part);
      next = intermediate(from, to, variables, end);
      if (!next) continue;
      const Vector dy = free_part(at.model, response * ((end - done) * change));
      opened_state = opened(at.model, state, dy, *next, open_enough * g_hat, held);
      if (opened_state) done = end;
    }
    part *= 4.0;  // the loop has halved it: twice the part that succeeded
    state = std::move(*opened_state);
    at.model = std::move(*next);
  }
  return state;
}

}  // namespace

std::optional<State> followed(const DesignPoint& from, const WarmStart& warm, const DesignPoint& to,
                              const std::vector<DesignVariable>& variables, const Matrix& held,
                              const MinimumOf* minimum, long* evaluations)
{
  if (from.x == to.x) return warm.state;
  if (minimum != nullptr) {
    long counted = 0;
    std::optional<Followed> first = along_minimum(from, warm, to, variables, *minimum, counted);
    if (evaluations != nullptr) *evaluations += counted;
    if (first) {
      std::optional<State> state = keeping_gaps(std::move(*first), from, to, variables, warm.g_hat, held);
      if (state) return state;
    }
  }
  return keeping_gaps({0.0, warm.state, from.model}, from, to, variables, warm.g_hat, held);
}

double safe_parameter_step(const Model& a, const Model& b, const State& from, const Vector& dy,
                           const KeepGoing& keep_going)
{
  const double shape = largest_change_of_shape(a, b);
  const double most = 2.0 * (largest_motion(a, dy) + shape);
  if (most == 0.0) return 1.0;
  Model reaching = a;
  for (std::size_t i = 0; i < reaching.reach.size(); ++i)
    reaching.reach[i] = std::max(a.reach[i], b.reach[i]);
  std::vector<ChangingPair> pairs;
  double smallest = std::numeric_limits<double>::infinity();
  for (const ElementPair& pair : near_pairs(reaching, from, a.clearance + most)) {
    const std::size_t i = pair.i, j = pair.j;
    for (int p = a.first_body[i]; p < a.first_body[i + 1]; ++p) {
      for (int q = a.first_body[j]; q < a.first_body[j + 1]; ++q) {
        ChangingPair c(a, b, from, dy, pair, static_cast<std::size_t>(p), static_cast<std::size_t>(q));
        smallest = std::min(smallest, c.gap);
        if (c.gap < c.rate) pairs.push_back(std::move(c));
      }
    }
  }
  if (smallest <= 0.0) return 0.0;
  const double least = least_gap * smallest;
  // Those that could meet first are followed first: the others need not go further.
  std::sort(pairs.begin(), pairs.end(),
            [](const ChangingPair& x, const ChangingPair& y) { return x.gap * y.rate < y.gap * x.rate; });
  double safe = 1.0;
  for (const ChangingPair& pair : pairs) safe = pair.advance(safe, least, keep_going);
  return safe;
}

}  // namespace hauberk
