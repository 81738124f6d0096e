#include "limits/limit_report.hpp"

#include "equilibrium/gaps.hpp"
#include "limits/locked_states.hpp"
#include "limits/state_forces.hpp"
#include "limits/verdict.hpp"
#include "model/links.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace hauberk {
namespace {

/// Range in which the smallest gap is searched, L.
constexpr double gap_range = 0.2;

/// How the way from rest was checked.
const char* certificate_of_path(const Locked& l)
{
  if (l.pressed)
    return "no part of the path from rest certified: surfaces may have overlapped a little on the way";
  if (traits(l.stage.contact.formulation).is_of_meshes)
    return "path of the meshes from rest free of intersections";
  return l.stage.ccd == CollisionCheck::certified
             ? "path from rest certified free of intersections"
             : "path from rest checked for intersections at sampled points, nothing certified";
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

/// The state itself: macroscopic unknowns, poses, gaps and links.
Vec3 fill_state(LimitResult& r, const Model& m, const State& s)
{
  for (int k = 0; k < m.macro_count; ++k) {
    r.macro.emplace_back(m.load->macros()[k].name, s.macro[k] * m.macro_unit(k));
  }
  r.min_gap = smallest_gap(m, s, gap_range) * m.length;
  r.links_kept = links_kept(m, s);
  r.z_range = z_range(m, s) * m.length;
  Vec3 shift;
  r.poses = reported_poses(m, s, shift);
  return shift;
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

  const double scale = m.value_unit();
  r.value = m.load->value(task.direction, l.state.macro_values()) * scale;
  r.companions = m.load->companions(task.direction, l.state.macro_values());
  if (l.error_estimate) r.error_estimate = *l.error_estimate * scale;
  if (std::isfinite(l.stage.target)) r.finite_target = l.stage.target;
  const Vec3 shift = fill_state(r, m, l.state);
  r.certificate = certificate_of(m, l, *r.min_gap);
  try {
    StateForces h(m, task, l, keep_going);
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

}  // namespace hauberk
