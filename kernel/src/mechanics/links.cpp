#include <hauberk/geometry/separation.hpp>
#include <hauberk/mechanics/model.hpp>

#include <algorithm>
#include <deque>
#include <tuple>

namespace hauberk {

std::vector<Link> find_links(const Model& m, const State& s)
{
  std::vector<Link> links;
  const std::vector<Pose> p = poses(m, s);
  for (const ElementPair& pair : near_pairs(m, s, 0.0)) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    const Pose other = image_pose(m, s, pair.j, pair.image);
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body& A = m.bodies[static_cast<std::size_t>(a)];
        const Body& B = m.bodies[static_cast<std::size_t>(b)];
        const double d =
            (p[i].position + p[i].rotation * A.center - other.position - other.rotation * B.center).norm();
        if (d >= A.core_bound() + B.core_bound()) continue;
        const int number = linking_number(A, p[i], B, other);
        if (number != 0) links.push_back({a, b, pair.image, number});
      }
    }
  }
  return links;
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
  const auto n = static_cast<std::size_t>(m.element_count());
  std::vector<Image> at(n);
  std::vector<bool> seen(n, false);
  std::vector<Vec3> cycles;
  const auto element = [&](int body) {
    return static_cast<std::size_t>(m.bodies[static_cast<std::size_t>(body)].element);
  };
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
