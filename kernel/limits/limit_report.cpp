#include "limits/limit_report.hpp"

#include "equilibrium/gaps.hpp"
#include "limits/force_balance.hpp"
#include "limits/kinks.hpp"
#include "model/links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk {
namespace {

/// Range in which the smallest gap is searched, L.
constexpr double gap_range = 0.2;
/// Forces that miss the load by more than this part of it are said so.
constexpr double unbalanced = 3e-5;
/// A finite target whose pull falls below this part of the load has been reached.
constexpr double least_drive = 1e-2;
/// States closer than this in value, invariants of the strain and height are one.
constexpr double same_state = 1e-5;

/// Listed forces that miss the load by more than this part of it hold no locked state. Rounding of gaps
/// leaves up to 3e-5; `arc` lists resultants, whose wrench is off by a multiple of gap / L.
constexpr double balanced = 1e-4;
constexpr double balanced_per_gap = 100.0;
/// On hair-thin tubes `arc` leaves gaps of 1e-12 L. More than this part is not put down to their rounding.
constexpr double most_rounding = 1e-3;
/// Rest may overlap by this much and still count as touching; what is less than rest by more is no limit.
constexpr double wrong_side = 1e-9;

double power(double x, int n) { return std::pow(x, static_cast<double>(n)); }

double z_range(const Model& m, const State& s)
{
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  const std::vector<Pose> p = poses(m, s);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double z = p[i].position.z() - m.rest[i].position.z();
    lo = std::min(lo, z);
    hi = std::max(hi, z);
  }
  return hi - lo;
}

/// What the equilibrium may miss what drives it by.
double allowed_imbalance(const LimitResult& r, double length)
{
  double gap = 0.0, least = std::numeric_limits<double>::infinity();
  for (const ContactForce& c : r.contacts) {
    gap = std::max(gap, c.gap / length);
    least = std::min(least, c.gap / length);
  }
  return balanced + std::min(most_rounding, rounding_of_x / least) +
         (r.contact == "arc" ? balanced_per_gap * gap : 0.0);
}

/// Largest component of the energy's gradient, by the load that is not subtracted yet.
double energy_imbalance(const Model& m, const MacroLoad& load, const ContactEnergy& e, double mu)
{
  Vector rest = mu * e.gradient;
  rest.head(m.macro_count) -= load.pull;
  return unheld(m, load.held, rest).cwiseAbs().maxCoeff();
}

/// Contacts of the last stage, with what forces and sensitivities need.
ContactEnergy contacts_of(const Model& m, const Locked& l, const KeepGoing& keep_going)
{
  ContactSettings settings = l.stage.contact;
  settings.keep_going = &keep_going;
  Request request;
  request.order = 1;
  request.parameters = request.points = true;
  return contact_energy(m, l.state, stage_pairs(m, l.state, l.stage), settings, request);
}

/// How the way from rest was checked.
const char* certificate_of_path(const Locked& l)
{
  if (l.pressed)
    return "no part of the path from rest certified: surfaces may have overlapped a little on the way";
  if (l.stage.contact.formulation == Formulation::mesh)
    return "path of the meshes from rest free of intersections";
  return l.stage.ccd == CollisionCheck::certified
             ? "path from rest certified free of intersections"
             : "path from rest checked for intersections at sampled points, nothing certified";
}

/// Largest component by which the gradient of arc's energy changes with panels half as long, whose quadrature
/// is better by orders of magnitude; times the stiffness. At the last stages rounding of the gap is part of
/// it.
double quadrature_error(const Model& m, const Matrix& held, const Locked& l, const ContactEnergy& e,
                        const KeepGoing& keep_going)
{
  ContactSettings finer = l.stage.contact;
  finer.keep_going = &keep_going;
  finer.panel_ratio *= 0.5;
  Request request;
  request.order = 1;
  const ContactEnergy better = contact_energy(m, l.state, stage_pairs(m, l.state, l.stage), finer, request);
  return l.stage.mu * unheld(m, held, better.gradient - e.gradient).cwiseAbs().maxCoeff();
}

/// Poses in file units; where a translation is free, their mean position is that of the rest state.
std::vector<Pose> reported_poses(const Model& m, const State& s, Vec3& shift)
{
  std::vector<Pose> p = poses(m, s);
  shift = Vec3::Zero();
  if (!m.load->bends()) {
    for (std::size_t i = 0; i < p.size(); ++i) shift += m.rest[i].position - p[i].position;
    shift /= static_cast<double>(p.size());
  }
  for (Pose& q : p) q.position = (q.position + shift) * m.length;
  return p;
}

ContactForce reported_contact(const Model& m, const ContactEnergy::Point& p, double mu, const Vec3& shift)
{
  ContactForce c;
  if (p.wall >= 0) {
    c.elements = {p.a, -1};
    c.primitives = {-1, -1};
    c.wall = m.walls[p.wall].name;
  } else {
    const Body& A = m.bodies[p.a];
    const Body& B = m.bodies[p.b];
    c.elements = {A.element, B.element};
    c.primitives = {A.index, B.index};
    c.image = p.image;
  }
  c.points = {(p.contact.on_p + shift) * m.length, (p.contact.on_f + shift) * m.length};
  c.normal = p.contact.normal;
  c.gap = p.contact.gap * m.length;
  c.force = mu * p.contact.force / m.length;
  return c;
}

/// The state itself: macroscopic unknowns, poses, gaps and links.
Vec3 fill_state(LimitResult& r, const Model& m, const State& s)
{
  for (int k = 0; k < m.macro_count; ++k) {
    const MacroInfo& info = m.load->macros()[k];
    r.macro.emplace_back(info.name, s.macro[k] * power(m.length, info.length_power));
  }
  r.min_gap = smallest_gap(m, s, gap_range) * m.length;
  r.links_kept = links_kept(m, s);
  r.z_range = z_range(m, s) * m.length;
  Vec3 shift;
  r.poses = reported_poses(m, s, shift);
  return shift;
}

void fill_kink(LimitResult& r, const Model& m, const LimitTask& task, const Locked& l)
{
  const std::optional<OneSidedSensitivities> sides = one_sided_sensitivities(m, task, l);
  if (!sides) return;
  const double scale = power(m.length, m.load->value_length_power());
  const auto times = [](const std::array<double, 2>& x, double by) {
    return std::array{x[0] * by, x[1] * by};
  };
  r.kink = true;
  r.clearance_one_sided = times(sides->clearance, scale / m.length);
  for (const auto& p : sides->parameters) r.parameters_one_sided.push_back(times(p, scale));
}

std::string certificate_of(const Model& m, const Locked& l, double gap)
{
  int links = 0;
  for (const ElementLink& link : element_links(m)) links += link.primitives + link.together;
  return fmt::format("{}; {} links kept; smallest gap {:.3g}", certificate_of_path(l), links, gap);
}

/// Where no contact stops a patch while it is a sheet there is no limit, and the state shows why.
void fill_without_limit(LimitResult& r, const Model& m, const Locked& l)
{
  fill_state(r, m, l.state);
  r.message =
      l.message +
      "; contact does not stop this patch before: it needs thicker tubes, smaller rings, more rows or shorter "
      "distances between linked elements";
  r.certificate = certificate_of(m, l, *r.min_gap);
  if (r.links_kept && *r.min_gap > 0.0) return;
  r.status = LimitStatus::failed;
  r.message = "a link was lost or surfaces overlap: the collision check failed";
}

}  // namespace

LimitResult limit_header(const Model& m, const LimitTask& task)
{
  LimitResult r;
  r.direction = task.direction;
  r.sense = m.load->sense_name(task.direction, task.sense);
  r.measure = m.load->measure(task.direction);
  r.hold = m.load->hold(task.direction);
  // Their names only: there is no state yet.
  const State rest = rest_state(m);
  r.companions = m.load->companions(task.direction, rest.macro_values());
  for (auto& [name, value] : r.companions) value = std::numeric_limits<double>::quiet_NaN();
  return r;
}

namespace {

/// What an answer is, and what is said about it.
struct Verdict {
  LimitStatus status;
  std::string message;
};

/// What the search itself says.
Verdict end_of_search(const Model& m, const Locked& l)
{
  switch (l.status) {
    case LockStatus::locked:
      return {LimitStatus::locked, l.message};
    case LockStatus::interrupted:
      return {LimitStatus::interrupted, l.message};
    case LockStatus::not_a_sheet:
      return {LimitStatus::not_a_sheet, l.message};
    case LockStatus::unbounded:
      return {LimitStatus::failed,
              m.load->periodic()
                  ? "the strain left every bound, but not on a certified way from rest"
                  : "the macroscopic unknowns left every bound: nothing stops this patch in this direction"};
    default:
      return {LimitStatus::stalled, l.message};
  }
}

/// What holds a state at the end of a search. The contacts are those of the last stage.
struct HeldState {
  const Model& m;
  const LimitTask& task;
  const Locked& l;
  const KeepGoing& keep_going;
  ContactEnergy contacts;
  MacroLoad load;        ///< a finite target drives the strain less the nearer it is
  double full = 0.0;     ///< norm of the full load, which imbalances are parts of
  double driving = 0.0;  ///< part of it that drives the state
  double scale = 0.0;    ///< of the value, file units
  /// By which part of the full load forces missed it before they were changed within their rounding; null:
  /// they were not.
  std::optional<double> missed_before;

  HeldState(const Model& model, const LimitTask& of, const Locked& locked, const KeepGoing& keep)
      : m(model),
        task(of),
        l(locked),
        keep_going(keep),
        contacts(locked.pressed ? *locked.pressed : contacts_of(model, locked, keep)),
        load(macro_load(model, of.direction, of.sense)),
        full(load.pull.norm()),
        scale(power(model.length, model.load->value_length_power()))
  {
    load.pull = driving_load(m, l.state, load.pull, l.stage);
    driving = load.pull.norm() / full;
  }

  double sign() const { return task.sense == Sense::positive ? 1.0 : -1.0; }
};

/// Forces of a locked state that miss the load by what rounding of gaps leaves of them are changed to such
/// that do not. Resultants of `arc` that balance no better than where they are listed are another matter:
/// there the energy's gradient tells.
void balance_forces(HeldState& h)
{
  const Formulation f = h.l.stage.contact.formulation;
  if (h.l.status != LockStatus::locked || h.l.pressed || (f != Formulation::nearest && f != Formulation::arc))
    return;
  const double mu = h.l.stage.mu, most = unbalanced * h.driving * h.full;
  const auto imbalance = [&] {
    return force_balance(h.m, h.l.state, h.load, h.contacts.points, mu).imbalance;
  };
  const double before = imbalance();
  if (!(before > most) || !(energy_imbalance(h.m, h.load, h.contacts, mu) > most)) return;
  const std::optional<Vector> parts = balancing_parts(h.m, h.l.state, h.load, h.contacts.points, mu);
  if (!parts) return;
  ContactEnergy as_found = h.contacts;
  if (!change_forces(h.contacts, h.m, h.l.state, f, *parts)) return;
  if (imbalance() < most)
    h.missed_before = before / h.full;
  else
    h.contacts = std::move(as_found);
}

void fill_forces(LimitResult& r, const HeldState& h, const Vec3& shift)
{
  for (const ContactEnergy::Point& p : h.contacts.points)
    r.contacts.push_back(reported_contact(h.m, p, h.l.stage.mu, shift));
  const ForceBalance forces = force_balance(h.m, h.l.state, h.load, h.contacts.points, h.l.stage.mu);
  r.force_balance = forces.imbalance / h.full;
  const std::vector<MacroCondition> conditions = h.m.load->conditions(h.task.direction);
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    const double rise = forces.reactions[static_cast<Eigen::Index>(k)];
    r.reactions.emplace_back(conditions[k].name, h.task.sense == Sense::positive ? rise : -rise);
  }
  r.contact = h.l.pressed ? "constrained" : name_of(h.l.stage.contact.formulation);
  if (h.l.stage.contact.formulation == Formulation::arc)
    r.quadrature_error = quadrature_error(h.m, h.load.held, h.l, h.contacts, h.keep_going) / h.full;
}

/// E_min = -(+-value) + mu contact, so d value/dp = -+ mu d contact/dp (envelope theorem).
void fill_sensitivities(LimitResult& r, const HeldState& h, const SceneSpec& spec)
{
  const double by = -h.sign() * h.l.stage.mu;
  r.sensitivity_clearance = by * h.contacts.d_clearance * h.scale / h.m.length;
  for (int k = 0; k < h.m.element_count(); ++k) {
    const std::size_t i = k;
    const auto& infos = spec.types[spec.elements[i].type].shape->parameters();
    for (std::size_t c = 0; c < infos.size(); ++c) {
      r.sensitivity_parameters.emplace_back(fmt::format("{}/{}", k, infos[c].name),
                                            by * h.contacts.parameters(static_cast<int>(c), k) * h.scale);
    }
  }
  if (h.l.status == LockStatus::locked) fill_kink(r, h.m, h.task, h.l);
}

/// A flat energy is no equilibrium: where contacts merge, nearest points come and go and balance nothing.
Verdict unbalanced_state(const LimitResult& r, const HeldState& h, const LimitSettings& settings)
{
  std::string message = fmt::format("contact forces miss the load by {:.1e} of it", *r.force_balance);
  const double energy = energy_imbalance(h.m, h.load, h.contacts, h.l.stage.mu) / h.full;
  if (h.l.stage.contact.formulation == Formulation::published && *r.force_balance > 2.0 * energy) {
    // Published contacts near a merge push through their fade too, which is no force at a point.
    message += fmt::format(
        ": the fade of published contacts holds this state, which nothing real does; the gradient of their "
        "energy misses the load by {:.1e}",
        energy);
  }
  if (settings.contact == ContactChoice::nearest) message += "; use contact arc or auto";
  return {LimitStatus::stalled, message};
}

/// What a state is taken for, by all that is known of it.
Verdict verdict_of(const LimitResult& r, const HeldState& h, const LimitSettings& settings)
{
  if (!r.links_kept) return {LimitStatus::failed, "a link was lost: the collision check failed"};
  Verdict search = end_of_search(h.m, h.l);
  if (search.status != LimitStatus::locked) return search;
  if (!(h.driving > least_drive)) {
    return {
        LimitStatus::failed,
        fmt::format("the finite target {:g} is reached: what is left of the load does not press contacts; "
                    "choose a larger finite_target",
                    h.l.stage.target)};
  }
  if (!(*r.min_gap > 0.0))
    return {LimitStatus::failed, "surfaces overlap at the end: the collision check failed"};
  if (!(*r.force_balance <= allowed_imbalance(r, h.m.length) * h.driving))
    return unbalanced_state(r, h, settings);
  if (h.sign() * *r.value < -wrong_side * h.scale) {
    return {
        LimitStatus::stalled,
        fmt::format("rest is nearer to the limit than the gaps that this schedule leaves: value {:.3g} is "
                    "on the wrong side of rest; use preset accurate or a smaller tolerance",
                    *r.value)};
  }
  if (*r.force_balance > unbalanced) {
    return {LimitStatus::locked,
            fmt::format("contact forces miss the load by {:.1e} of it: an error of that order is possible",
                        *r.force_balance)};
  }
  if (h.missed_before) {
    search.message += fmt::format(
        "{}gaps are so small that rounding left forces that miss the load by {:.1e} of it; those given are "
        "the nearest that balance",
        search.message.empty() ? "" : "; ", *h.missed_before);
  }
  return search;
}

void enter_verdict(LimitResult& r, Verdict verdict)
{
  r.status = verdict.status;
  r.message = std::move(verdict.message);
}

}  // namespace

LimitResult fill_limit(const Model& m, const SceneSpec& spec, const LimitTask& task,
                       const LimitSettings& settings, const Locked& l, const KeepGoing& keep_going)
{
  LimitResult r = limit_header(m, task);
  enter_verdict(r, end_of_search(m, l));
  if (l.status == LockStatus::unbounded && !l.path.empty()) {
    r.message = l.message;
    add_witness(r, m, task, l);
    return r;
  }
  r.iterations = l.iterations;
  r.evaluations = l.evaluations;
  if (l.status == LockStatus::not_a_sheet) {
    fill_without_limit(r, m, l);
    return r;
  }
  if (l.stages.empty()) return r;

  const double scale = power(m.length, m.load->value_length_power());
  r.value = m.load->value(task.direction, l.state.macro_values()) * scale;
  r.companions = m.load->companions(task.direction, l.state.macro_values());
  if (l.error_estimate) r.error_estimate = *l.error_estimate * scale;
  if (std::isfinite(l.stage.target)) r.finite_target = l.stage.target;
  const Vec3 shift = fill_state(r, m, l.state);
  r.certificate = certificate_of(m, l, *r.min_gap);
  try {
    HeldState h(m, task, l, keep_going);
    balance_forces(h);
    fill_forces(r, h, shift);
    fill_sensitivities(r, h, spec);
    enter_verdict(r, verdict_of(r, h, settings));
    return r;
  } catch (const Interrupted&) {
    LimitResult none = limit_header(m, task);
    enter_verdict(none, {LimitStatus::interrupted, "its forces were not computed"});
    return none;
  }
}

namespace {

LockedState locked_state(const Model& m, const LimitTask& task, const FoundState& found)
{
  const Locked& l = found.locked;
  LockedState s;
  s.value =
      m.load->value(task.direction, l.state.macro_values()) * power(m.length, m.load->value_length_power());
  for (int k = 0; k < m.macro_count; ++k) {
    s.macro.push_back(l.state.macro[k] * power(m.length, m.load->macros()[k].length_power));
  }
  s.z_range = z_range(m, l.state) * m.length;
  s.seed = found.seed;
  s.origin = found.origin;
  s.count = 1;
  return s;
}

/// The state of the list that is one with another; null: there is none. Mirror images have the same value and
/// metric norm of the macroscopic state. Heights are those of loose elements, too, which are no part of what
/// holds.
LockedState* equal_state(std::vector<LockedState>& list, const Model& m, const LockedState& s)
{
  const double scale = power(m.length, m.load->value_length_power());
  const auto norm = [&m](const std::vector<double>& x) {
    double n = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) n += m.metric[static_cast<int>(k)] * x[k] * x[k];
    return std::sqrt(n);
  };
  const auto equal = [&](const LockedState& o) {
    return std::abs(o.value - s.value) < same_state * scale &&
           std::abs(norm(o.macro) - norm(s.macro)) < same_state * 100 * scale;
  };
  const auto at = std::find_if(list.begin(), list.end(), equal);
  return at == list.end() ? nullptr : &*at;
}

}  // namespace

void add_start(std::vector<LockedState>& list, const Model& m, const LimitTask& task, const FoundState& found)
{
  LockedState s = locked_state(m, task, found);
  LockedState* same = equal_state(list, m, s);
  if (same == nullptr) return list.push_back(std::move(s));
  const double sign = task.sense == Sense::positive ? 1.0 : -1.0;
  s.count = ++same->count;
  if (sign * s.value > sign * same->value) *same = std::move(s);
}

void stand_for_equals(std::vector<LockedState>& list, const Model& m, const LimitTask& task,
                      const FoundState& reported)
{
  LockedState s = locked_state(m, task, reported);
  LockedState* same = equal_state(list, m, s);
  // A row of states, each one with the next, may end far from where it began.
  if (same == nullptr) return list.push_back(std::move(s));
  s.count = same->count;
  *same = std::move(s);
}

}  // namespace hauberk
