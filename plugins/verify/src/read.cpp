#include "read.hpp"

#include "layout.hpp"
#include "loops.hpp"
#include "surface.hpp"
#include "together.hpp"

#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// Quaternions of the file are unit to rounding.
constexpr double unit_tolerance = 1e-12;

Vec3 read_vector(const json::value& v, const std::string& where)
{
  const json::array& a = array(v, where);
  if (a.size() != 3) throw Malformed(where + ": three numbers expected");
  return {number(a[0], where + "/0"), number(a[1], where + "/1"), number(a[2], where + "/2")};
}

std::array<int, 2> read_pair(const json::value& v, const std::string& where)
{
  const json::array& a = array(v, where);
  if (a.size() != 2 || !a[0].is_int64() || !a[1].is_int64())
    throw Malformed(where + ": two integers expected");
  return {static_cast<int>(a[0].get_int64()), static_cast<int>(a[1].get_int64())};
}

Place read_place(const json::value& v, const std::string& where)
{
  Place out;
  out.position = read_vector(member(v, "position", where), where + "/position");
  const std::string at = where + "/quaternion";
  const json::array& q = array(member(v, "quaternion", where), at);
  if (q.size() != 4) throw Malformed(at + ": four numbers expected");
  const Eigen::Quaterniond rotation(number(q[0], at + "/0"), number(q[1], at + "/1"), number(q[2], at + "/2"),
                                    number(q[3], at + "/3"));
  if (std::abs(rotation.norm() - 1.0) > unit_tolerance || rotation.w() < 0.0)
    throw Malformed(at + ": not a unit quaternion with w >= 0");
  out.rotation = rotation.normalized().toRotationMatrix();
  return out;
}

std::array<int, 3> read_triangle(const json::value& v, std::size_t points, const std::string& where)
{
  const json::array& a = array(v, where);
  std::array<int, 3> out{};
  if (a.size() != 3) throw Malformed(where + ": three indices expected");
  for (std::size_t k = 0; k < 3; ++k) {
    if (!a[k].is_int64() || a[k].get_int64() < 0 || static_cast<std::size_t>(a[k].get_int64()) >= points)
      throw Malformed(where + ": the index of a point expected");
    out[k] = static_cast<int>(a[k].get_int64());
  }
  return out;
}

/// Points at a mean distance of 1, and triangles that close; their loops are found anew.
Surface read_surface(const json::value& v, const std::string& where)
{
  Surface out;
  for (const json::value& x : array(member(v, "points", where), where + "/points")) {
    out.points.push_back(read_vector(x, where + "/points/" + std::to_string(out.points.size())));
    out.reach = std::max(out.reach, out.points.back().norm());
  }
  for (const json::value& t : array(member(v, "triangles", where), where + "/triangles"))
    out.triangles.push_back(
        read_triangle(t, out.points.size(), where + "/triangles/" + std::to_string(out.triangles.size())));
  double mean = 0.0;
  for (const Vec3& x : out.points) mean += x.norm() / static_cast<double>(out.points.size());
  if (!(std::abs(mean - 1.0) <= unit_tolerance))
    throw Malformed(where + "/points: a mean distance of 1 from the origin expected");
  out.loops = homology_loops(out, where);
  return out;
}

/// Twice the volume over the area.
double thickness(const Surface& surface)
{
  double six = 0.0, twice = 0.0;
  for (const auto& t : surface.triangles) {
    const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    six += a.dot(b.cross(c));
    twice += (b - a).cross(c - a).norm();
  }
  return 2.0 * (six / 6.0) / (0.5 * twice);
}

/// What a primitive of triangles says about its surface.
void read_mesh(const json::value& v, const std::vector<std::shared_ptr<const Surface>>& surfaces,
               Primitive& out, const std::string& where)
{
  const json::value& number = member(v, "surface", where);
  const bool known = number.is_int64() && number.get_int64() >= 0 &&
                     static_cast<std::size_t>(number.get_int64()) < surfaces.size();
  if (!known) throw Malformed(where + "/surface: the index of one of the scene's surfaces expected");
  out.surface = surfaces[number.get_int64()];
  constexpr double rounding = 1e-9;  // of sums over many triangles
  if (!(out.R > 0.0) || out.r0 != out.r1 ||
      !(std::abs(out.r0 - out.R * thickness(*out.surface)) <= rounding * out.R))
    throw Malformed(where + "/parameters: not those of the surface (R > 0, r0 = r1 its thickness)");
}

/// What the file says of a solid: its kind, and its sizes by name.
void read_solid(const json::value& v, Primitive& out, const std::string& where)
{
  out.solid_kind = text(member(v, "solid", where), where + "/solid");
  const std::string at = where + "/parameters";
  const json::value& sizes = member(v, "parameters", where);
  if (!sizes.is_object()) throw Malformed(at + ": an object expected");
  for (const auto& [name, value] : sizes.as_object())
    out.sizes[std::string(name)] = number(value, at + "/" + std::string(name));
}

/// Makes the shapes of elements with solids, equal ones once.
class SolidShapes {
 public:
  explicit SolidShapes(const ShapeSource& source) : source_(source) {}

  /// Gives the solids of an element their surfaces.
  void enter(const std::string& type, Element& element, const std::string& where)
  {
    const auto lacks = [](const Primitive& p) { return !p.solid_kind.empty(); };
    if (std::none_of(element.tori.begin(), element.tori.end(), lacks)) return;
    const std::vector<Primitive>& made = shape(type, element.parameters);
    for (std::size_t p = 0; p < element.tori.size(); ++p) {
      if (!lacks(element.tori[p])) continue;
      if (p >= made.size() || !made[p].solid)
        throw Malformed(where + "/primitives/" + std::to_string(p) + "/kind: its shape makes no solid here");
      enter_solid(element.tori[p], made[p].solid);
    }
  }

 private:
  const std::vector<Primitive>& shape(const std::string& type,
                                      const std::map<std::string, double>& parameters)
  {
    const auto known = made_.find({type, parameters});
    if (known != made_.end()) return known->second;
    const std::string at = source_.where + "/elements";
    const json::value& section =
        member(member(source_.experiment, "elements", source_.where), type.c_str(), at);
    return made_
        .emplace(std::pair(type, parameters),
                 plugin_primitives(type, section, parameters, at + "/" + type, source_.shapes))
        .first->second;
  }

  const ShapeSource& source_;
  std::map<std::pair<std::string, std::map<std::string, double>>, std::vector<Primitive>> made_;
};

Primitive read_torus(const json::value& v, const std::vector<std::shared_ptr<const Surface>>& surfaces,
                     const std::string& where)
{
  Primitive out;
  out.name = text(member(v, "name", where), where + "/name");
  out.place = read_place(v, where);
  const std::string kind = text(member(v, "kind", where), where + "/kind");
  if (kind == "solid") {
    read_solid(v, out, where);
    return out;
  }
  if (kind != "circle_tube" && kind != "revolved_ellipse" && kind != "curve_tube" && kind != "triangle_mesh")
    throw Malformed(
        where + "/kind: circle_tube, revolved_ellipse, curve_tube, triangle_mesh or solid expected, found " +
        kind);
  const std::string at = where + "/parameters";
  const json::value& parameters = member(v, "parameters", where);
  out.R = number(member(parameters, "R", at), at + "/R");
  out.r0 = number(member(parameters, "r0", at), at + "/r0");
  out.r1 = number(member(parameters, "r1", at), at + "/r1");
  if (kind == "triangle_mesh") {
    read_mesh(v, surfaces, out, where);
    return out;
  }
  if (!(out.R > out.r0 && out.r0 > 0.0 && out.r1 > 0.0))
    throw Malformed(at + ": not a torus (R > r0 > 0, r1 > 0)");
  if (kind != "revolved_ellipse" && out.r0 != out.r1) throw Malformed(at + ": a " + kind + " has r0 = r1");
  if (kind == "curve_tube") {
    const std::string place = where + "/curve";
    for (const json::value& term : array(member(v, "curve", where), place)) {
      const std::string of = place + '/' + std::to_string(out.curve.size());
      out.curve.push_back({read_vector(member(term, "cos", of), of + "/cos"),
                           read_vector(member(term, "sin", of), of + "/sin")});
    }
    double squares = 0.0;
    for (const auto& [c, s] : out.curve) squares += c.squaredNorm() + s.squaredNorm();
    if (!(std::abs(out.R - std::sqrt(0.5 * squares)) <= unit_tolerance * out.R))
      throw Malformed(at + "/R: not the mean radius of the curve");
  }
  return out;
}

/// Two numbers for sheets and patches, three for solids.
Image read_image(const json::value& v, const std::string& where)
{
  const json::array& a = array(v, where);
  const auto whole = [](const json::value& x) { return x.is_int64(); };
  if ((a.size() != 2 && a.size() != 3) || !std::all_of(a.begin(), a.end(), whole))
    throw Malformed(where + ": two integers expected, of a solid three");
  Image out{};
  for (std::size_t k = 0; k < a.size(); ++k) out[k] = static_cast<int>(a[k].get_int64());
  return out;
}

Macro read_macro(const json::value& v, Load load, const std::string& where)
{
  std::vector<const char*> names{"exx", "eyy", "exy"};
  if (load == Load::paraboloid) names = {"A", "B", "C"};
  if (load == Load::roll) names = {"kxx", "kyy", "kxy"};
  if (load == Load::strip) names = {"exx", "k"};
  if (load == Load::solid) names = {"exx", "eyy", "ezz", "eyz", "exz", "exy"};
  Macro out;
  out.load = load;
  out.values.resize(static_cast<Eigen::Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k)
    out.values[k] = number(member(v, names[k], where), where + "/" + names[k]);
  return out;
}

Contact read_contact(const json::value& v, const std::string& where)
{
  Contact out;
  out.elements = read_pair(member(v, "elements", where), where + "/elements");
  out.primitives = read_pair(member(v, "primitives", where), where + "/primitives");
  out.image = read_image(member(v, "image", where), where + "/image");
  const std::string at = where + "/points";
  const json::array& points = array(member(v, "points", where), at);
  if (points.size() != 2) throw Malformed(at + ": two points expected");
  out.points = {read_vector(points[0], at + "/0"), read_vector(points[1], at + "/1")};
  out.normal = read_vector(member(v, "normal", where), where + "/normal");
  out.gap = number(member(v, "gap", where), where + "/gap");
  out.force = number(member(v, "force", where), where + "/force");
  if (const json::value* wall = v.get_object().if_contains("wall")) out.wall = text(*wall, where + "/wall");
  return out;
}

/// What is held, and what that takes; files without it hold nothing.
void read_held(const json::value& limit, const std::string& where, Limit& out)
{
  if (const json::value* hold = limit.as_object().if_contains("hold")) {
    for (const json::value& name : array(*hold, where + "/hold"))
      out.hold.push_back(text(name, where + "/hold/" + std::to_string(out.hold.size())));
  }
  if (const json::value* reactions = limit.as_object().if_contains("reactions")) {
    for (const json::value& r : array(*reactions, where + "/reactions")) {
      const std::string at = where + "/reactions/" + std::to_string(out.reactions.size());
      out.reactions.push_back(
          {text(member(r, "name", at), at + "/name"), number(member(r, "value", at), at + "/value")});
    }
  }
}

}  // namespace

const json::value& member(const json::value& object, const char* key, const std::string& where)
{
  const json::value* found = object.is_object() ? object.get_object().if_contains(key) : nullptr;
  if (!found) throw Malformed(where + "/" + key + ": missing");
  return *found;
}

double number(const json::value& v, const std::string& where)
{
  if (!v.is_number()) throw Malformed(where + ": a number expected");
  return v.to_number<double>();
}

std::optional<double> optional_number(const json::value& object, const char* key, const std::string& where)
{
  const json::value* v = object.is_object() ? object.get_object().if_contains(key) : nullptr;
  if (!v || v->is_null()) return std::nullopt;
  return number(*v, where + "/" + key);
}

std::string text(const json::value& v, const std::string& where)
{
  if (!v.is_string()) throw Malformed(where + ": a string expected");
  return std::string(v.get_string());
}

const json::array& array(const json::value& v, const std::string& where)
{
  if (!v.is_array()) throw Malformed(where + ": an array expected");
  return v.get_array();
}

Scene read_scene(const json::value& scene, const std::string& where, const ShapeSource& source)
{
  Scene out;
  for (const json::value& vector : array(member(scene, "cell_vectors", where), where + "/cell_vectors")) {
    const json::array& a = array(vector, where + "/cell_vectors");
    if (a.empty() || a.size() > 3) throw Malformed(where + "/cell_vectors: one to three numbers expected");
    Vec3 out_vector = Vec3::Zero();
    for (std::size_t k = 0; k < a.size(); ++k) out_vector[k] = number(a[k], where + "/cell_vectors");
    out.cell.push_back(out_vector);
  }
  const bool sheet = out.cell.size() == 2 && std::abs(out.cell[0].cross(out.cell[1]).z()) > 0.0 &&
                     out.cell[0].z() == 0.0 && out.cell[1].z() == 0.0;
  const bool solid = out.cell.size() == 3 && std::abs(out.cell[0].cross(out.cell[1]).dot(out.cell[2])) > 0.0;
  const bool strip = out.cell.size() == 1 && out.cell[0].x() > 0.0 && out.cell[0].tail<2>().isZero(0.0);
  if (!out.cell.empty() && !sheet && !solid && !strip)
    throw Malformed(
        where +
        "/cell_vectors: independent vectors expected, two in the plane, three in space or one along "
        "x; none for a patch");
  std::vector<std::shared_ptr<const Surface>> surfaces;
  if (scene.as_object().contains("surfaces")) {
    const std::string at = where + "/surfaces";
    for (const json::value& v : array(member(scene, "surfaces", where), at))
      surfaces.push_back(
          std::make_shared<const Surface>(read_surface(v, at + "/" + std::to_string(surfaces.size()))));
  }
  SolidShapes shapes(source);
  std::size_t k = 0;
  for (const json::value& e : array(member(scene, "elements", where), where + "/elements")) {
    const std::string at = where + "/elements/" + std::to_string(k++);
    Element element;
    element.rest = read_place(member(e, "rest", at), at + "/rest");
    if (const json::value* parameters = e.as_object().if_contains("parameters"); parameters != nullptr) {
      if (!parameters->is_object()) throw Malformed(at + "/parameters: an object expected");
      for (const auto& [name, value] : parameters->as_object())
        element.parameters[std::string(name)] = number(value, at + "/parameters/" + std::string(name));
    }
    for (const json::value& p : array(member(e, "primitives", at), at + "/primitives"))
      element.tori.push_back(
          read_torus(p, surfaces, at + "/primitives/" + std::to_string(element.tori.size())));
    shapes.enter(text(member(e, "type", at), at + "/type"), element, at);
    for (const Primitive& torus : element.tori)
      element.reach = std::max(element.reach, torus.place.position.norm() + reach(torus));
    out.elements.push_back(std::move(element));
  }
  find_loops(out);
  out.length = number(member(scene, "length", where), where + "/length");
  return out;
}

namespace {

std::vector<MovedState> read_witness(const json::value& limit, Load load, const std::string& where)
{
  std::vector<MovedState> out;
  for (const json::value& s : array(member(limit, "witness", where), where + "/witness")) {
    const std::string at = where + "/witness/" + std::to_string(out.size());
    MovedState& state = out.emplace_back();
    state.macro = read_macro(member(s, "macro", at), load, at + "/macro");
    for (const json::value& p : array(member(s, "poses", at), at + "/poses"))
      state.places.push_back(read_place(p, at + "/poses/" + std::to_string(state.places.size())));
  }
  return out;
}

}  // namespace

Limit read_limit(const json::value& limit, Load load, const std::string& where)
{
  Limit out;
  out.load = load;
  if (limit.is_object() && limit.get_object().contains("direction")) {
    const std::string at = where + "/direction";
    const json::array& components = array(member(limit, "direction", where), at);
    if (components.size() != (load == Load::solid ? 6U : 3U))
      throw Malformed(at + ": three numbers expected, of a solid six");
    out.direction = Macros(static_cast<Eigen::Index>(components.size()));
    for (std::size_t k = 0; k < components.size(); ++k)
      (*out.direction)[k] = number(components[k], at + "/" + std::to_string(k));
    if (!(out.direction->cwiseAbs().maxCoeff() > 0.0)) throw Malformed(at + ": not all zeros expected");
    out.direction_deg = std::numeric_limits<double>::quiet_NaN();
    if (!member(limit, "direction_deg", where).is_null())
      throw Malformed(where + "/direction_deg: null expected beside a direction");
  } else {
    out.direction_deg = number(member(limit, "direction_deg", where), where + "/direction_deg");
  }
  out.where = where;
  const json::object& fields = limit.as_object();
  if (fields.contains("load_case")) out.load_case = text(fields.at("load_case"), where + "/load_case");
  out.sense = text(member(limit, "sense", where), where + "/sense");
  out.measure = text(member(limit, "measure", where), where + "/measure");
  out.status = text(member(limit, "status", where), where + "/status");
  out.contact = text(member(limit, "contact", where), where + "/contact");
  out.value = optional_number(limit, "value", where);
  out.line_stretch = optional_number(limit, "line_stretch", where);
  out.min_gap = optional_number(limit, "min_gap", where);
  out.force_balance = optional_number(limit, "force_balance", where);
  out.infimum = optional_number(limit, "infimum", where);
  out.z_range = optional_number(limit, "z_range", where);
  read_held(limit, where, out);
  if (const json::value* kink = fields.if_contains("kink")) {
    if (!kink->is_bool()) throw Malformed(where + "/kink: true or false expected");
    out.kink = kink->get_bool();
  }
  if (limit.is_object() && limit.get_object().contains("finite_target"))
    out.finite_target = number(member(limit, "finite_target", where), where + "/finite_target");
  const json::value& kept = member(limit, "links_kept", where);
  if (!kept.is_bool()) throw Malformed(where + "/links_kept: true or false expected");
  out.links_kept = kept.get_bool();
  if (const json::value& macro = member(limit, "macro", where); !macro.is_null())
    out.macro = read_macro(macro, load, where + "/macro");
  for (const json::value& s : array(member(limit, "starts", where), where + "/starts")) {
    const std::string at = where + "/starts/" + std::to_string(out.starts.size());
    out.starts.push_back({number(member(s, "value", at), at + "/value"),
                          read_macro(member(s, "macro", at), load, at + "/macro")});
  }
  for (const json::value& p : array(member(limit, "poses", where), where + "/poses"))
    out.poses.push_back(read_place(p, where + "/poses/" + std::to_string(out.poses.size())));
  for (const json::value& c : array(member(limit, "contacts", where), where + "/contacts"))
    out.contacts.push_back(read_contact(c, where + "/contacts/" + std::to_string(out.contacts.size())));
  if (limit.as_object().contains("witness")) out.witness = read_witness(limit, load, where);
  return out;
}

void check_length(const Scene& scene, double length, const std::string& where)
{
  std::vector<double> radii;
  for (const Element& element : scene.elements)
    for (const Primitive& torus : element.tori) radii.push_back(torus.R);
  if (radii.empty()) throw Malformed(where + "/elements: no primitives");
  std::sort(radii.begin(), radii.end());
  const double middle = radii[radii.size() / 2];
  if (!(std::abs(length - middle) <= unit_tolerance * middle))
    throw Malformed(where + "/length: not the median ring radius of the initial scene");
}

Setting read_setting(const json::value& experiment)
{
  Setting out;
  const json::value& solver = member(experiment, "solver", "/experiment");
  out.clearance = number(member(solver, "clearance", "/experiment/solver"), "/experiment/solver/clearance");
  if (const json::value* contact = solver.as_object().if_contains("contact");
      contact != nullptr && text(*contact, "/experiment/solver/contact") == "mesh") {
    const json::value* facets = solver.as_object().if_contains("facets");
    constexpr int absent = 20;
    const double count = facets == nullptr ? absent : number(*facets, "/experiment/solver/facets");
    if (!(count >= 3.0 && count <= 1000.0) || count != std::floor(count))
      throw Malformed("/experiment/solver/facets: an integer from 3 to 1000 expected");
    out.facets = static_cast<int>(count);
  }
  const json::value& load = member(experiment, "load_case", "/experiment");
  const std::string plugin =
      text(member(load, "plugin", "/experiment/load_case"), "/experiment/load_case/plugin");
  if (plugin == "paraboloid_bending") {
    out.load = Load::paraboloid;
    return out;
  }
  if (plugin == "volumetric_periodic") {
    out.load = Load::solid;
    return out;
  }
  if (plugin == "cylinder_roll")
    out.load = Load::roll;
  else if (plugin == "strip_roll")
    out.load = Load::strip;
  else if (plugin != "in_plane_periodic")
    throw Unknown("the load case \"" + plugin + "\" is not known to this check");
  const json::value& height = member(load, "out_of_plane", "/experiment/load_case");
  if (height.is_number())
    out.half_height = height.to_number<double>();
  else if (text(height, "/experiment/load_case/out_of_plane") != "free")
    throw Malformed("/experiment/load_case/out_of_plane: a number or \"free\" expected");
  return out;
}

}  // namespace hauberk::verification
