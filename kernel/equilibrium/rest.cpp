#include "equilibrium/rest.hpp"

#include "equilibrium/gaps.hpp"
#include "equilibrium/relaxation.hpp"
#include "geometry/closed_curve.hpp"
#include "geometry/facets.hpp"
#include "geometry/separation.hpp"
#include "model/hulls.hpp"
#include "model/near_pairs.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace hauberk {
namespace {

/// Gaps within this of the clearance count as touching (L).
constexpr double touching = 1e-9;
/// Room that relaxation opens for touching elements, L.
constexpr double opened = 1e-3;
/// Less room that is tried where that much does not exist, in steps of ten down to this, L.
constexpr double least_opened = 1e-7;

/// Pairs so deep in each other that no minimum of the distance is left: their certified bound tells.
void add_deep_overlaps(const Model& m, std::vector<Gap>& worst)
{
  const State rest = rest_state(m);
  for (const ElementPair& pair : near_pairs(m, rest, 0.0)) {
    const Pose pi = image_pose(m, rest, pair.i, {0, 0}), pj = image_pose(m, rest, pair.j, pair.image);
    const std::size_t i = pair.i, j = pair.j;
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const bool known = std::any_of(worst.begin(), worst.end(), [&](const Gap& g) {
          return g.a == a && g.b == b && g.image == pair.image && g.gap + m.clearance < 0.0;
        });
        const bool meshes = m.bodies[a].surface || m.bodies[b].surface;
        if (known || meshes) continue;  // mesh_problem tells of meshes
        const Separation s = separation(m.bodies[a], pi, m.bodies[b], pj, 0.0, touching);
        if (s.upper >= -touching) continue;
        Gap g;
        g.a = a;
        g.b = b;
        g.image = pair.image;
        g.gap = s.upper - m.clearance;
        worst.push_back(g);
      }
    }
  }
}

/// Whether the curves by which links of a body are counted are inside of its mesh. Between sections a core is
/// at most R (1 - cos h) from the chord, h half the angle between them; a curve |x_uu| h^2/2.
bool holds_core(const Body& b, int facets)
{
  if (b.surface) return true;  // its loops are on the mesh
  if (b.solid) {
    std::vector<std::vector<Vec3>> curves = b.facets->loops();
    if (b.solid->probe_dimension() == 1) {
      constexpr int corners = 64;
      std::vector<Vec3>& core = curves.emplace_back();
      for (int k = 0; k < corners; ++k) {
        const double u = 2.0 * std::numbers::pi * (k + 0.5) / corners;
        core.emplace_back(b.solid->probe({std::cos(u), std::sin(u), 1.0, 0.0}).x / b.unit);
      }
    }
    return std::all_of(curves.begin(), curves.end(),
                       [&b](const std::vector<Vec3>& curve) { return encloses(*b.facets, curve); });
  }
  const double half = std::numbers::pi / facets, cosine = std::cos(half);
  const double sag = b.curve ? 0.5 * b.curve->second() * half * half : b.R * (1.0 - cosine);
  return sag < std::min(b.r0, b.r1) * cosine;
}

/// What is wrong with the meshes of a state: facets cut across holes, where surfaces leave room. Empty:
/// nothing.
std::string mesh_problem(const SceneSpec& spec, const Model& m, const State& state)
{
  std::set<const Facets*> looked_at;
  for (const Body& b : m.bodies) {
    if (!looked_at.insert(b.facets.get()).second || holds_core(b, spec.facets)) continue;
    return fmt::format(
        "the mesh of {} is so coarse that the curve at the middle of its tube leaves it; use more than {} "
        "facets",
        body_name(spec, b), spec.facets);
  }
  std::string first;
  const char* how = "meet";
  bool coarse = true;
  int others = 0;
  for (const ElementPair& pair : near_pairs(m, state, 0.0)) {
    const Pose pi = image_pose(m, state, pair.i, {0, 0}), pj = image_pose(m, state, pair.j, pair.image);
    const std::size_t i = pair.i, j = pair.j;
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body &A = m.bodies[a], &B = m.bodies[b];
        const PairFrame frame(A, pi, B, pj);
        const bool surfaces = A.surface || B.surface;
        const bool meet = facets_intersect(frame);
        // Tori inside of each other are found by their surfaces.
        if (!meet && !(surfaces && facets_inside(frame))) continue;
        if (!first.empty()) {
          ++others;
          continue;
        }
        Gap g;
        g.a = a;
        g.b = b;
        g.image = pair.image;
        first = pair_name(spec, m, g);
        how = meet ? "meet" : "are inside of each other";
        coarse = !surfaces;
      }
    }
  }
  if (first.empty()) return {};
  const std::string more = others > 0 ? fmt::format(", as do {} other pairs", others) : "";
  return fmt::format("the meshes of {} {} at rest{}; {}", first, how, more,
                     coarse ? "use more facets, or give them more room" : "move them apart");
}

/// Of elements without links. They can hold each other all the same, but not where planes lie between them;
/// where they overlap there is nothing to try.
bool nothing_entangled(const Model& m)
{
  const std::vector<Gap> gaps = find_gaps(m, rest_state(m), 0.0, false);
  return std::any_of(gaps.begin(), gaps.end(),
                     [&m](const Gap& g) { return g.gap + m.clearance < -touching; }) ||
         hulls_apart(m, rest_state(m));
}

}  // namespace

std::vector<std::string> rest_problems(const SceneSpec& spec, const Model& m, bool relax_allowed)
{
  std::vector<std::string> out;
  // Meshes that meet have no links, or wrong ones.
  const std::string meeting = spec.facets > 0 ? mesh_problem(spec, m, rest_state(m)) : std::string();
  if (m.links.empty() && meeting.empty() && nothing_entangled(m)) {
    out.emplace_back(
        "nothing is linked: no ring passes through another, so no direction has a limit; check positions, "
        "rotations and the cell's vectors");
    return out;
  }
  if (!meeting.empty()) out.push_back(meeting);
  if (relax_allowed) return out;
  // The deepest gap of every pair of bodies.
  std::vector<Gap> worst;
  for (const Gap& g : find_gaps(m, rest_state(m), 0.0, false)) {
    const auto same = std::find_if(worst.begin(), worst.end(), [&g](const Gap& o) {
      return o.a == g.a && o.b == g.b && o.image == g.image;
    });
    if (same == worst.end()) {
      worst.push_back(g);
    } else if (g.gap < same->gap) {
      *same = g;
    }
  }
  add_deep_overlaps(m, worst);
  const std::string unit = spec.length_unit.empty() ? "" : " " + spec.length_unit;
  for (const Gap& g : worst) {
    if (g.gap >= -touching) continue;
    const double distance = (g.gap + m.clearance) * m.length;
    if (distance < -touching * m.length) {
      out.push_back(fmt::format(
          "{} overlap at rest by {:.6g}{}; move them apart, make them thinner, or set cell.relax to true",
          pair_name(spec, m, g), -distance, unit));
    } else {
      out.push_back(fmt::format(
          "{} are {:.6g}{} apart at rest, less than solver.clearance {:.6g}{}; move them apart, lower "
          "the clearance, or set cell.relax to true",
          pair_name(spec, m, g), std::max(distance, 0.0), unit, m.clearance * m.length, unit));
    }
  }
  return out;
}

PreparedScene prepare_rest(const SceneSpec& spec, const Model& m)
{
  PreparedScene out;
  out.scene = spec;
  const State rest = rest_state(m);
  const double gap = smallest_gap(m, rest, opened);
  if (gap > touching) return out;
  // Relaxation knows distances of meshes, and not on which side of each other they are.
  const auto meshes = [&](const State& s) {
    return spec.facets > 0 ? mesh_problem(spec, m, s) : std::string();
  };
  Relaxed r;
  const auto open = [&](Cell cell) {
    double room = opened;
    do {
      r = relax(m, rest, room, cell);
      room *= 0.1;
    } while (!r.problem.empty() && room >= least_opened);
    return r.problem.empty();
  };
  if (!open(Cell::fixed)) {
    const Relaxed fixed = r;
    // What overlaps has no rest state; what touches is one, and a little strain opens it.
    if (gap >= -touching && open(Cell::free)) {
      if (const std::string problem = meshes(r.state); !problem.empty()) throw InputError(problem);
      out.start = r.state;
      out.moved = r.largest_motion * m.length;
      return out;
    }
    r = fixed;
  }
  if (!r.problem.empty())
    throw InputError("the rest state has no room nearby: " + r.problem + tightest_pair(spec, m, r.state));
  if (const std::string problem = meshes(r.state); !problem.empty()) throw InputError(problem);
  out.scene = with_rest(spec, m, r.state);
  out.moved = r.largest_motion * m.length;
  return out;
}

SceneSpec with_rest(const SceneSpec& spec, const Model& m, const State& rest)
{
  SceneSpec scene = spec;
  const std::vector<Pose> p = poses(m, rest);
  for (std::size_t k = 0; k < p.size(); ++k)
    scene.elements[k].rest = {p[k].position * m.length, p[k].rotation};
  return scene;
}

}  // namespace hauberk
