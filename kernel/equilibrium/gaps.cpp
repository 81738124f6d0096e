#include "equilibrium/gaps.hpp"

#include "contact/mesh.hpp"
#include "geometry/facets.hpp"
#include "model/links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// A side of a pair of bodies as the unknowns see it: P probes F.
struct Side {
  const Model& m;
  const ElementPair& pair;
  int p, f;
  bool swapped;
  const Pose &pp, &pf;
  const PositionMap &mi, &mj;
  long& evaluations;
};

Gap gap_between(const Side& side, double gap)
{
  Gap g;
  g.a = side.swapped ? side.f : side.p;
  g.b = side.swapped ? side.p : side.f;
  g.image = side.pair.image;
  g.gap = gap;
  return g;
}

/// Derivatives of a gap out of those of its side (terms of weight 1).
void set_derivatives(const Side& side, const PairFrame& frame, const SideTerms& t, Gap& g)
{
  const Model& m = side.m;
  const PairTerms w = to_world(t, frame.M, side.pp.position - side.pf.position, 1);
  const int nm = m.macro_count, nc = m.coordinate_count;
  const Vec3 eta = side.swapped ? Vec3(-w.gradient.head<3>()) : Vec3(w.gradient.head<3>());
  const Vec3 wi = side.swapped ? w.gradient.segment<3>(6) : w.gradient.segment<3>(3);
  const Vec3 wj = side.swapped ? w.gradient.segment<3>(3) : w.gradient.segment<3>(6);
  g.dy = Vector::Zero(m.dofs());
  g.dy.head(nm) = (side.mi.J.leftCols(nm) - side.mj.J.leftCols(nm)).transpose() * eta;
  g.dy.segment(m.offset(side.pair.i), nc) += side.mi.J.middleCols(nm, nc).transpose() * eta;
  g.dy.segment(m.offset(side.pair.j), nc) -= side.mj.J.middleCols(nm, nc).transpose() * eta;
  g.dy.segment<3>(m.offset(side.pair.i) + nc) += wi;
  g.dy.segment<3>(m.offset(side.pair.j) + nc) += wj;
  const GeometryTerms geometry =
      geometry_terms(t, frame.M, m.bodies[side.p], side.pp, m.bodies[side.f], side.pf);
  const Vector dp = parameter_gradient(m, side.p, geometry.P);
  const Vector df = parameter_gradient(m, side.f, geometry.F);
  g.da = side.swapped ? df : dp;
  g.db = side.swapped ? dp : df;
}

template <int dim>
void gaps_of(const Side& side, const PairFrame& frame, double range, bool derivatives, std::vector<Gap>& out)
{
  const Model& m = side.m;
  const Probe<dim> probe(frame);
  int evaluations = 0;
  for (const Minimum& mm : local_minima<dim>(frame, range + m.clearance, evaluations)) {
    Gap g = gap_between(side, mm.distance - m.clearance);
    if (derivatives) {
      const ProbePoint q = probe.at(mm.u, mm.v);
      const FieldValue v = field_at(*frame.F, q.p);
      SideTerms t;
      t.add(v, q.on_p - frame.o, 1.0, 0.0, 1);
      t.template add_parameters<dim>(frame, v, q, 1.0);
      set_derivatives(side, frame, t, g);
    }
    out.push_back(std::move(g));
  }
  side.evaluations += evaluations;
}

/// Of meshes: the smallest gap, or with derivatives those of all features within range.
void mesh_gaps(const Side& side, const PairFrame& frame, double range, bool derivatives,
               std::vector<Gap>& out)
{
  const Model& m = side.m;
  if (derivatives) {
    for (const FeatureGap& feature : feature_gaps(frame, range, m.clearance)) {
      Gap g = gap_between(side, feature.gap);
      set_derivatives(side, frame, feature.terms, g);
      out.push_back(std::move(g));
    }
    return;
  }
  const double gap = smallest_feature_distance(frame, range + m.clearance) - m.clearance;
  if (gap < range) out.push_back(gap_between(side, gap));
}

/// All gaps of a pair of bodies a, b.
void body_gaps(const Model& m, const ElementPair& pair, int a, int b, const Pose& pi, const Pose& pj,
               const PositionMap& mi, const PositionMap& mj, double range, bool derivatives,
               long& evaluations, std::vector<Gap>& out)
{
  const Body& A = m.bodies[a];
  const Body& B = m.bodies[b];
  const bool swapped = !A.facets && second_probes(A, B);
  const Side side{m,  pair, swapped ? b : a, swapped ? a : b, swapped, swapped ? pj : pi, swapped ? pi : pj,
                  mi, mj,   evaluations};
  const PairFrame frame(m.bodies[side.p], side.pp, m.bodies[side.f], side.pf);
  if (A.facets) {
    mesh_gaps(side, frame, range, derivatives, out);
  } else if (probe_dimension(frame) == 1) {
    gaps_of<1>(side, frame, range, derivatives, out);
  } else {
    gaps_of<2>(side, frame, range, derivatives, out);
  }
}

}  // namespace

std::vector<Gap> find_gaps(const Model& m, const State& s, double range, bool derivatives, long* evaluations)
{
  long count = 0;
  std::vector<Gap> out;
  const double reach = range + m.clearance;
  PositionMap mi, mj;
  const std::size_t nm = m.macro_count, nc = m.coordinate_count;
  for (const ElementPair& pair : near_pairs(m, s, reach)) {
    const std::size_t i = pair.i, j = pair.j;
    m.load->position({s.macro.data(), nm}, {s.e.data() + i * nc, nc}, m.rest[i].position, Vec3::Zero(), mi);
    m.load->position({s.macro.data(), nm}, {s.e.data() + j * nc, nc}, m.rest[j].position,
                     m.translation(pair.image), mj);
    const Pose pi{mi.x, s.rotation[i]}, pj{mj.x, s.rotation[j]};
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body& A = m.bodies[a];
        const Body& B = m.bodies[b];
        const double d = (pi.position + pi.rotation * A.center - pj.position - pj.rotation * B.center).norm();
        if (d >= A.bound + B.bound + reach) continue;
        body_gaps(m, pair, a, b, pi, pj, mi, mj, range, derivatives, count, out);
      }
    }
  }
  if (evaluations != nullptr) *evaluations += count;
  return out;
}

double smallest_gap(const Model& m, const State& s, double range)
{
  // Where something is nearly touching, a narrow search finds it, and is a cheap one.
  constexpr double nearly_touching = 1e-4;
  double g = std::numeric_limits<double>::infinity();
  for (const double within : {std::min(range, nearly_touching), range}) {
    for (const Gap& x : find_gaps(m, s, within, false)) g = std::min(g, x.gap);
    if (g < within || within == range) break;
  }
  return g;
}

bool meshes_meet(const Model& m, const State& s)
{
  for (const ElementPair& pair : near_pairs(m, s, 0.0)) {
    const Pose pi = image_pose(m, s, pair.i, {0, 0}), pj = image_pose(m, s, pair.j, pair.image);
    const std::size_t i = pair.i, j = pair.j;
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body &A = m.bodies[a], &B = m.bodies[b];
        if (A.facets && B.facets && facets_intersect(PairFrame(A, pi, B, pj))) return true;
      }
    }
  }
  return false;
}

std::string body_name(const SceneSpec& spec, const Body& body)
{
  const PlacedElement& element = spec.elements[body.element];
  const ElementType& type = spec.types[element.type];
  const std::vector<Primitive> primitives = type.shape->primitives(element.parameters);
  return fmt::format("element {} ({} of {})", body.element, primitives[body.index].name, type.name);
}

std::string pair_name(const SceneSpec& spec, const Model& m, const Gap& g)
{
  std::string text = body_name(spec, m.bodies[g.a]) + " and " + body_name(spec, m.bodies[g.b]);
  if (g.image != Image{}) text += fmt::format(" of image [{}]", fmt::join(shown(g.image), ", "));
  return text;
}

std::string tightest_pair(const SceneSpec& spec, const Model& m, const State& s)
{
  const std::vector<Gap> gaps = find_gaps(m, s, 1.0, false);
  const auto least =
      std::min_element(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.gap < b.gap; });
  if (least == gaps.end()) return "";
  return "; the tightest are " + pair_name(spec, m, *least) +
         (spec.length_unit.empty() ? "" : " (lengths in " + spec.length_unit + ")");
}

}  // namespace hauberk
