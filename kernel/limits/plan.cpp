#include "limits/plan.hpp"

#include "equilibrium/gaps.hpp"
#include "geometry/facets.hpp"
#include "geometry/separation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace hauberk {
namespace {

constexpr std::size_t most_tight_pairs = 10;
constexpr double tight_range = 0.3;  ///< L: farther pairs are not listed

std::string reduction(const Body& a, const Body& b)
{
  if (a.facets || b.facets)
    return "meshes: points and triangles, edges and edges, nearest points in closed form";
  if (a.curve && b.curve) return "distance of two curves minus radii: both coordinates searched";
  if (a.curve || b.curve)
    return "one coordinate of the curve searched, the distance to the torus in closed form or by one angle";
  if (a.is_circle_tube() && b.is_circle_tube())
    return "distance of two circles minus radii: one angle searched, the other in closed form";
  if (a.is_circle_tube() || b.is_circle_tube())
    return "distance of a circle to a revolved ellipse: one angle searched, point-ellipse in the meridian "
           "plane";
  return "two angles searched on one surface, point-ellipse in the meridian plane of the other";
}

/// True if all primitives of the element share one axis of revolution, so that spinning about it is inert.
bool spins(const Model& m, std::size_t element)
{
  const Body& first = m.bodies[static_cast<std::size_t>(m.first_body[element])];
  for (int k = m.first_body[element]; k < m.first_body[element + 1]; ++k) {
    const Body& b = m.bodies[static_cast<std::size_t>(k)];
    const Vec3 axis = first.axes.col(2);
    if (b.curve || b.surface || b.axes.col(2).cross(axis).norm() > 1e-12 ||
        (b.center - first.center).cross(axis).norm() > 1e-12)
      return false;
  }
  return true;
}

/// Whether loops that several primitives form link these two, of elements that their primitives' links alone
/// do not account for.
bool linked_together(const Model& m, const std::vector<ElementLink>& links, const Gap& g)
{
  const Body &A = m.bodies[static_cast<std::size_t>(g.a)], &B = m.bodies[static_cast<std::size_t>(g.b)];
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

/// The closest pairs of bodies at rest, each once.
void list_tightest(Plan& p, const Model& m, const State& rest)
{
  const std::vector<ElementLink> links = element_links(m);
  std::map<std::tuple<int, int, Image>, std::size_t> seen;  // bodies and image: where in the list
  for (const Gap& g : find_gaps(m, rest, tight_range, false)) {
    const Body& A = m.bodies[static_cast<std::size_t>(g.a)];
    const Body& B = m.bodies[static_cast<std::size_t>(g.b)];
    TightPair t;
    t.elements = {A.element, B.element};
    t.primitives = {A.index, B.index};
    t.image = g.image;
    t.distance = (g.gap + m.clearance) * m.length;
    t.linked = linking_number(A, image_pose(m, rest, A.element, {0, 0}), B,
                              image_pose(m, rest, B.element, g.image)) != 0 ||
               linked_together(m, links, g);
    const auto [at, added] = seen.try_emplace({g.a, g.b, g.image}, p.tightest.size());
    if (added) {
      p.tightest.push_back(t);
    } else {
      TightPair& same = p.tightest[at->second];
      same.distance = std::min(same.distance, t.distance);
    }
  }
  std::stable_sort(p.tightest.begin(), p.tightest.end(),
                   [](const TightPair& a, const TightPair& b) { return a.distance < b.distance; });
  if (p.tightest.size() > most_tight_pairs) p.tightest.resize(most_tight_pairs);
}

/// Triangles and edges of the primitives, of which each may have others.
std::string mesh_decision(const Model& m)
{
  std::size_t least = std::numeric_limits<std::size_t>::max(), most = 0, edges = 0;
  for (const Body& b : m.bodies) {
    least = std::min(least, b.facets->triangles().size());
    most = std::max(most, b.facets->triangles().size());
    edges = std::max(edges, b.facets->edges().size());
  }
  const std::string triangles = least == most ? fmt::format("{} triangles and {} edges", most, edges)
                                              : fmt::format("{} to {} triangles", least, most);
  return fmt::format("contact: of meshes in every stage, {} a primitive; values are those of the meshes",
                     triangles);
}

void decide(Plan& p, const Model& m, const std::vector<LimitTask>& tasks, const LimitSettings& settings)
{
  if (p.inert > 0) {
    p.decisions.push_back(
        fmt::format("{} elements are surfaces of revolution about one axis: their spin is inert and "
                    "carries only the regularisation of null directions",
                    p.inert));
  }
  if (m.coordinate_count == 2) p.decisions.emplace_back("z is fixed: one unknown less per element");
  const bool smooth_only =
      std::all_of(m.bodies.begin(), m.bodies.end(), [](const Body& b) { return b.is_circle_tube(); });
  if (smooth_only)
    p.decisions.emplace_back("every cross-section is a circle: no surface is searched in two angles");
  switch (settings.contact) {
    case ContactChoice::automatic:
      p.decisions.push_back(
          fmt::format("contact: arc down to an activation distance of {:g} L, nearest below; arc "
                      "again where contacts merge, and from where nearest stalls",
                      settings.schedule.change));
      break;
    case ContactChoice::nearest:
      p.decisions.emplace_back("contact: nearest in every stage");
      break;
    case ContactChoice::arc:
      p.decisions.emplace_back("contact: arc in every stage");
      break;
    case ContactChoice::published:
      p.decisions.emplace_back(
          "contact: published in every stage (squared distances of charts, faded by an eigenvalue)");
      break;
    case ContactChoice::mesh:
      p.decisions.push_back(mesh_decision(m));
      break;
    case ContactChoice::constrained:
      p.decisions.push_back(fmt::format(
          "contact: gaps of at least {:g} L as constraints of quadratic programs, no energy; nothing is "
          "certified on the way",
          constrained_margin(settings.schedule)));
      break;
  }
  if (settings.schedule.search == MinimaSearch::sampled)
    p.decisions.emplace_back("closest points: Newton's method from samples, a minimum may be missed");
  if (settings.schedule.ccd == CollisionCheck::sampled)
    p.decisions.emplace_back("collisions: sought from samples along each step, one may be missed");
  if (std::isfinite(settings.schedule.target)) {
    p.decisions.push_back(fmt::format(
        "objective: squared distance of the macroscopic unknowns to {:g} times the load; it holds back what "
        "carries no load",
        settings.schedule.target));
  }
  if (settings.contact != ContactChoice::constrained) {
    const std::vector<double> stages = activation_distances(settings.schedule);
    p.decisions.push_back(fmt::format("stages: {}, activation distances {:g} L to {:g} L", stages.size(),
                                      stages.front(), stages.back()));
  }
  const std::size_t neighbours = with_neighbours(m, tasks, settings.neighbours).size() - tasks.size();
  if (neighbours > 0) {
    p.decisions.push_back(
        fmt::format("search: limits without company learn from {} neighbours {:g} degrees beside them",
                    neighbours, settings.neighbours));
  }
}

}  // namespace

Plan make_plan(const Model& m, const std::vector<LimitTask>& tasks, const LimitSettings& settings)
{
  Plan p;
  p.length = m.length;
  p.elements = m.element_count();
  p.primitives = static_cast<int>(m.bodies.size());
  p.unknowns = m.dofs();
  p.linear_solver = m.sparse() ? "sparse Cholesky (CHOLMOD, supernodal)" : "dense Cholesky";
  for (std::size_t i = 0; i < m.rest.size(); ++i) p.inert += spins(m, i) ? 1 : 0;
  p.links_per_element.assign(m.rest.size(), 0);
  for (const ElementLink& l : element_links(m)) {
    for (const int element : {l.pair.i, l.pair.j})
      p.links_per_element[static_cast<std::size_t>(element)] += l.primitives + l.together;
  }

  const State rest = rest_state(m);
  std::map<std::string, PairPlan> kinds;
  for (const ElementPair& pair : near_pairs(m, rest, m.clearance + settings.schedule.first)) {
    ++p.image_pairs;
    for (std::size_t k = 0; k < pair.image.size(); ++k) {
      if (std::abs(pair.image[k]) > std::abs(p.farthest_image[k])) p.farthest_image[k] = pair.image[k];
    }
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body& A = m.bodies[static_cast<std::size_t>(a)];
        const Body& B = m.bodies[static_cast<std::size_t>(b)];
        std::string x = name_of(A.kind), y = name_of(B.kind);
        if (y < x) std::swap(x, y);
        const std::string name = fmt::format("{} / {}", x, y);
        PairPlan& k = kinds[name];
        k.kinds = name;
        k.distance = reduction(A, B);
        ++k.pairs;
      }
    }
  }
  list_tightest(p, m, rest);
  for (auto& [name, k] : kinds) p.pairs.push_back(k);
  decide(p, m, tasks, settings);
  for (const LimitTask& t : tasks) {
    const Boundedness b = bounded_by_links(m, t);
    p.bounded.emplace_back(t, b == Boundedness::attained    ? "attained"
                              : b == Boundedness::unbounded ? "unbounded"
                                                            : "not attained");
  }
  return p;
}

}  // namespace hauberk
