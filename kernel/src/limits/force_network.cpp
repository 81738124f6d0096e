#include "place_index.hpp"

#include <hauberk/limits/force_network.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace hauberk {
namespace {

constexpr int wall = -1;

using Key = std::tuple<int, int, Image>;

Key key_of(const ForceNetwork::Pair& p) { return {p.i, p.j, p.image}; }

/// The same pair seen from its first element: the one of the lower number, or of two images of one element
/// that from which the other's first index that is not 0 is positive.
ForceNetwork::Pair ordered(ForceNetwork::Pair p)
{
  if (p.j == wall || p.i < p.j || (p.i == p.j && p.image > Image{})) return p;
  std::swap(p.i, p.j);
  for (int& k : p.image) k = -k;
  p.force = -p.force;
  return p;
}

/// Pairs summed up and put in order.
std::vector<ForceNetwork::Pair> merged(const std::vector<ForceNetwork::Pair>& list)
{
  std::map<Key, ForceNetwork::Pair> sums;
  for (const ForceNetwork::Pair& given : list) {
    const ForceNetwork::Pair p = ordered(given);
    const auto [at, added] = sums.try_emplace(key_of(p), p);
    if (!added) at->second.force += p.force;
  }
  std::vector<ForceNetwork::Pair> out;
  out.reserve(sums.size());
  for (const auto& [key, p] : sums) out.push_back(p);
  return out;
}

double largest_force(const ForceNetwork& network)
{
  double most = 0.0;
  for (const ForceNetwork::Pair& p : network.pairs) most = std::max(most, p.force.norm());
  return most;
}

double macro_distance(const Model& m, const Vector& a, const Vector& b)
{
  Vector metric = Vector::Zero(a.size());
  m.load->metric({metric.data(), static_cast<std::size_t>(metric.size())});
  return std::sqrt((a - b).cwiseAbs2().dot(metric));
}

bool same_forces(const ForceNetwork& a, const ForceNetwork& b, double tolerance)
{
  auto p = a.pairs.begin(), q = b.pairs.begin();
  while (p != a.pairs.end() || q != b.pairs.end()) {
    const bool first = q == b.pairs.end() || (p != a.pairs.end() && key_of(*p) <= key_of(*q));
    const bool second = p == a.pairs.end() || (q != b.pairs.end() && key_of(*q) <= key_of(*p));
    Vec3 difference = Vec3::Zero();
    if (first) difference += (p++)->force;
    if (second) difference -= (q++)->force;
    if (!(difference.norm() <= tolerance)) return false;
  }
  return true;
}

}  // namespace

ForceNetwork force_network(const Model& m, const State& s, std::span<const ContactEnergy::Point> contacts,
                           double mu)
{
  std::vector<ForceNetwork::Pair> pairs;
  for (const ContactEnergy::Point& c : contacts) {
    ForceNetwork::Pair p;
    if (c.wall >= 0) {
      p.i = c.a;
      p.j = wall;
    } else {
      p.i = m.bodies[static_cast<std::size_t>(c.a)].element;
      p.j = m.bodies[static_cast<std::size_t>(c.b)].element;
      p.image = c.image;
    }
    p.force = mu * c.contact.force * c.contact.normal;
    pairs.push_back(p);
  }
  return {s.macro, merged(pairs)};
}

std::optional<ForceNetwork> transformed(const Model& m, const SceneSymmetry& g, const ForceNetwork& network)
{
  const auto count = static_cast<std::size_t>(network.macro.size());
  ForceNetwork out;
  out.macro = Vector::Zero(network.macro.size());
  if (!m.load->transform(g.O, {network.macro.data(), count}, {out.macro.data(), count})) return std::nullopt;
  const LatticeCoordinates lattice(m);
  std::vector<ForceNetwork::Pair> pairs;
  for (ForceNetwork::Pair p : network.pairs) {
    p.force = g.O * p.force;
    const auto i = static_cast<std::size_t>(p.i);
    if (p.j != wall) {
      // i goes to image T_i of to[i], j of image T to image O T + T_j of to[j].
      const auto j = static_cast<std::size_t>(p.j);
      const Image turned = lattice.nearest(g.O * m.translation(p.image));
      for (std::size_t k = 0; k < turned.size(); ++k) p.image[k] = turned[k] + g.image[j][k] - g.image[i][k];
      p.j = g.to[j];
    }
    p.i = g.to[i];
    pairs.push_back(p);
  }
  out.pairs = merged(pairs);
  return out;
}

std::vector<int> rattlers(const Model& m, const ForceNetwork& network, double part)
{
  const double least = part * largest_force(network);
  std::vector<bool> carries(m.rest.size(), false);
  for (const ForceNetwork::Pair& p : network.pairs) {
    if (!(p.force.norm() > least)) continue;
    carries[static_cast<std::size_t>(p.i)] = true;
    if (p.j != wall) carries[static_cast<std::size_t>(p.j)] = true;
  }
  std::vector<int> out;
  for (int k = 0; k < m.element_count(); ++k) {
    if (!carries[static_cast<std::size_t>(k)]) out.push_back(k);
  }
  return out;
}

bool same_fabric_state(const Model& m, std::span<const SceneSymmetry> symmetries, const ForceNetwork& a,
                       const ForceNetwork& b, const SameFabric& tolerance)
{
  const double force = tolerance.force * std::max(largest_force(a), largest_force(b));
  return std::any_of(symmetries.begin(), symmetries.end(), [&](const SceneSymmetry& g) {
    const std::optional<ForceNetwork> image = transformed(m, g, a);
    return image && macro_distance(m, image->macro, b.macro) <= tolerance.macro &&
           same_forces(*image, b, force);
  });
}

}  // namespace hauberk
