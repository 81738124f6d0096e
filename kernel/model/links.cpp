#include "model/links.hpp"

#include "geometry/separation.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <tuple>

namespace hauberk {
namespace {

/// Global index of a cycle of an element's spine.
int cycle_index(const Model& m, std::size_t element, std::size_t cycle)
{
  const std::size_t cores = m.spines[element]->cores.size();
  return cycle < cores
             ? m.first_body[element] + static_cast<int>(cycle)
             : static_cast<int>(m.bodies.size()) + m.first_loop[element] + static_cast<int>(cycle - cores);
}

/// Links of the loops that several primitives form together.
void add_loops(std::vector<Link>& links, const Model& m, const ElementPair& pair, const Pose& pose,
               const Pose& other)
{
  const std::size_t i = pair.i, j = pair.j;
  const Spine &a = *m.spines[i], &b = *m.spines[j];
  if (a.loops.empty() && b.loops.empty()) return;
  const Eigen::MatrixXi numbers = linking_numbers(a, pose, b, other);
  for (Eigen::Index k = 0; k < numbers.rows(); ++k) {
    for (Eigen::Index l = 0; l < numbers.cols(); ++l) {
      if (numbers(k, l) == 0) continue;
      links.push_back({cycle_index(m, i, static_cast<std::size_t>(k)),
                       cycle_index(m, j, static_cast<std::size_t>(l)), pair.image, numbers(k, l)});
    }
  }
}

/// Rank of the matrix of those linking numbers of two elements that are wanted.
template <class Wanted>
int rank(const std::vector<const Link*>& links, const Wanted& wanted)
{
  std::map<int, Eigen::Index> rows, cols;
  for (const Link* l : links) {
    if (!wanted(*l)) continue;
    rows.try_emplace(l->a, static_cast<Eigen::Index>(rows.size()));
    cols.try_emplace(l->b, static_cast<Eigen::Index>(cols.size()));
  }
  if (rows.empty()) return 0;
  Matrix numbers =
      Matrix::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(cols.size()));
  for (const Link* l : links)
    if (wanted(*l)) numbers(rows.at(l->a), cols.at(l->b)) = l->number;
  return static_cast<int>(numbers.fullPivLu().rank());
}

}  // namespace

std::vector<Link> find_links(const Model& m, const State& s)
{
  std::vector<Link> links;
  const std::vector<Pose> p = poses(m, s);
  for (const ElementPair& pair : near_pairs(m, s, 0.0)) {
    const std::size_t i = pair.i, j = pair.j;
    const Pose other = image_pose(m, s, pair.j, pair.image);
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body& A = m.bodies[a];
        const Body& B = m.bodies[b];
        const double d =
            (p[i].position + p[i].rotation * A.center - other.position - other.rotation * B.center).norm();
        if (d >= A.core_bound() + B.core_bound()) continue;
        const int number = linking_number(A, p[i], B, other);
        if (number != 0) links.push_back({a, b, pair.image, number});
      }
    }
    if (!m.spines.empty()) add_loops(links, m, pair, p[i], other);
  }
  return links;
}

int element_of_cycle(const Model& m, int cycle)
{
  const int bodies = static_cast<int>(m.bodies.size());
  if (cycle < bodies) return m.bodies[cycle].element;
  const auto after = std::upper_bound(m.first_loop.begin(), m.first_loop.end(), cycle - bodies);
  return static_cast<int>(after - m.first_loop.begin()) - 1;
}

std::vector<int> primitives_of_cycle(const Model& m, int cycle)
{
  const int bodies = static_cast<int>(m.bodies.size());
  if (cycle < bodies) return {m.bodies[cycle].index};
  const std::size_t element = element_of_cycle(m, cycle);
  return m.spines[element]->loops[cycle - bodies - m.first_loop[element]].primitives;
}

std::vector<ElementLink> element_links(const Model& m)
{
  struct Found {
    ElementLink link;
    std::vector<const Link*> all;
  };
  std::vector<Found> found;
  std::map<std::tuple<int, int, Image>, std::size_t> at;
  const auto is_body = [&m](int cycle) { return cycle < static_cast<int>(m.bodies.size()); };
  for (const Link& l : m.links) {
    const ElementPair pair{element_of_cycle(m, l.a), element_of_cycle(m, l.b), l.image};
    const auto [entry, fresh] = at.try_emplace({pair.i, pair.j, pair.image}, found.size());
    if (fresh) found.push_back({{pair, 0, 0}, {}});
    Found& f = found[entry->second];
    f.all.push_back(&l);
    if (is_body(l.a) && is_body(l.b)) ++f.link.primitives;
  }
  std::vector<ElementLink> out;
  for (Found& f : found) {
    if (static_cast<int>(f.all.size()) > f.link.primitives) {
      f.link.together = rank(f.all, [](const Link&) { return true; }) -
                        rank(f.all, [&](const Link& l) { return is_body(l.a) && is_body(l.b); });
    }
    out.push_back(f.link);
  }
  return out;
}

bool same_loops(const Model& a, const Model& b)
{
  if (a.first_loop != b.first_loop) return false;
  for (std::size_t e = 0; e < a.spines.size(); ++e) {
    const bool same =
        a.spines[e] == b.spines[e] ||
        std::equal(a.spines[e]->loops.begin(), a.spines[e]->loops.end(), b.spines[e]->loops.begin(),
                   b.spines[e]->loops.end(), [](const SpineLoop& x, const SpineLoop& y) {
                     return x.pieces == y.pieces && x.primitives == y.primitives;
                   });
    if (!same) return false;
  }
  return true;
}

bool links_kept(const Model& m, const State& s)
{
  const auto sorted = [](const std::vector<Link>& links) {
    std::vector<std::tuple<int, int, Image, int>> out;
    out.reserve(links.size());
    for (const Link& l : links) out.emplace_back(l.a, l.b, l.image, l.number);
    std::sort(out.begin(), out.end());
    return out;
  };
  return sorted(find_links(m, s)) == sorted(m.links);
}

std::vector<Vec3> cycle_translations(const Model& m)
{
  // Spanning forest of the quotient graph: every element gets a translation; each further link closes a
  // cycle whose translation is the mismatch.
  const std::size_t n = m.element_count();
  std::vector<Image> at(n);
  std::vector<bool> seen(n, false);
  std::vector<Vec3> cycles;
  const auto element = [&m](int cycle) { return static_cast<std::size_t>(element_of_cycle(m, cycle)); };
  std::vector<std::vector<const Link*>> links_of(n);
  for (const Link& l : m.links) {
    const std::size_t a = element(l.a), b = element(l.b);
    links_of[a].push_back(&l);
    if (b != a) links_of[b].push_back(&l);
  }
  for (std::size_t root = 0; root < n; ++root) {
    if (seen[root]) continue;
    seen[root] = true;
    std::deque<std::size_t> queue{root};
    while (!queue.empty()) {
      const std::size_t i = queue.front();
      queue.pop_front();
      for (const Link* link : links_of[i]) {
        const Link& l = *link;
        const std::size_t a = element(l.a), b = element(l.b);
        for (const bool forward : {true, false}) {
          if ((forward ? a : b) != i) continue;
          const std::size_t j = forward ? b : a;
          const int sign = forward ? 1 : -1;
          Image to = at[i];
          for (std::size_t c = 0; c < to.size(); ++c) to[c] += sign * l.image[c];
          if (!seen[j]) {
            seen[j] = true;
            at[j] = to;
            queue.push_back(j);
          } else {
            Image d = to;
            for (std::size_t c = 0; c < d.size(); ++c) d[c] -= at[j][c];
            if (d != Image{}) cycles.push_back(m.translation(d));
          }
        }
      }
    }
  }
  return cycles;
}

}  // namespace hauberk
