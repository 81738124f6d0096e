#include "contact/contact_zones.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Part of a pair's force below which a zone is none: stray nodes at the rim of the range, beyond the width
/// of the zone that bears the load.
constexpr double negligible_zone = 1e-9;

}  // namespace

ContactPoint zone_node(const ProbePoint& q, const FieldValue& f, double gap, double clearance, double force)
{
  ContactPoint c;
  c.normal = f.n;
  c.on_f = q.on_p - f.m.phi * f.n;
  c.on_p = c.on_f + (gap + clearance) * f.n;
  c.gap = gap;
  c.force = force;
  return c;
}

void add_contact_zones(const PairFrame& frame, double g_hat, double clearance,
                       std::vector<ContactPoint> nodes, std::vector<ContactPoint>& out)
{
  std::stable_sort(nodes.begin(), nodes.end(),
                   [](const ContactPoint& a, const ContactPoint& b) { return a.force > b.force; });
  struct Zone {
    ContactPoint seed;
    Vec3 force = Vec3::Zero(), on_p = Vec3::Zero(), on_f = Vec3::Zero();
    double weight = 0.0;
  };
  std::vector<Zone> zones;
  const double width = 4.0 * std::sqrt(2.0 * (frame.P->R) * g_hat);
  for (const ContactPoint& c : nodes) {
    Zone* home = nullptr;
    for (Zone& z : zones) {
      const Vec3 along_f = c.on_f - z.seed.on_f, along_p = c.on_p - z.seed.on_p;
      const double bow = std::max(std::abs(along_f.dot(z.seed.normal)), std::abs(along_p.dot(z.seed.normal)));
      if (along_f.norm() < width && bow < g_hat && z.seed.normal.dot(c.normal) > 0.0) {
        home = &z;
        break;
      }
    }
    if (home == nullptr) {
      zones.push_back({c});
      home = &zones.back();
    }
    home->force += c.force * c.normal;
    home->on_p += c.force * c.on_p;
    home->on_f += c.force * c.on_f;
    home->weight += c.force;
    home->seed.gap = std::min(home->seed.gap, c.gap);
  }
  double total = 0.0;
  for (const Zone& z : zones) total += z.weight;
  for (const Zone& z : zones) {
    if (z.weight <= negligible_zone * total) continue;
    ContactPoint c = z.seed;
    c.force = z.force.norm();
    c.normal = z.force / c.force;
    // Mean points lie inside where the zone bows; along its line of action a force may be moved. The field
    // of a curve is not known.
    c.on_f = z.on_f / z.weight;
    if (frame.difference == nullptr) c.on_f -= field_at(*frame.F, c.on_f).m.phi * c.normal;
    c.on_p = c.on_f + (c.gap + clearance) * c.normal;
    out.push_back(c);
  }
}

}  // namespace hauberk
