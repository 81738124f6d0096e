#include "checks.hpp"
#include "facets.hpp"
#include "neighbours.hpp"
#include "surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

/// What one contact may be off by, in units of the quantity.
struct Slack {
  double length, angle;
};

Slack slack(const Scene& scene, const Limit& limit, const Contact& contact,
            const VerifyTolerances& tolerances)
{
  Slack out{tolerances.gap * scene.length, tolerances.normal};
  if (limit.is_of_resultants()) {
    const double gap = std::max(contact.gap, 0.0);
    out.length += tolerances.arc_gaps * gap;
    out.angle += tolerances.arc_gaps * std::sqrt(gap / scene.length);
  }
  return out;
}

bool indices_exist(const Scene& scene, const Contact& contact)
{
  for (std::size_t side = 0; side < 2; ++side) {
    const int k = contact.elements[side], p = contact.primitives[side];
    if (k < 0 || k >= static_cast<int>(scene.elements.size())) return false;
    if (p < 0 || p >= static_cast<int>(scene.elements[k].tori.size())) return false;
  }
  for (std::size_t k = scene.cell.size(); k < contact.image.size(); ++k) {
    if (contact.image[k] != 0) return false;
  }
  return contact.elements[0] != contact.elements[1] || contact.image != Image{};
}

/// Whether the contact is one of another primitive of its element as well.
bool on_another(const Element& element, const Contact& contact, std::size_t side, const Place& place,
                const Slack& slack)
{
  for (std::size_t p = 0; p < element.tori.size(); ++p) {
    if (static_cast<int>(p) == contact.primitives[side]) continue;
    Vec3 outward;
    const double off = signed_distance(placed(element.tori[p], place), contact.points[side], &outward);
    const Vec3 normal = side == 0 ? contact.normal : Vec3(-contact.normal);
    if (std::abs(off) <= slack.length && (normal - outward).norm() <= slack.angle) return true;
  }
  return false;
}

void check_surfaces(const Scene& scene, const Limit& limit, const Contact& contact, const Slack& slack,
                    const std::string& name, const std::string& where, Sentences& problems, Record& record)
{
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t k = contact.elements[side];
    Place place = limit.poses[k];
    if (side == 1) place.position += translation(scene, limit.macro->deformation(), contact.image);
    const Primitive torus = placed(scene.elements[k].tori[contact.primitives[side]], place);
    if (torus.facets > 0) {
      const double off = mesh_distance(torus, contact.points[side]);
      if (off > slack.length)
        problems.push_back(fmt::format("{}: point {} is {:.3g} off its mesh", name, side, off));
      continue;  // meshes have no normals at their edges
    }
    Vec3 outward;
    const double off = signed_distance(torus, contact.points[side], &outward);
    if (std::abs(off) > slack.length)
      problems.push_back(fmt::format("{}: point {} is {:.3g} off its surface", name, side, off));
    const double turned = ((side == 0 ? contact.normal : Vec3(-contact.normal)) - outward).norm();
    if (!(turned <= slack.angle))
      problems.push_back(fmt::format("{}: the normal is {:.3g} off that of surface {}", name, turned, side));
    if (on_another(scene.elements[k], contact, side, place, slack))
      record.skip(fmt::format("{}/primitives/{}", where, side),
                  "primitives of which others have the same surface at the contact");
  }
}

/// False where its element does not exist.
bool check_wall(const Scene& scene, const Setting& setting, const Limit& limit, const Contact& contact,
                double tolerance, const std::string& name, Sentences& problems)
{
  const int k = contact.elements[0];
  if (k < 0 || k >= static_cast<int>(scene.elements.size()) || contact.elements[1] != -1) {
    problems.push_back(name + ": no such element");
    return false;
  }
  double mean = 0.0;
  for (std::size_t e = 0; e < limit.poses.size(); ++e)
    mean += (limit.poses[e].position.z() - scene.elements[e].rest.position.z()) /
            static_cast<double>(limit.poses.size());
  const std::size_t e = k;
  const double height = limit.poses[e].position.z() - scene.elements[e].rest.position.z() - mean;
  const double gap = setting.half_height - contact.normal.z() * height;
  if (contact.normal.head<2>().norm() > 0.0) problems.push_back(name + ": the normal of a wall is along z");
  if (!(std::abs(gap - contact.gap) <= tolerance))
    problems.push_back(fmt::format("{}: gap {:.6g} listed, {:.6g} found", name, contact.gap, gap));
  return true;
}

}  // namespace

bool check_contacts(const Scene& scene, const Setting& setting, const Limit& limit,
                    const VerifyTolerances& tolerances, Sentences& problems, Record& record)
{
  bool all_exist = true;
  for (std::size_t i = 0; i < limit.contacts.size(); ++i) {
    const Contact& contact = limit.contacts[i];
    const std::string name = fmt::format("contact {}", i);
    if (contact.force < 0.0) problems.push_back(fmt::format("{}: pulls with {:.3g}", name, contact.force));
    if (std::abs(contact.normal.norm() - 1.0) > tolerances.gap)
      problems.push_back(fmt::format("{}: the normal's length is {:.12g}", name, contact.normal.norm()));
    if (!contact.wall.empty()) {
      all_exist = check_wall(scene, setting, limit, contact, tolerances.gap * scene.length, name, problems) &&
                  all_exist;
      continue;
    }
    if (!indices_exist(scene, contact)) {
      problems.push_back(name + ": no such elements or primitives");
      all_exist = false;
      continue;
    }
    const Slack allowed = slack(scene, limit, contact, tolerances);
    check_surfaces(scene, limit, contact, allowed, name, fmt::format("{}/contacts/{}", limit.where, i),
                   problems, record);
    const double gap = (contact.points[1] - contact.points[0]).dot(contact.normal) - setting.clearance;
    const Vec3 aside = contact.points[1] - contact.points[0] - (gap + setting.clearance) * contact.normal;
    // Points are written with all digits, whatever surfaces they stand for.
    const double written =
        setting.facets > 0
            ? allowed.length
            : tolerances.written * (scene.length + contact.points[0].norm() + contact.points[1].norm());
    if (!(aside.norm() <= written))
      problems.push_back(fmt::format("{}: its points are {:.3g} off its normal", name, aside.norm()));
    if (!(std::abs(gap - contact.gap) <= written))
      problems.push_back(
          fmt::format("{}: gap {:.6g} listed, {:.6g} between its points", name, contact.gap, gap));
  }
  return all_exist;
}

}  // namespace hauberk::verification
