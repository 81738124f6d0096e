#include "results/json_parts.hpp"

#include <hauberk/solid.hpp>
#include <hauberk/triangle_surface.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace hauberk::detail {
namespace {

namespace json = boost::json;

/// Surfaces of triangle meshes that primitives refer to, each once.
class Surfaces {
 public:
  /// The number of a surface.
  std::size_t number(const std::shared_ptr<const TriangleSurface>& shared)
  {
    const TriangleSurface& surface = *shared;
    const auto same = std::find_if(found_.begin(), found_.end(), [&](const auto& known) {
      return known == shared ||
             (known->points() == surface.points() && known->triangles() == surface.triangles());
    });
    if (same != found_.end()) return static_cast<std::size_t>(same - found_.begin());
    found_.push_back(shared);
    json::object out;
    json::array& points = out["points"].emplace_array();
    for (const Vec3& x : surface.points()) points.push_back(vector_json(x));
    json::array& triangles = out["triangles"].emplace_array();
    for (const auto& t : surface.triangles()) triangles.push_back(json::array{t[0], t[1], t[2]});
    json_.push_back(std::move(out));
    return found_.size() - 1;
  }
  const json::array& list() const { return json_; }

 private:
  std::vector<std::shared_ptr<const TriangleSurface>> found_;
  json::array json_;
};

json::object primitive_json(const Primitive& primitive, Surfaces& surfaces)
{
  json::object out;
  out["name"] = primitive.name;
  out["kind"] = name_of(primitive.kind);
  out["parameters"] = {
      {"R", number(primitive.R())}, {"r0", number(primitive.r0())}, {"r1", number(primitive.r1())}};
  if (primitive.solid) {
    out["solid"] = primitive.solid->kind();
    json::object& sizes = out["parameters"].emplace_object();
    const std::vector<std::string> names = primitive.solid->size_names();
    for (std::size_t k = 0; k < names.size(); ++k) sizes[names[k]] = number(primitive.solid->sizes()[k]);
  }
  out["position"] = vector_json(primitive.position);
  out["quaternion"] = quaternion_json(primitive.rotation);
  if (primitive.surface) out["surface"] = surfaces.number(primitive.surface);
  if (primitive.curve.empty()) return out;
  json::array& curve = out["curve"].emplace_array();
  for (const Harmonic& h : primitive.curve)
    curve.push_back(json::object{{"cos", vector_json(h.c)}, {"sin", vector_json(h.s)}});
  return out;
}

json::object element_json(const PlacedElement& element, const ElementType& type, Surfaces& surfaces)
{
  json::object out;
  out["type"] = type.name;
  json::object& parameters = out["parameters"].emplace_object();
  const auto& infos = type.shape->parameters();
  for (std::size_t i = 0; i < infos.size() && i < element.parameters.size(); ++i)
    parameters[infos[i].name] = number(element.parameters[i]);
  out["rest"] = pose_json(element.rest);
  json::array& primitives = out["primitives"].emplace_array();
  for (const Primitive& primitive : type.shape->primitives(element.parameters))
    primitives.push_back(primitive_json(primitive, surfaces));
  return out;
}

}  // namespace

json::array vector_json(const Vec3& x) { return {number(x.x()), number(x.y()), number(x.z())}; }

json::array quaternion_json(const Mat3& rotation)
{
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  const std::array<double, 4> c{q.w(), q.x(), q.y(), q.z()};
  double sign = 0.0;
  for (const double value : c)
    if (sign == 0.0 && value != 0.0) sign = value > 0.0 ? 1.0 : -1.0;
  return {number(sign * c[0]), number(sign * c[1]), number(sign * c[2]), number(sign * c[3])};
}

json::object pose_json(const Pose& pose)
{
  json::object out;
  out["position"] = vector_json(pose.position);
  out["quaternion"] = quaternion_json(pose.rotation);
  return out;
}

json::object named_numbers(const std::vector<std::pair<std::string, double>>& values)
{
  json::object out;
  for (const auto& [name, value] : values) out[name] = number(value);
  return out;
}

json::array lattice_vector_json(const Vec3& v, std::size_t vectors)
{
  json::array out;
  for (std::size_t k = 0; k < vectors; ++k) out.push_back(number(v[k]));
  return out;
}

json::object scene_json(const SceneSpec& scene)
{
  json::object out;
  json::array& vectors = out["cell_vectors"].emplace_array();
  for (const Vec3& v : scene.lattice) vectors.push_back(lattice_vector_json(v, scene.lattice.size()));
  out["length"] = number(scene.length > 0.0 ? scene.length : characteristic_length(scene));
  Surfaces surfaces;
  json::array& elements = out["elements"].emplace_array();
  for (const PlacedElement& element : scene.elements)
    elements.push_back(
        element_json(element, scene.types.at(static_cast<std::size_t>(element.type)), surfaces));
  if (!surfaces.list().empty()) out["surfaces"] = surfaces.list();
  return out;
}

}  // namespace hauberk::detail
