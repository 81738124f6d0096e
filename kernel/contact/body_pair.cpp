#include "contact/body_pair.hpp"

#include "contact/mesh.hpp"
#include "contact/published.hpp"
#include "geometry/panel_bound.hpp"
#include "geometry/strip.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace hauberk {
namespace {

/// What takes both bodies for tori.
void refuse_others(const PairFrame& frame, const char* what)
{
  const auto known = [](const Body& b) { return !b.curve && !b.solid; };
  if (known(*frame.P) && known(*frame.F)) return;
  const bool curve = frame.P->curve != nullptr;
  throw InputError(fmt::format("{} knows tori only, no {}; use arc, nearest or auto", what,
                               curve ? "tubes around curves" : "solids"));
}

/// Everything but contact of meshes takes a body for a torus, or for a tube around its curve.
void refuse_surfaces(const PairFrame& frame)
{
  if (frame.P->surface || frame.F->surface)
    throw InputError("contact of surfaces knows no triangle meshes: set solver.contact to \"mesh\"");
}

template <int dim>
void add_terms(const PairFrame& frame, const ContactSettings& settings, const Request& request, double share,
               const NearPanels& near, SideTerms& out)
{
  switch (settings.formulation) {
    case Formulation::arc:
      if (dim == 2 && settings.sides == Sides::ribbon && has_strips(frame))
        return add_ribbon(frame, settings, request, share, near, out);
      return add_arc<dim>(frame, settings, request, share, near, out);
    case Formulation::published:
      refuse_others(frame, "contact 'published'");
      return add_published<dim>(frame, settings, request, out);
    case Formulation::nearest:
      return add_nearest<dim>(frame, settings, request, near, out);
    case Formulation::mesh:
      return add_mesh(frame, settings, request, out);
  }
}

/// Second derivatives of the distance to F along P's surface at the chart point (u, v) where it is
/// stationary, in unit tangents: with the field's Hessian K and the outward normal n of F,
///
///   H_ij = V_,i . K V_,j + n . V_,ij,   |V_u| = w,  |V_v|^2 = r0^2 sin^2 v + r1^2 cos^2 v,  V_u . V_v = 0.
///
/// K is F's curvature at the distance g, K_F (I + g K_F)^-1, and n . V_,ij is P's own, whose normal is -n.
double smallest_relative_curvature(const PairFrame& frame, double u, double v)
{
  const Probe<2> probe(frame);
  const ProbePoint q = probe.at(u, v);
  const SecondDerivatives h = surface_hessian(probe, q, field_at(*frame.F, q.p));
  const double along_u = q.pu.norm(), along_v = q.pv.norm();
  const double uu = h.uu / (along_u * along_u), vv = h.vv / (along_v * along_v);
  return 0.5 * (uu + vv) - std::hypot(0.5 * (uu - vv), h.uv / (along_u * along_v));
}

template <int dim>
std::vector<ContactMinimum> minima_of(const PairFrame& frame, double threshold, double clearance,
                                      int& evaluations)
{
  std::vector<ContactMinimum> out;
  const TorusPair<double> pair = torus_pair(frame);
  for (const Minimum& m : local_minima<dim>(frame, threshold, evaluations)) {
    if (m.distance <= 0.0) continue;
    const TorusCoordinates<double> c = published::chart_start<dim>(frame, m);
    const published::PublishedMinimum chart = published::refine(pair, c, evaluations);
    ContactMinimum found;
    found.on_a = frame.P->center + frame.P->axes * chart_point(*frame.P, c[0], c[1]);
    found.on_b = frame.F->center + frame.F->axes * chart_point(*frame.F, c[2], c[3]);
    found.distance = m.distance;
    // Of the squared gap (sqrt(d) - clearance)^2: at a stationary point its Hessian is this multiple of d's.
    found.chart_eigenvalue = chart.converged ? (1.0 - clearance / std::sqrt(chart.d)) * chart.eigenvalues[0]
                                             : std::numeric_limits<double>::quiet_NaN();
    found.relative_curvature = smallest_relative_curvature(frame, c[0], c[1]);
    out.push_back(found);
  }
  return out;
}

}  // namespace

std::span<const PairSide> pair_sides(const Body& A, const Body& B, const ContactSettings& settings)
{
  static constexpr std::array one{PairSide{false, 1.0}}, other{PairSide{true, 1.0}};
  static constexpr std::array both{PairSide{false, 0.5}, PairSide{true, 0.5}};
  const int a = probe_rank(A), b = probe_rank(B);
  const FormulationTraits contact = traits(settings.formulation);
  if (contact.is_integral && a == b && !A.curve && settings.sides == Sides::both) return both;
  if (contact.is_of_gaps) return second_probes(A, B) ? other : one;
  return a <= b ? one : other;
}

SideTerms side_terms(const PairFrame& frame, const ContactSettings& settings, const Request& request,
                     double share, const NearPanels& near)
{
  SideTerms out;
  if (!traits(settings.formulation).is_of_meshes) refuse_surfaces(frame);
  if (probe_dimension(frame) == 1)
    add_terms<1>(frame, settings, request, share, near, out);
  else
    add_terms<2>(frame, settings, request, share, near, out);
  return out;
}

void add_side(const PairTerms& side, bool swapped, int order, PairTerms& sum)
{
  sum.energy += side.energy;
  if (!swapped) {
    sum.gradient += side.gradient;
    if (order >= 2) sum.hessian += side.hessian;
    return;
  }
  constexpr std::array<int, 9> at{0, 1, 2, 6, 7, 8, 3, 4, 5};
  for (int i = 0; i < 9; ++i) {
    const double si = i < 3 ? -1.0 : 1.0;
    sum.gradient[at[i]] += si * side.gradient[i];
    if (order < 2) continue;
    for (int j = 0; j < 9; ++j) {
      sum.hessian(at[i], at[j]) += si * (j < 3 ? -1.0 : 1.0) * side.hessian(i, j);
    }
  }
}

PairContact pair_contact(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b,
                         const ContactSettings& settings, int order)
{
  PairContact out;
  for (const PairSide& side : pair_sides(A, B, settings)) {
    const PairFrame frame = side.swapped ? PairFrame(B, pose_b, A, pose_a) : PairFrame(A, pose_a, B, pose_b);
    const SideTerms terms = side_terms(frame, settings, Request{order, false, false}, side.share);
    const Vec3 shift = pose_a.position - pose_b.position;
    add_side(to_world(terms, frame.M, side.swapped ? Vec3(-shift) : shift, order), side.swapped, order,
             out.terms);
    out.min_gap = std::min(out.min_gap, terms.min_gap);
    out.regularity = std::min(out.regularity, terms.regularity);
    out.evaluations += terms.evaluations;
  }
  return out;
}

std::vector<ContactMinimum> contact_minima(const Body& A, const Pose& pose_a, const Body& B,
                                           const Pose& pose_b, double threshold, double clearance,
                                           int& evaluations)
{
  const bool swapped = probe_rank(B) < probe_rank(A);
  const PairFrame frame = swapped ? PairFrame(B, pose_b, A, pose_a) : PairFrame(A, pose_a, B, pose_b);
  refuse_others(frame, "the list of contact minima");
  refuse_surfaces(frame);
  std::vector<ContactMinimum> out = probe_dimension(frame) == 1
                                        ? minima_of<1>(frame, threshold, clearance, evaluations)
                                        : minima_of<2>(frame, threshold, clearance, evaluations);
  if (swapped) {
    for (ContactMinimum& m : out) std::swap(m.on_a, m.on_b);
  }
  return out;
}

}  // namespace hauberk
