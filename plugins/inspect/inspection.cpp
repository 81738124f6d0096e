#include "inspect/inspection.hpp"

#include "geometry/body.hpp"
#include "geometry/facets.hpp"
#include "geometry/separation.hpp"
#include "geometry/thinnest_wall.hpp"
#include "inspect/disjoint_sets.hpp"

#include <hauberk/error.hpp>
#include <hauberk/triangle_surface.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk::inspecting {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Rays through each body to find its thinnest wall; fewer where there are many triangles.
constexpr double most_rays = 200.0, most_tests = 4e8;
/// Part of their sizes below which two bodies touch, and the most pairs whose boxes are looked at.
constexpr double touching = 1e-12;
constexpr std::size_t most_pairs = 5000000;
/// Points of each body that the first bound of a distance is taken from.
constexpr std::size_t most_samples = 200;

std::array<Vec3, 2> box_of(const std::vector<Vec3>& points)
{
  std::array<Vec3, 2> box{points.front(), points.front()};
  for (const Vec3& x : points) {
    box[0] = box[0].cwiseMin(x);
    box[1] = box[1].cwiseMax(x);
  }
  return box;
}

/// Distance of two boxes; negative where they overlap, by the least way apart.
double box_gap(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b)
{
  const Vec3 apart = (b[0] - a[1]).cwiseMax(a[0] - b[1]);
  const double within = apart.maxCoeff();
  return within < 0.0 ? within : apart.cwiseMax(0.0).norm();
}

/// A closed body as the kernel has it, about its own middle so that coordinates keep their digits.
struct ClosedBody {
  Body body;
  std::vector<Vec3> samples;  ///< some of its points
};

ClosedBody closed_body(const Part& part, int number)
{
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : part.points) middle += x / static_cast<double>(part.points.size());
  std::vector<Vec3> points;
  points.reserve(part.points.size());
  for (const Vec3& x : part.points) points.emplace_back(x - middle);
  Primitive primitive;
  primitive.kind = PrimitiveKind::triangle_mesh;
  primitive.position = middle;
  primitive.surface =
      std::make_shared<const TriangleSurface>(std::move(points), part.triangles, most_triangles);
  const TriangleSurface& surface = *primitive.surface;
  const double thick = surface.thickness() * surface.mean_distance();
  primitive.size = {surface.mean_distance(), thick, thick};
  ClosedBody out;
  out.body = make_body(primitive, number, 0, 1.0);
  out.body.facets = std::make_shared<const Facets>(surface, out.body.R);
  const std::size_t stride = part.points.size() / most_samples + 1;
  for (std::size_t k = 0; k < part.points.size(); k += stride) out.samples.push_back(part.points[k]);
  return out;
}

double signed_volume(const Part& part, const Vec3& about)
{
  double six = 0.0;
  for (const auto& t : part.triangles)
    six += (part.points[t[0]] - about).dot((part.points[t[1]] - about).cross(part.points[t[2]] - about));
  return six / 6.0;
}

/// Distance of two closed bodies that do not meet, as far as it is below `range`.
double distance_of(const ClosedBody& a, const ClosedBody& b, double range)
{
  double least = range;
  for (const Vec3& x : a.samples)
    for (const Vec3& y : b.samples) least = std::min(least, (x - y).norm());
  const PairFrame frame(a.body, Pose{}, b.body, Pose{});
  double found = infinite;
  near_features(frame, least * (1.0 + 1e-12),
                [&](const FeaturePair& pair, const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& f) {
                  found = std::min(found, nearest_features(pair, p, f).distance);
                });
  return std::min(found, least);
}

/// Two bodies, and how far their boxes are apart.
struct Candidate {
  double apart = 0.0;
  std::array<int, 2> bodies{};

  bool operator<(const Candidate& other) const
  {
    return std::tie(apart, bodies) < std::tie(other.apart, other.bodies);
  }
};

/// Pairs whose boxes are from `from` up to `reach` apart, the nearest first. `order`: bodies by their lowest
/// x.
std::vector<Candidate> pairs_between(const std::vector<InspectedBody>& bodies, const std::vector<int>& order,
                                     double from, double reach)
{
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& box = bodies[order[i]].box;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const auto& other = bodies[order[j]].box;
      if (other[0].x() - box[1].x() >= reach) break;
      const double apart = box_gap(box, other);
      if (apart >= from && apart < reach)
        out.push_back({apart, {std::min(order[i], order[j]), std::max(order[i], order[j])}});
      if (out.size() > most_pairs)
        throw InputError(fmt::format(
            "more than {} pairs of bodies are near each other; give a part of the model", most_pairs));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Looks at one pair: how near, whether within each other, whether linked.
void look_at_pair(const Candidate& candidate, const std::vector<std::optional<ClosedBody>>& solids,
                  double gap, Inspection& out)
{
  const ClosedBody &a = *solids[candidate.bodies[0]], &b = *solids[candidate.bodies[1]];
  NearBodies pair{candidate.bodies, 0.0};
  const PairFrame frame(a.body, Pose{}, b.body, Pose{});
  const bool boxes_meet = candidate.apart < 0.0;
  bool meet = boxes_meet && facets_intersect(frame);
  if (!meet && boxes_meet && facets_inside(frame)) {
    out.within.push_back(candidate.bodies);
    for (const int k : candidate.bodies) {
      if (!out.bodies[k].inside_out) continue;
      out.bodies[k].hollow = true;  // what is between the two is wall, no gap
      return;
    }
  }
  const double least = out.nearest ? out.nearest->distance : infinite;
  if (!meet) pair.distance = distance_of(a, b, std::max(gap, least));
  // Where they touch, rounding decides what is left.
  meet = meet || pair.distance <= touching * (a.body.bound + b.body.bound);
  if (meet) pair.distance = 0.0;
  if (pair.distance < least) out.nearest = pair;
  if (meet || pair.distance < gap) out.too_near.push_back(pair);
  if (meet || !boxes_meet) return;
  const int number = linking_number(a.body, Pose{}, b.body, Pose{});
  if (number != 0) out.links.push_back({candidate.bodies, std::abs(number)});
}

void look_at_pairs(const std::vector<std::optional<ClosedBody>>& solids, double gap,
                   const std::function<void()>& keep_going, Inspection& out)
{
  std::vector<int> order;
  std::array<Vec3, 2> all{Vec3::Constant(infinite), Vec3::Constant(-infinite)};
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (!solids[k]) continue;
    order.push_back(static_cast<int>(k));
    all[0] = all[0].cwiseMin(out.bodies[k].box[0]);
    all[1] = all[1].cwiseMax(out.bodies[k].box[1]);
  }
  if (order.size() < 2) return;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(out.bodies[a].box[0].x(), a) < std::pair(out.bodies[b].box[0].x(), b);
  });
  // Pairs whose boxes overlap, and those within the gap, all of them; then outwards until boxes are farther
  // apart than the nearest bodies are.
  const double across = (all[1] - all[0]).norm();
  double from = -infinite, reach = std::max(gap, 1e-3 * across);
  while (from <= across) {
    for (const Candidate& candidate : pairs_between(out.bodies, order, from, reach)) {
      const double least = out.nearest ? out.nearest->distance : infinite;
      if (candidate.apart > std::max({gap, least, 0.0})) break;
      keep_going();
      look_at_pair(candidate, solids, gap, out);
    }
    if (out.nearest && out.nearest->distance <= reach) break;
    from = reach;
    reach = out.nearest ? out.nearest->distance : 2.0 * reach;
  }
  std::sort(out.too_near.begin(), out.too_near.end(), [](const NearBodies& a, const NearBodies& b) {
    return std::tie(a.distance, a.bodies) < std::tie(b.distance, b.bodies);
  });
  std::sort(out.links.begin(), out.links.end(),
            [](const LinkedBodies& a, const LinkedBodies& b) { return a.bodies < b.bodies; });
  std::sort(out.within.begin(), out.within.end());
}

void count_pieces(Inspection& out)
{
  DisjointSets pieces(out.bodies.size());
  for (const LinkedBodies& link : out.links) {
    out.bodies[link.bodies[0]].linked.push_back(link.bodies[1]);
    out.bodies[link.bodies[1]].linked.push_back(link.bodies[0]);
    pieces.join(link.bodies[0], link.bodies[1]);
  }
  for (const auto& [first, second] : out.within) {
    if (out.bodies[first].hollow || out.bodies[second].hollow) pieces.join(first, second);
  }
  std::vector<int> number(out.bodies.size(), -1);
  for (std::size_t k = 0; k < out.bodies.size(); ++k) {
    InspectedBody& body = out.bodies[k];
    if (!body.problem.empty()) continue;
    int& own = number[pieces.root(static_cast<int>(k))];
    if (own < 0) own = out.pieces++;
    body.piece = own;
    std::sort(body.linked.begin(), body.linked.end());
  }
}

/// Bed and overhangs, with z upwards as it lies.
void look_at_printing(const ModelFile& model, Inspection& out)
{
  out.box = {Vec3::Constant(infinite), Vec3::Constant(-infinite)};
  for (const InspectedBody& body : out.bodies)
    out.box = {out.box[0].cwiseMin(body.box[0]), out.box[1].cwiseMax(body.box[1])};
  const double on_bed = out.box[0].z() + 1e-3 * (out.box[1].z() - out.box[0].z());
  double area = 0.0, steep = 0.0;
  for (std::size_t k = 0; k < out.bodies.size(); ++k) {
    const InspectedBody& body = out.bodies[k];
    if (!body.problem.empty()) continue;
    if (body.box[0].z() <= on_bed) ++out.on_bed;
    const Part& part = model.parts[k];
    for (const auto& t : part.triangles) {
      const Vec3 &a = part.points[t[0]], &b = part.points[t[1]], &c = part.points[t[2]];
      const Vec3 twice = (body.inside_out && !body.hollow ? -1.0 : 1.0) * (b - a).cross(c - a);
      area += twice.norm();
      const double highest_corner = std::max({a.z(), b.z(), c.z()});
      if (twice.z() < -std::sqrt(0.5) * twice.norm() && highest_corner > on_bed) steep += twice.norm();
    }
  }
  out.overhang = area > 0.0 ? steep / area : 0.0;
}

}  // namespace

bool Inspection::failed() const
{
  return !too_near.empty() ||
         std::any_of(bodies.begin(), bodies.end(), [](const InspectedBody& b) { return !b.problem.empty(); });
}

Inspection inspect(const ModelFile& model, const std::string& file, double gap,
                   const std::function<void()>& keep_going)
{
  Inspection out;
  out.file = file;
  out.unit = model.unit;
  out.objects = model.objects;
  std::vector<std::optional<ClosedBody>> solids(model.parts.size());
  double squares = 0.0;
  for (const Part& part : model.parts) squares += static_cast<double>(part.triangles.size());
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    keep_going();
    const Part& part = model.parts[k];
    InspectedBody& body = out.bodies.emplace_back();
    body.name = fmt::format("body {}", k + 1);
    if (!part.name.empty()) body.name += fmt::format(" ({})", part.name);
    body.triangles = part.triangles.size();
    body.box = box_of(part.points);
    try {
      solids[k] = closed_body(part, static_cast<int>(k));
    } catch (const InputError& error) {
      body.problem = error.what();
      try {  // the same with the places that the file has
        const TriangleSurface as_it_lies(part.points, part.triangles, most_triangles);
      } catch (const InputError& placed) {
        body.problem = placed.what();
      }
      continue;
    }
    const double volume = signed_volume(part, part.points.front());
    body.inside_out = volume < 0.0;
    body.volume = std::abs(volume);
    body.handles = solids[k]->body.surface->loops().size() / 2;
    const double rays = std::min(most_rays, most_tests / squares);
    body.thinnest_wall = thinnest_wall(part.points, part.triangles,
                                       static_cast<std::size_t>(std::max(1.0, rays)), body.inside_out);
  }
  look_at_pairs(solids, gap, keep_going, out);
  count_pieces(out);
  out.linked_apart = std::any_of(out.links.begin(), out.links.end(), [&](const LinkedBodies& link) {
    return model.parts[link.bodies[0]].object != model.parts[link.bodies[1]].object;
  });
  look_at_printing(model, out);
  return out;
}

}  // namespace hauberk::inspecting
