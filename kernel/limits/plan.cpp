#include "limits/plan.hpp"

#include "equilibrium/gaps.hpp"
#include "geometry/facets.hpp"
#include "geometry/separation.hpp"
#include "limits/rest_searches.hpp"
#include "model/links.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <tuple>

namespace hauberk {
namespace {

constexpr std::size_t most_tight_pairs = 10;
constexpr double tight_range = 0.3;  ///< L: farther pairs are not listed

Reduction reduction(const Body& a, const Body& b)
{
  if (a.facets || b.facets) return Reduction::meshes;
  if (a.solid || b.solid) return Reduction::solids;
  if (a.curve && b.curve) return Reduction::two_curves;
  if (a.curve || b.curve) return Reduction::curve_and_torus;
  if (a.is_circle_tube() && b.is_circle_tube()) return Reduction::two_circles;
  return a.is_circle_tube() || b.is_circle_tube() ? Reduction::circle_and_surface : Reduction::two_surfaces;
}

/// True if all primitives of the element share one axis of revolution, so that spinning about it is inert.
bool spins(const Model& m, std::size_t element)
{
  const Body& first = m.bodies[m.first_body[element]];
  for (int k = m.first_body[element]; k < m.first_body[element + 1]; ++k) {
    const Body& b = m.bodies[k];
    const Vec3 axis = first.axes.col(2);
    if (b.curve || b.surface || b.solid || b.axes.col(2).cross(axis).norm() > 1e-12 ||
        (b.center - first.center).cross(axis).norm() > 1e-12)
      return false;
  }
  return true;
}

/// Whether loops that several primitives form link these two, of elements that their primitives' links alone
/// do not account for.
bool linked_together(const Model& m, const std::vector<ElementLink>& links, const Gap& g)
{
  const Body &A = m.bodies[g.a], &B = m.bodies[g.b];
  const auto same = [&](const ElementPair& p) {
    return p.i == A.element && p.j == B.element && p.image == g.image;
  };
  if (std::none_of(links.begin(), links.end(),
                   [&](const ElementLink& l) { return l.together > 0 && same(l.pair); }))
    return false;
  const auto follows = [&m](int cycle, const Body& b) {
    const std::vector<int> primitives = primitives_of_cycle(m, cycle);
    return element_of_cycle(m, cycle) == b.element &&
           std::find(primitives.begin(), primitives.end(), b.index) != primitives.end();
  };
  return std::any_of(m.links.begin(), m.links.end(),
                     [&](const Link& l) { return l.image == g.image && follows(l.a, A) && follows(l.b, B); });
}

/// Triangles and edges of the primitives, of which each may have others.
MeshPlan mesh_plan(const Model& m)
{
  MeshPlan out{std::numeric_limits<std::size_t>::max(), 0, 0};
  for (const Body& b : m.bodies) {
    out.least_triangles = std::min(out.least_triangles, b.facets->triangles().size());
    out.most_triangles = std::max(out.most_triangles, b.facets->triangles().size());
    out.most_edges = std::max(out.most_edges, b.facets->edges().size());
  }
  return out;
}

}  // namespace

Plan make_plan(const Model& m, const std::vector<LimitTask>& tasks, const LimitSettings& settings)
{
  Plan p;
  p.length = m.length;
  p.elements = m.element_count();
  p.primitives = static_cast<int>(m.bodies.size());
  p.unknowns = m.dofs();
  p.sparse = m.sparse();
  p.height_fixed = m.coordinate_count == 2;
  p.circles_only =
      std::all_of(m.bodies.begin(), m.bodies.end(), [](const Body& b) { return b.is_circle_tube(); });
  p.contact = settings.contact;
  p.schedule = settings.schedule;
  if (settings.contact != ContactChoice::constrained)
    p.stages = planned_stages(m, settings.contact, settings.schedule);
  if (settings.contact == ContactChoice::mesh) p.mesh = mesh_plan(m);
  p.company = rest_searches(m, tasks, settings).size() - tasks.size();
  p.searches = count_searches(m, tasks, settings);
  for (std::size_t i = 0; i < m.rest.size(); ++i) p.inert += spins(m, i) ? 1 : 0;
  p.links_per_element.assign(m.rest.size(), 0);
  for (const ElementLink& l : element_links(m)) {
    for (const int element : {l.pair.i, l.pair.j}) p.links_per_element[element] += l.primitives + l.together;
  }

  const State rest = rest_state(m);
  std::map<std::array<std::string, 2>, PairPlan> kinds;
  for (const ElementPair& pair : near_pairs(m, rest, m.clearance + settings.schedule.first)) {
    ++p.image_pairs;
    for (std::size_t k = 0; k < pair.image.size(); ++k) {
      if (std::abs(pair.image[k]) > std::abs(p.farthest_image[k])) p.farthest_image[k] = pair.image[k];
    }
    const std::size_t i = pair.i, j = pair.j;
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body& A = m.bodies[a];
        const Body& B = m.bodies[b];
        std::array<std::string, 2> names{name_of(A.kind), name_of(B.kind)};
        std::array<PrimitiveKind, 2> of{A.kind, B.kind};
        if (names[1] < names[0]) {
          std::swap(names[0], names[1]);
          std::swap(of[0], of[1]);
        }
        ++kinds.try_emplace(names, PairPlan{of, reduction(A, B), 0}).first->second.pairs;
      }
    }
  }
  for (auto& [name, k] : kinds) p.pairs.push_back(k);
  for (const LimitTask& t : tasks) p.bounded.emplace_back(t, bounded_by_links(m, t));
  return p;
}

std::vector<TightPair> tightest_pairs(const Model& m)
{
  const State rest = rest_state(m);
  const std::vector<ElementLink> links = element_links(m);
  std::map<std::tuple<int, int, Image>, std::size_t> seen;  // bodies and image: where in the list
  std::vector<TightPair> out;
  for (const Gap& g : find_gaps(m, rest, tight_range, false)) {
    const Body& A = m.bodies[g.a];
    const Body& B = m.bodies[g.b];
    TightPair t;
    t.elements = {A.element, B.element};
    t.primitives = {A.index, B.index};
    t.image = g.image;
    t.distance = (g.gap + m.clearance) * m.length;
    t.linked = linking_number(A, image_pose(m, rest, A.element, {0, 0}), B,
                              image_pose(m, rest, B.element, g.image)) != 0 ||
               linked_together(m, links, g);
    const auto [at, added] = seen.try_emplace({g.a, g.b, g.image}, out.size());
    if (added) {
      out.push_back(t);
    } else {
      TightPair& same = out[at->second];
      same.distance = std::min(same.distance, t.distance);
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const TightPair& a, const TightPair& b) { return a.distance < b.distance; });
  if (out.size() > most_tight_pairs) out.resize(most_tight_pairs);
  return out;
}

}  // namespace hauberk
