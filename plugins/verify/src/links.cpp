#include "links.hpp"

#include "loops.hpp"
#include "neighbours.hpp"
#include "surface.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hauberk::verification {
namespace {

std::string describe(const Link& link, int rest, int limit)
{
  return fmt::format(
      "linking number of elements {} and {}, primitives {} and {}, image {} is {} at rest and {} at the "
      "limit",
      link.elements[0], link.elements[1], link.primitives[0], link.primitives[1], shown(link.image), rest,
      limit);
}

/// The same two circles, whatever their number.
bool same_pair(const Link& a, const Link& b)
{
  return a.elements == b.elements && a.primitives == b.primitives && a.image == b.image;
}

int number_in(const std::vector<Link>& list, const Link& pair)
{
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const Link& link) { return same_pair(link, pair); });
  return it == list.end() ? 0 : it->number;
}

/// Gauss's integral of two cores that do not meet, 1/(4 pi) of that of (x - y) . (dx cross dy)/|x - y|^3, by
/// ever finer sums, which for closed smooth curves converge faster than any power.
int gauss_number(const Primitive& a, const Primitive& b)
{
  const auto sum = [&](int count) {
    const double width = 2.0 * std::numbers::pi / count;
    double total = 0.0;
    for (int i = 0; i < count; ++i) {
      const Vec3 x = core_point(a, i * width), dx = core_tangent(a, i * width);
      for (int j = 0; j < count; ++j) {
        const Vec3 d = x - core_point(b, (j + 0.5) * width), dy = core_tangent(b, (j + 0.5) * width);
        total += d.dot(dx.cross(dy)) / std::pow(d.squaredNorm(), 1.5);
      }
    }
    return total * width * width / (4.0 * std::numbers::pi);
  };
  double last = sum(32);
  for (int count = 64; count <= 2048; count *= 2) {
    const double now = sum(count);
    if (std::abs(now - last) < 0.05 && std::abs(now - std::round(now)) < 0.05)
      return static_cast<int>(std::lround(now));
    last = now;
  }
  throw Malformed(
      fmt::format("{} and {}: their cores are so near to each other that their linking number is not decided",
                  a.name, b.name));
}

/// Corners on a core, evenly.
std::vector<Vec3> core_polygon(const Primitive& torus, int count, double shift = 0.0)
{
  std::vector<Vec3> out;
  for (int i = 0; i < count; ++i)
    out.push_back(core_point(torus, 2.0 * std::numbers::pi * (i + shift) / count));
  return out;
}

/// How many keep to the tube: the middles of a circle's chords are R h^2/8 from it.
int corners_of(const Primitive& torus)
{
  return std::max(16, static_cast<int>(4.5 * std::sqrt(core_bend(torus) / std::min(torus.r0, torus.r1))));
}

/// Loops that generate what can be linked with a mesh or a solid, or a torus beside one.
std::vector<std::vector<Vec3>> loops_of(const Primitive& torus)
{
  std::vector<std::vector<Vec3>> out;
  if (torus.solid) {
    for (std::vector<Vec3>& core : torus.solid->cores()) {
      for (Vec3& x : core) x = torus.place.position + torus.place.rotation * x;
      out.push_back(std::move(core));
    }
    return out;
  }
  if (!torus.surface) {
    // Through the middles of the mesh's sections: what lies between two of them is inside of it.
    out.push_back(torus.facets > 0 ? core_polygon(torus, torus.facets, 0.5)
                                   : core_polygon(torus, corners_of(torus)));
    return out;
  }
  for (const std::vector<int>& loop : torus.surface->loops) {
    std::vector<Vec3>& corners = out.emplace_back();
    corners.reserve(loop.size());
    for (const int k : loop)
      corners.emplace_back(torus.place.position +
                           torus.place.rotation * (torus.R * torus.surface->points[k]));
  }
  return out;
}

Vec3 in_space(const Place& place, const Vec3& x) { return place.position + place.rotation * x; }

/// Polygons of all cycles of an element that has a place: of each primitive those of its core, or of its
/// surface's loops, then the loops of several. With the number that a link gives each.
std::vector<std::pair<int, std::vector<Vec3>>> cycles(const Element& element, const Place& place)
{
  std::vector<std::pair<int, std::vector<Vec3>>> out;
  int k = 0;
  for (const Primitive& torus : element.tori) {
    if (torus.surface || torus.solid) {
      for (std::vector<Vec3>& loop : loops_of(placed(torus, place))) out.emplace_back(k, std::move(loop));
    } else {
      out.emplace_back(k, core_polygon(placed(torus, place), corners_of(torus)));
    }
    ++k;
  }
  for (const Loop& loop : element.loops) {
    std::vector<Vec3>& corners = out.emplace_back(k++, std::vector<Vec3>()).second;
    for (const Vec3& x : loop.corners) corners.push_back(in_space(place, x));
  }
  return out;
}

/// Links in which at least one side is a loop of several primitives.
void add_loops(std::vector<Link>& out, const Neighbour& pair, const Element& first, const Place& place,
               const Element& second, const Place& image)
{
  if (first.loops.empty() && second.loops.empty()) return;
  const auto a = cycles(first, place), b = cycles(second, image);
  for (const auto& [p, x] : a)
    for (const auto& [q, y] : b) {
      if (p < static_cast<int>(first.tori.size()) && q < static_cast<int>(second.tori.size())) continue;
      const std::optional<int> number = crossing_number(x, y);
      if (!number)
        throw Malformed(
            fmt::format("elements {} and {}: a linking number is not decided", pair.first, pair.second));
      if (*number == 0) continue;
      // Of a surface's loops each counts, whatever its sign.
      Link link{{pair.first, pair.second}, {p, q}, pair.image, *number};
      if (!out.empty() && same_pair(out.back(), link)) {
        out.back().number = std::gcd(out.back().number, *number);
      } else {
        out.push_back(link);
      }
    }
}

int polygon_number(const Primitive& a, const Primitive& b)
{
  int divisor = 0;
  const auto first = loops_of(a), second = loops_of(b);
  for (const auto& p : first)
    for (const auto& q : second) {
      const std::optional<int> number = crossing_number(p, q);
      if (!number)
        throw Malformed(fmt::format("{} and {}: their linking number is not decided", a.name, b.name));
      divisor = std::gcd(divisor, *number);
    }
  return divisor;
}

}  // namespace

int linking_number(const Primitive& a, const Primitive& b)
{
  if (a.surface || b.surface || a.solid || b.solid) return polygon_number(a, b);
  if (!a.curve.empty() || !b.curve.empty()) return gauss_number(a, b);
  // Height of b's circle above a's plane: alpha cos u + beta sin u + gamma.
  const Vec3 n = a.place.rotation.col(2);
  const double alpha = b.R * n.dot(b.place.rotation.col(0)), beta = b.R * n.dot(b.place.rotation.col(1));
  const double gamma = n.dot(b.place.position - a.place.position);
  const double amplitude = std::hypot(alpha, beta);
  if (amplitude <= std::abs(gamma)) return 0;
  const double middle = std::atan2(beta, alpha), half = std::acos(-gamma / amplitude);
  int sum = 0;
  // The height rises through zero at middle - half and falls through it at middle + half.
  for (const int direction : {1, -1}) {
    const Vec3 crossing = core_point(b, middle - direction * half);
    if ((crossing - a.place.position).norm() < a.R) sum += direction;
  }
  return sum;
}

std::vector<Link> links(const Scene& scene, const std::vector<Place>& places, const Mat3& F)
{
  std::vector<Link> out;
  for (const Neighbour& pair : neighbours(scene, places, F, 0.0)) {
    const std::size_t k = pair.first, l = pair.second;
    Place image = places[l];
    image.position += translation(scene, F, pair.image);
    const auto &first = scene.elements[k].tori, &second = scene.elements[l].tori;
    for (std::size_t p = 0; p < first.size(); ++p)
      for (std::size_t q = 0; q < second.size(); ++q) {
        const int number = linking_number(placed(first[p], places[k]), placed(second[q], image));
        if (number != 0)
          out.push_back(
              {{pair.first, pair.second}, {static_cast<int>(p), static_cast<int>(q)}, pair.image, number});
      }
    add_loops(out, pair, scene.elements[k], places[k], scene.elements[l], image);
  }
  return out;
}

std::string difference(const std::vector<Link>& rest, const std::vector<Link>& limit)
{
  for (const Link& link : rest)
    if (const int now = number_in(limit, link); now != link.number) return describe(link, link.number, now);
  for (const Link& link : limit)
    if (number_in(rest, link) == 0) return describe(link, 0, link.number);
  return {};
}

}  // namespace hauberk::verification
