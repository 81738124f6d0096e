#include "balance.hpp"
#include "checks.hpp"
#include "layout.hpp"
#include "moving.hpp"
#include "neighbours.hpp"
#include "read.hpp"
#include "surface.hpp"
#include "touching.hpp"

#include <fmt/format.h>
#include <Eigen/QR>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <limits>

/// A locked state is a maximum of s value under gaps g >= 0, with the forces as multipliers. Where these are
/// unique, the envelope theorem gives s d value/dp = sum f dg/dp at a fixed state: of the clearance dg/dp =
/// -1.

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// Contacts with less than this share of the largest force neither make forces ambiguous nor count for
/// differences.
constexpr double carries = 1e-9;
/// Smallest singular value of normalised gradients, over the largest, at which forces count as unique.
constexpr double independent = 1e-6;
/// Relative step of differences, and what they are good to: closest points make errors of second order.
constexpr double step = 1e-5, difference_error = 1e-6;

const char* const ambiguous = "sensitivities where forces are not unique";

bool unique_forces(const Scene& scene, const Setting& setting, const Limit& limit)
{
  const MovedState state{*limit.macro, limit.poses};
  const Matrix fixed = held(scene, setting);
  double largest = 0.0;
  for (const Contact& contact : limit.contacts) largest = std::max(largest, contact.force);
  Matrix rows(unknowns(scene), 0);
  for (const Contact& contact : limit.contacts) {
    if (contact.force <= carries * largest) continue;
    const Vector gradient = free_part(fixed, row_of(scene, setting, state, contact).gradient);
    rows.conservativeResize(Eigen::NoChange, rows.cols() + 1);
    rows.rightCols<1>() = gradient / gradient.norm();
  }
  if (rows.cols() == 0) return false;
  Eigen::ColPivHouseholderQR<Matrix> qr(rows);
  qr.setThreshold(independent);
  return qr.rank() == rows.cols();
}

/// The length power of the value, applied: forces are those of an energy without unit.
double unit_of_value(const Scene& scene, const Limit& limit)
{
  return is_bent(limit.load) ? 1.0 / scene.length : 1.0;
}

/// The distance of one pair of primitives when one element has other tori.
double distance_with(const Scene& scene, const Limit& limit, const Contact& contact, std::size_t element,
                     const std::vector<Primitive>& tori)
{
  std::array<Primitive, 2> pair;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t k = contact.elements[side];
    Place place = limit.poses[k];
    if (side == 1) place.position += translation(scene, limit.macro->deformation(), contact.image);
    const std::size_t p = contact.primitives[side];
    pair[side] = placed(k == element ? tori.at(p) : scene.elements[k].tori.at(p), place);
  }
  return touching_near(pair[0], pair[1], 0.5 * (contact.points[0] + contact.points[1])).distance;
}

/// sum f dg/dp over the contacts of an element; nothing where its shape is not known.
std::optional<double> parameter_sum(const Scene& scene, const Limit& limit, const json::value& section,
                                    const std::string& type, std::map<std::string, double> parameters,
                                    std::size_t element, const std::string& name, const VerifyShapes& shapes)
{
  const double at = parameters.at(name);
  // Changes stay small beside every tube: closest points move as far as sizes do over the tube's radius.
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Element& e : scene.elements)
    for (const Primitive& t : e.tori) thinnest = std::min({thinnest, t.r0, t.r1});
  const double h = std::min(step * std::max(std::abs(at), 1e-3 * scene.length), 1e-3 * thinnest);
  std::array<std::vector<Primitive>, 2> tori;
  for (std::size_t way = 0; way < 2; ++way) {
    parameters[name] = at + (way == 0 ? h : -h);
    auto made = primitives_of(type, section, parameters, "/experiment/elements/" + type, shapes);
    if (!made) return std::nullopt;
    tori[way] = std::move(*made);
  }
  double sum = 0.0;
  for (const Contact& contact : limit.contacts) {
    const auto k = static_cast<int>(element);
    if (!contact.wall.empty() || (contact.elements[0] != k && contact.elements[1] != k)) continue;
    sum += contact.force *
           (distance_with(scene, limit, contact, element, tori[0]) -
            distance_with(scene, limit, contact, element, tori[1])) /
           (2.0 * h);
  }
  return sum;
}

struct Names {
  std::size_t element = 0;
  std::string parameter;
};

/// "3/ring.R".
std::optional<Names> parsed(const std::string& name, std::size_t elements)
{
  const auto slash = name.find('/');
  if (slash == 0 || slash == std::string::npos || slash > 9) return std::nullopt;
  if (name.find_first_not_of("0123456789") != slash) return std::nullopt;
  const std::size_t k = std::stoul(name.substr(0, slash));
  if (k >= elements) return std::nullopt;
  return Names{k, name.substr(slash + 1)};
}

}  // namespace

void check_sensitivity(const Scene& scene, const Setting& setting, const Limit& limit,
                       const json::value& sensitivity, const json::value& experiment,
                       const std::string& where, const VerifyShapes& shapes, Sentences& problems,
                       Record& record)
{
  const bool points = limit.contact == "nearest" || limit.contact == "constrained";
  if (limit.kink) return record.skip(where, ambiguous);
  if (limit.status != "locked" || !points || setting.facets > 0 || limit.finite_target)
    return record.skip(where, "sensitivities of states that are not held at points by a constant load");
  if (!unique_forces(scene, setting, limit)) return record.skip(where, ambiguous);
  const double sign = is_positive(limit) ? 1.0 : -1.0, unit = unit_of_value(scene, limit);
  double forces = 0.0, all = 0.0;
  for (const Contact& contact : limit.contacts) {
    all += contact.force;
    if (contact.wall.empty()) forces += contact.force;
  }
  const std::size_t before = problems.size();
  const auto clearance = optional_number(sensitivity, "clearance", where);
  if (!clearance || !(std::abs(*clearance + sign * unit * forces) <= difference_error * unit * all))
    problems.push_back(fmt::format("sensitivity/clearance {} reported, {:.10g} from the forces",
                                   show(clearance), -sign * unit * forces));
  const json::value& parameters = member(sensitivity, "parameters", where);
  const auto laid = laid_out(experiment);
  const bool comparable = laid && laid->elements.size() == scene.elements.size() && parameters.is_object();
  if (!comparable)
    record.skip(where + "/parameters", "sensitivities to parameters whose shapes are not known here");
  for (const auto& [key, value] : comparable ? parameters.as_object() : json::object{}) {
    const std::string name(key);
    const auto names = parsed(name, scene.elements.size());
    if (!names || !scene.elements[names->element].parameters.contains(names->parameter)) {
      problems.push_back("sensitivity/parameters: there is no " + name);
      continue;
    }
    const std::string& type = laid->elements[names->element].type;
    const auto found = parameter_sum(
        scene, limit, member(member(experiment, "elements", "/experiment"), type.c_str(), ""), type,
        scene.elements[names->element].parameters, names->element, names->parameter, shapes);
    if (!found) {
      record.skip(where + "/parameters", "sensitivities to parameters whose shapes are not known here");
      break;
    }
    const double reported = number(value, where + "/parameters/" + name);
    if (!(std::abs(reported - sign * unit * *found) <= 10.0 * difference_error * unit * all))
      problems.push_back(
          fmt::format("sensitivity to {}: {:.8g} reported, {:.8g} from differences of the gaps", name,
                      reported, sign * unit * *found));
  }
  record.done(VerifyPart::sensitivity, limit.where, problems.size() == before);
}

}  // namespace hauberk::verification
