/// The rules of the shapes that come with the program, written down a second time.
#include "layout.hpp"
#include "read.hpp"

#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

namespace hauberk::verification {
namespace {

namespace json = boost::json;
using Parameters = std::map<std::string, double>;

double value_of(const Parameters& parameters, const std::string& name, const std::string& where)
{
  const auto found = parameters.find(name);
  if (found == parameters.end()) throw Malformed(where + "/parameters/" + name + ": missing");
  return found->second;
}

Vec3 vector_of(const json::value& v, const std::string& where)
{
  const json::array& a = array(v, where);
  if (a.size() != 3) throw Malformed(where + ": three numbers expected");
  return {number(a[0], where), number(a[1], where), number(a[2], where)};
}

/// A position is [x, y, z], or a direction in the plane with a sum of lengths and parameters along it.
Vec3 position_of(const json::value* v, const Parameters& parameters, Vec3& along, const std::string& where)
{
  if (v == nullptr) return Vec3::Zero();
  if (v->is_array()) return vector_of(*v, where);
  const double angle =
      number(member(*v, "direction_deg", where), where + "/direction_deg") * std::numbers::pi / 180.0;
  along = Vec3(std::cos(angle), std::sin(angle), 0.0);
  double distance = 0.0;
  for (const json::value& term : array(member(*v, "distance", where), where + "/distance"))
    distance += term.is_string() ? value_of(parameters, text(term, where), where) : number(term, where);
  return distance * along;
}

std::vector<Primitive> torus_union(const json::value& section, const Parameters& parameters,
                                   const std::string& where)
{
  std::vector<Primitive> out;
  for (const json::value& item : array(member(section, "tori", where), where + "/tori")) {
    const std::string at = where + "/tori/" + std::to_string(out.size());
    const json::object& torus = item.as_object();
    Primitive t;
    t.name = text(member(item, "name", at), at + "/name");
    const json::value* group = torus.if_contains("group");
    const std::string prefix = group != nullptr ? text(*group, at + "/group") : t.name;
    t.R = value_of(parameters, prefix + ".R", where);
    t.r0 = value_of(parameters, prefix + ".r0", where);
    t.r1 = value_of(parameters, prefix + ".r1", where);
    Vec3 along = Vec3::UnitX(), axis = Vec3::UnitZ();
    t.place.position = position_of(torus.if_contains("position"), parameters, along, at + "/position");
    if (const json::value* given = torus.if_contains("axis"))
      axis = given->is_string() && text(*given, at + "/axis") == "tangential"
                 ? Vec3::UnitZ().cross(along)
                 : vector_of(*given, at + "/axis");
    // A turn about its own axis is none of a torus.
    t.place.rotation = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
    out.push_back(std::move(t));
  }
  return out;
}

/// Coefficients of a core by harmonic, (cosine, sine) of x, y, z.
class Core {
 public:
  void cosine(int k, int axis, double weight) { term(k, 0)[axis] += weight; }
  void sine(int k, int axis, double weight) { term(k, 1)[axis] += weight; }
  std::vector<std::array<Vec3, 2>> curve;

 private:
  Vec3& term(int k, std::size_t which)
  {
    const std::size_t n = k;
    while (curve.size() < n) curve.push_back({Vec3::Zero(), Vec3::Zero()});
    return curve[n - 1][which];
  }
};

double setting(const json::value& section, const char* key, double otherwise, const std::string& where)
{
  return optional_number(section, key, where).value_or(otherwise);
}

/// ((R + a cos q u) cos p u, (R + a cos q u) sin p u, b sin q u) by cos q u cos p u = (cos (q + p) u + cos (q
/// - p) u)/2.
void knot(Core& core, int p, int q, double R, double a, double b)
{
  core.cosine(p, 0, R);
  core.sine(p, 1, R);
  core.cosine(q + p, 0, 0.5 * a);
  core.cosine(std::abs(q - p), 0, 0.5 * a);
  core.sine(q + p, 1, 0.5 * a);
  core.sine(std::abs(q - p), 1, q > p ? -0.5 * a : 0.5 * a);
  core.sine(q, 2, b);
}

Primitive closed_tube(const json::value& section, const Parameters& parameters, const std::string& where)
{
  const std::string family = text(member(section, "curve", where), where + "/curve");
  const auto p = [&](const std::string& name) { return value_of(parameters, name, where); };
  Core core;
  if (family == "oval") {
    core.cosine(1, 0, p("half_length"));
    core.sine(1, 1, p("half_width"));
  } else if (family == "racetrack") {
    core.cosine(1, 0, p("half_length"));
    core.sine(1, 1, 9.0 / 8.0 * p("half_width"));
    core.sine(3, 1, 1.0 / 8.0 * p("half_width"));
  } else if (family == "polygon") {
    const int n = static_cast<int>(setting(section, "corners", 3.0, where));
    core.cosine(1, 0, p("R"));
    core.sine(1, 1, p("R"));
    core.cosine(n - 1, 0, p("corner"));
    core.sine(n - 1, 1, -p("corner"));
  } else if (family == "knot") {
    const json::value* turns = section.as_object().if_contains("turns");
    const auto turn = [&](std::size_t k, int otherwise) {
      return turns == nullptr ? otherwise : static_cast<int>(number(array(*turns, where).at(k), where));
    };
    knot(core, turn(0, 2), turn(1, 3), p("R"), p("a"), p("b"));
  } else if (family == "fourier") {
    const int harmonics = static_cast<int>(setting(section, "harmonics", 3.0, where));
    for (int k = 1; k <= harmonics; ++k)
      for (int axis = 0; axis < 3; ++axis) {
        const std::string at = std::to_string(k) + "." + "xyz"[axis];
        core.cosine(k, axis, p("c" + at));
        core.sine(k, axis, p("s" + at));
      }
  } else {
    throw Malformed(where + "/curve: \"" + family + "\" is not known to this check");
  }
  Primitive out;
  out.name = "tube";
  out.r0 = out.r1 = p("r");
  double squares = 0.0;
  for (const auto& [c, s] : core.curve) squares += c.squaredNorm() + s.squaredNorm();
  out.R = std::sqrt(0.5 * squares);
  out.curve = std::move(core.curve);
  return out;
}

/// The parameters of one part of a union, without its name.
Parameters of_part(const Parameters& parameters, const std::string& name)
{
  Parameters own;
  for (const auto& [key, value] : parameters)
    if (key.starts_with(name + ".")) own[key.substr(name.size() + 1)] = value;
  return own;
}

/// Where a part is: x, y and z of its parameters, else its `position`; its `rotation`, and then a turn by the
/// vector of rx, ry and rz, in degrees.
Place place_of(const json::object& part, const Parameters& own, const std::string& where)
{
  Place out;
  out.rotation = read_turn(part.if_contains("rotation"), where + "/rotation");
  if (const json::value* position = part.if_contains("position"))
    out.position = vector_of(*position, where + "/position");
  Vec3 turn = Vec3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    if (const auto given = own.find(axis); given != own.end()) out.position[i] = given->second;
    if (const auto given = own.find("r" + axis); given != own.end())
      turn[i] = given->second * std::numbers::pi / 180.0;
  }
  if (turn != Vec3::Zero())
    out.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * out.rotation;
  return out;
}

/// Those of all parts, moved as a whole; nothing where one of them has a shape that is not known here.
std::optional<std::vector<Primitive>> rigid_union(const json::value& section, const Parameters& parameters,
                                                  const std::string& where)
{
  std::vector<Primitive> out;
  int number = 0;
  for (const json::value& item : array(member(section, "parts", where), where + "/parts")) {
    const std::string at = where + "/parts/" + std::to_string(number++);
    const std::string name = text(member(item, "name", at), at + "/name");
    const Parameters own = of_part(parameters, name);
    const auto made = primitives_of(name, item, own, at, {});
    if (!made) return std::nullopt;
    const Place place = place_of(item.as_object(), own, at);
    for (Primitive primitive : *made) {
      primitive.name = name + "." + primitive.name;
      primitive.place.position = place.position + place.rotation * primitive.place.position;
      primitive.place.rotation = place.rotation * primitive.place.rotation;
      out.push_back(std::move(primitive));
    }
  }
  return out;
}

Primitive from_plugin(const hauberk::Primitive& made)
{
  Primitive out;
  out.name = made.name;
  out.place = {made.position, made.rotation};
  if (made.solid) {
    enter_solid(out, made.solid);
    out.solid_kind = made.solid->kind();
    const std::vector<std::string> names = made.solid->size_names();
    for (std::size_t k = 0; k < names.size(); ++k) out.sizes[names[k]] = made.solid->sizes().at(k);
    return out;
  }
  out.R = made.R();
  out.r0 = made.r0();
  out.r1 = made.r1();
  for (const Harmonic& h : made.curve) out.curve.push_back({h.c, h.s});
  return out;
}

}  // namespace

void enter_solid(Primitive& into, std::shared_ptr<const Solid> solid)
{
  into.R = solid->radius();
  into.r0 = into.r1 = solid->probe_dimension() == 1 ? solid->offset() : solid->thickness();
  into.solid = std::move(solid);
}

std::vector<Primitive> plugin_primitives(const std::string& type, const json::value& section,
                                         const Parameters& parameters, const std::string& where,
                                         const VerifyShapes& shapes)
{
  std::string why = "the surfaces of solids are known to their plugins alone, and none are at hand";
  std::optional<std::vector<hauberk::Primitive>> made;
  try {
    if (shapes) made = shapes(type, section, parameters, why);
  } catch (const std::exception& error) {
    throw Malformed(where + ": " + error.what());
  }
  if (!made) throw Unknown(why);
  std::vector<Primitive> out;
  for (const hauberk::Primitive& p : *made) out.push_back(from_plugin(p));
  return out;
}

std::optional<std::vector<Primitive>> primitives_of(const std::string& type, const json::value& section,
                                                    const Parameters& parameters, const std::string& where,
                                                    const VerifyShapes& shapes)
{
  const std::string shape = text(member(section, "shape", where), where + "/shape");
  if (shape == "torus_union") return torus_union(section, parameters, where);
  if (shape == "closed_tube") return std::vector<Primitive>{closed_tube(section, parameters, where)};
  if (shape == "union")
    if (auto made = rigid_union(section, parameters, where)) return made;
  if (shape == "mesh" || !shapes) return std::nullopt;
  try {
    std::vector<Primitive> made = plugin_primitives(type, section, parameters, where, shapes);
    if (std::any_of(made.begin(), made.end(), [](const Primitive& p) { return p.solid != nullptr; }))
      return made;
  } catch (const Unknown&) {  // then nothing is known of the shape
  }
  return std::nullopt;
}

}  // namespace hauberk::verification
