#include "json_parts.hpp"

#include <Eigen/Geometry>

namespace hauberk::detail {
namespace {

namespace json = boost::json;

json::object primitive_json(const Primitive& primitive)
{
  json::object out;
  out["name"] = primitive.name;
  out["kind"] = name_of(primitive.kind);
  out["parameters"] = {
      {"R", number(primitive.R())}, {"r0", number(primitive.r0())}, {"r1", number(primitive.r1())}};
  out["position"] = vector_json(primitive.position);
  out["quaternion"] = quaternion_json(primitive.rotation);
  if (primitive.curve.empty()) return out;
  json::array& curve = out["curve"].emplace_array();
  for (const Harmonic& h : primitive.curve)
    curve.push_back(json::object{{"cos", vector_json(h.c)}, {"sin", vector_json(h.s)}});
  return out;
}

json::object element_json(const PlacedElement& element, const ElementType& type)
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
    primitives.push_back(primitive_json(primitive));
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

json::object scene_json(const SceneSpec& scene)
{
  json::object out;
  json::array& vectors = out["cell_vectors"].emplace_array();
  for (const Vec3& v : scene.lattice) {
    // As `cell.vectors` of experiments.
    json::array components{number(v.x()), number(v.y())};
    if (scene.lattice.size() == 3) components.push_back(number(v.z()));
    vectors.push_back(std::move(components));
  }
  out["length"] = number(scene.length > 0.0 ? scene.length : characteristic_length(scene));
  json::array& elements = out["elements"].emplace_array();
  for (const PlacedElement& element : scene.elements)
    elements.push_back(element_json(element, scene.types.at(static_cast<std::size_t>(element.type))));
  return out;
}

}  // namespace hauberk::detail
