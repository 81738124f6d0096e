#include "together.hpp"

#include "surface.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace hauberk::verification {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double touching = 1e-9;  ///< of the radius: surfaces no farther apart touch

/// Coordinates in a solid: along its core, and depth (0 the core, 1 the surface) and angle in its section.
struct Inside {
  double u = 0.0, depth = 0.0, v = 0.0;
};

Vec3 solid_point(const Primitive& t, const Inside& at)
{
  const Vec3 core = core_point(t, at.u);
  return core + at.depth * (surface_point(t, at.u, at.v) - core);
}

/// Goes down from a sample, by steps along the coordinates that shrink where none helps.
double lowest(const std::function<double(const Inside&)>& f, Inside& at, Inside step)
{
  double value = f(at);
  for (int shrunk = 0; shrunk < 34;) {
    Inside best = at;
    double found = value;
    for (int k = 0; k < 6; ++k) {
      Inside next = at;
      const double way = k % 2 == 0 ? 1.0 : -1.0;
      if (k / 2 == 0) next.u += way * step.u;
      if (k / 2 == 1) next.depth = std::clamp(next.depth + way * step.depth, 0.0, 1.0);
      if (k / 2 == 2) next.v += way * step.v;
      if (const double there = f(next); there < found) {
        found = there;
        best = next;
      }
    }
    if (found < value) {
      at = best;
      value = found;
      continue;
    }
    step = {0.5 * step.u, 0.5 * step.depth, 0.5 * step.v};
    ++shrunk;
  }
  return value;
}

/// Samples of a solid: `along` sections of a centre, and of rings half-way to and on the surface.
struct Grid {
  int along = 160, around = 16, rings = 3;

  int count() const { return along * rings * around; }
  int index(int i, int ring, int k) const
  {
    return ((i + along) % along * rings + ring) * around + (k + around) % around;
  }
  Inside at(int n) const
  {
    const int k = n % around, ring = n / around % rings, i = n / around / rings;
    return {full_turn * i / along, static_cast<double>(ring) / (rings - 1), full_turn * k / around};
  }
  std::vector<int> beside(int n) const
  {
    const int k = n % around, ring = n / around % rings, i = n / around / rings;
    std::vector<int> out{index(i - 1, ring, k), index(i + 1, ring, k), index(i, ring, k - 1),
                         index(i, ring, k + 1)};
    if (ring > 0) out.push_back(index(i, ring - 1, k));
    if (ring + 1 < rings) out.push_back(index(i, ring + 1, k));
    return out;
  }
};

/// Marks the samples that hang together with the first in `part`.
void spread(const Grid& grid, const std::vector<double>& depth, double most, int from, int part,
            std::vector<int>& parts)
{
  std::vector<int> open{from};
  parts[from] = part;
  while (!open.empty()) {
    const int n = open.back();
    open.pop_back();
    for (const int other : grid.beside(n)) {
      const std::size_t o = other;
      if (parts[o] >= 0 || depth[o] > most) continue;
      parts[o] = part;
      open.push_back(other);
    }
  }
}

/// Coordinate of the point of a core that is nearest to x.
double nearest_on_core(const Primitive& t, const Vec3& x)
{
  constexpr int samples = 720;
  double u = 0.0, best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < samples; ++k) {
    const double there = (core_point(t, full_turn * k / samples) - x).norm();
    if (there < best) {
      best = there;
      u = full_turn * k / samples;
    }
  }
  for (double step = full_turn / samples; step > 1e-9; step *= 0.5) {
    for (const double way : {-step, step}) {
      const double there = (core_point(t, u + way) - x).norm();
      if (there >= best) continue;
      best = there;
      u += way;
    }
  }
  return u;
}

/// Corners from a core's point at u to that at w, the short way; chords stay within a quarter of the tube.
std::vector<Vec3> arc(const Primitive& t, double u, double w)
{
  const double turn = std::remainder(w - u, full_turn);
  const double chord = std::min(0.5, std::sqrt(2.0 * std::min(t.r0, t.r1) / core_bend(t)));
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / chord)));
  std::vector<Vec3> out;
  for (int k = 0; k <= count; ++k) out.push_back(core_point(t, u + turn * k / count));
  return out;
}

struct Way {
  int from = 0, to = 0;
  Overlap at;
};

/// Ways of the tree that lead from one primitive to another; false: none does.
bool find_way(const std::vector<Way>& tree, int from, int to, int came_by, std::vector<Way>& out)
{
  if (from == to) return true;
  for (int k = 0; k < static_cast<int>(tree.size()); ++k) {
    Way way = tree[k];
    if (k == came_by || (way.from != from && way.to != from)) continue;
    if (way.to == from) {
      std::swap(way.from, way.to);
      std::swap(way.at.u, way.at.v);
    }
    out.push_back(way);
    if (find_way(tree, way.to, to, k, out)) return true;
    out.pop_back();
  }
  return false;
}

Loop closed(const std::vector<Primitive>& tori, const std::vector<Way>& ways)
{
  Loop loop;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const Way &enters = ways[k], &leaves = ways[(k + 1) % ways.size()];
    loop.corners.push_back(enters.at.point);
    for (const Vec3& x : arc(tori[enters.to], enters.at.v, leaves.at.u)) loop.corners.push_back(x);
    loop.primitives.push_back(enters.to);
  }
  std::sort(loop.primitives.begin(), loop.primitives.end());
  return loop;
}

bool same(const Primitive& a, const Primitive& b)
{
  return a.place.position == b.place.position && a.place.rotation == b.place.rotation && a.R == b.R &&
         a.r0 == b.r0 && a.r1 == b.r1 && a.curve == b.curve && a.surface == b.surface &&
         a.solid_kind == b.solid_kind && a.sizes == b.sizes;
}

/// A core as many points, of a curve with ends from one to the other.
struct Along {
  static constexpr int count = 720;
  const Primitive& tube;
  const Primitive& other;
  bool ends = false;

  int points() const { return ends ? count / 2 + 1 : count; }
  double u(int n) const { return full_turn * n / count; }
  int beside(int n, int way) const
  {
    return ends ? std::clamp(n + way, 0, points() - 1) : (n + way + count) % count;
  }
  /// How far the other surface is from the tube's, seen from its core.
  double apart(double at) const { return signed_distance(other, core_point(tube, at)) - tube.r0; }
};

/// The lowest place between the neighbours of a sample.
double lowest_along(const Along& along, int n)
{
  double low = along.u(n - 1), high = along.u(n + 1);
  for (int k = 0; k < 80; ++k) {
    const double first = low + (high - low) / 3.0, second = high - (high - low) / 3.0;
    if (along.apart(first) < along.apart(second))
      high = second;
    else
      low = first;
  }
  return 0.5 * (low + high);
}

/// Places of a core where the other surface is lowest, one of each stretch in which it is no higher than
/// `most`.
std::vector<double> met_along(const Along& along, double most)
{
  std::vector<double> height;
  for (int n = 0; n < along.points(); ++n) height.push_back(along.apart(along.u(n)));
  std::vector<double> out;
  std::vector<bool> taken(height.size(), false);
  for (int n = 0; n < along.points(); ++n) {
    if (taken[n]) continue;
    if (height[n] <= most) {
      int lowest = n;
      taken[n] = true;
      for (const int way : {-1, 1})
        for (int k = along.beside(n, way); height[k] <= most && !taken[k]; k = along.beside(k, way)) {
          if (height[k] < height[lowest]) lowest = k;
          taken[k] = true;
        }
      out.push_back(along.u(lowest));
      continue;
    }
    const int before = along.beside(n, -1), after = along.beside(n, 1);
    if (height[n] > height[before] || height[n] > height[after]) continue;
    if (const double at = lowest_along(along, n); along.apart(at) <= most) out.push_back(at);
  }
  return out;
}

/// Of a pair with a solid. From a core point c the way goes straight to the nearest point of the other
/// surface, which is within the tube, unless c itself is inside of the other.
std::vector<Overlap> solid_overlaps(const Primitive& a, const Primitive& b)
{
  if (!is_tube(a)) {
    std::vector<Overlap> out = is_tube(b) ? solid_overlaps(b, a) : std::vector<Overlap>();
    for (Overlap& o : out) std::swap(o.u, o.v);
    return out;
  }
  if (b.solid && !is_tube(b)) return {};
  std::vector<Overlap> out;
  const Along along{a, b, a.solid && a.solid->fold() == Fold::mirror};
  for (const double u : met_along(along, touching * std::min(a.R, b.R))) {
    const Vec3 core = core_point(a, u);
    Vec3 outward;
    const double away = std::max(0.0, signed_distance(b, core, &outward));
    const Vec3 shared = core - away * outward;
    out.push_back({u, nearest_on_core(b, shared), shared});
  }
  return out;
}

}  // namespace

std::vector<Overlap> overlaps(const Primitive& a, const Primitive& b)
{
  std::vector<Overlap> out;
  if (a.surface || b.surface) return out;
  if ((a.place.position - b.place.position).norm() > reach(a) + reach(b) + touching * (a.R + b.R)) return out;
  if (a.solid || b.solid) return solid_overlaps(a, b);
  const Grid grid;
  std::vector<double> depth;
  for (int n = 0; n < grid.count(); ++n) depth.push_back(signed_distance(b, solid_point(a, grid.at(n))));
  const double most = touching * std::min(a.R, b.R);
  const double spacing = full_turn * (core_speed(a) + std::max(a.r0, a.r1)) / grid.along +
                         std::max(a.r0, a.r1) * (0.5 + full_turn / grid.around);
  std::vector<int> parts(depth.size(), -1);
  const auto add = [&](const Inside& at) {
    const Vec3 x = solid_point(a, at);
    const double near = 1e-3 * std::min({a.r0, a.r1, b.r0, b.r1});
    if (std::none_of(out.begin(), out.end(), [&](const Overlap& o) { return (o.point - x).norm() < near; }))
      out.push_back({at.u, nearest_on_core(b, x), x});
  };
  int part = 0;
  for (int n = 0; n < grid.count(); ++n) {
    const std::size_t k = n;
    if (depth[k] > most || parts[k] >= 0) continue;
    spread(grid, depth, most, n, part++, parts);
    add(grid.at(n));
  }
  for (int n = 0; n < grid.count(); ++n) {
    const std::size_t k = n;
    if (depth[k] <= most || depth[k] > most + spacing) continue;
    const std::vector<int> beside = grid.beside(n);
    // Beside a part it leads into that.
    if (std::any_of(beside.begin(), beside.end(),
                    [&](int o) { return parts[o] >= 0 || depth[o] < depth[k]; }))
      continue;
    Inside at = grid.at(n);
    const double low = lowest([&](const Inside& i) { return signed_distance(b, solid_point(a, i)); }, at,
                              {full_turn / grid.along, 0.25, full_turn / grid.around});
    if (low <= most) add(at);
  }
  return out;
}

std::vector<Loop> loops_together(const std::vector<Primitive>& tori)
{
  std::vector<Way> tree;
  std::vector<Loop> out;
  const int count = static_cast<int>(tori.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      for (const Overlap& o : overlaps(tori[a], tori[b])) {
        std::vector<Way> ways{{a, b, o}};
        if (find_way(tree, b, a, -1, ways)) {
          out.push_back(closed(tori, ways));
        } else {
          tree.push_back({a, b, o});
        }
      }
    }
  }
  return out;
}

void find_loops(Scene& scene)
{
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    Element& element = scene.elements[e];
    if (element.tori.size() < 2) continue;
    const auto alike = [&element](const Element& o) {
      return std::equal(element.tori.begin(), element.tori.end(), o.tori.begin(), o.tori.end(), same);
    };
    const auto end = scene.elements.begin() + static_cast<std::ptrdiff_t>(e);
    const auto known = std::find_if(scene.elements.begin(), end, alike);
    element.loops = known != end ? known->loops : loops_together(element.tori);
  }
}

}  // namespace hauberk::verification
