#include "document/json_text.hpp"
#include "export/formats.hpp"

#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>
#include <boost/json/serialize.hpp>

#include <cmath>
#include <cstdint>

namespace hauberk::exporting {
namespace {

namespace json = boost::json;

double metres(const std::string& unit) { return unit == "mm" ? 1e-3 : unit == "um" ? 1e-6 : 1.0; }

/// The binary chunk with the tables that say what is where.
class Buffer {
 public:
  enum Target : int { none = 0, points = 34962, indices = 34963 };

  /// Adds numbers and returns the number of the accessor to them.
  template <class Number>
  int add(const std::vector<Number>& values, int components, Target target, bool bounds)
  {
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    json::object view{
        {"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(Number)}};
    if (target != none) view["target"] = static_cast<int>(target);
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
    views_.push_back(std::move(view));
    constexpr bool is_float = std::is_same_v<Number, float>;
    const char* const types[] = {"", "SCALAR", "", "VEC3", "VEC4"};
    json::object accessor{{"bufferView", views_.size() - 1},
                          {"componentType", is_float ? 5126 : 5125},
                          {"count", values.size() / static_cast<std::size_t>(components)},
                          {"type", types[components]}};
    if (bounds) {
      json::array low, high;
      for (int c = 0; c < components; ++c) {
        Number least = values[c], most = least;
        for (std::size_t k = static_cast<std::size_t>(c); k < values.size();
             k += static_cast<std::size_t>(components)) {
          least = std::min(least, values[k]);
          most = std::max(most, values[k]);
        }
        low.push_back(least);
        high.push_back(most);
      }
      accessor["min"] = std::move(low);
      accessor["max"] = std::move(high);
    }
    accessors_.push_back(std::move(accessor));
    return static_cast<int>(accessors_.size()) - 1;
  }

  void enter(json::object& document)
  {
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    document["buffers"] = json::array{json::object{{"byteLength", bytes_.size()}}};
    document["bufferViews"] = views_;
    document["accessors"] = accessors_;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  json::array views_, accessors_;
};

std::vector<float> singles(const std::vector<Vec3>& vectors)
{
  std::vector<float> out;
  out.reserve(3 * vectors.size());
  for (const Vec3& x : vectors)
    for (const double component : x) out.push_back(static_cast<float>(component));
  return out;
}

/// x, y, z, w.
Eigen::Quaterniond turn_of(const Mat3& rotation) { return Eigen::Quaterniond(rotation).normalized(); }

json::object mesh_json(const Assembly& assembly, std::size_t k, Buffer& buffer)
{
  const Mesh& mesh = assembly.meshes[k];
  std::vector<std::uint32_t> corners;
  for (const auto& t : mesh.triangles)
    for (const int corner : t) corners.push_back(static_cast<std::uint32_t>(corner));
  json::object attributes{{"POSITION", buffer.add(singles(mesh.points), 3, Buffer::points, true)},
                          {"NORMAL", buffer.add(singles(point_normals(mesh)), 3, Buffer::points, false)}};
  json::object primitive{{"attributes", std::move(attributes)},
                         {"indices", buffer.add(corners, 1, Buffer::indices, false)},
                         {"material", k}};
  return {{"name", assembly.mesh_names[k]}, {"primitives", json::array{std::move(primitive)}}};
}

json::object material_json(std::size_t k)
{
  const auto colour = colour_of(static_cast<int>(k));
  json::array factor;
  for (const int c : colour)
    factor.push_back(std::pow(c / 255.0, 2.2));  // factors are linear, colours are not
  factor.push_back(1.0);
  return {{"pbrMetallicRoughness",
           json::object{
               {"baseColorFactor", std::move(factor)}, {"metallicFactor", 0.3}, {"roughnessFactor", 0.5}}}};
}

json::array array_of(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
json::array array_of(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

/// Channels that take every copy that moves from rest to its pose.
void add_animation(const Assembly& assembly, Buffer& buffer, json::object& document)
{
  json::array samplers, channels;
  int times = -1;
  const auto add = [&](std::size_t node, const char* path, const std::vector<float>& values, int components) {
    if (times < 0) times = buffer.add(std::vector<float>{0.0F, 2.0F}, 1, Buffer::none, true);
    samplers.push_back(
        json::object{{"input", times}, {"output", buffer.add(values, components, Buffer::none, false)}});
    channels.push_back(json::object{{"sampler", samplers.size() - 1},
                                    {"target", json::object{{"node", node}, {"path", path}}}});
  };
  for (std::size_t k = 0; k < assembly.copies.size(); ++k) {
    const Pose &from = assembly.copies[k].rest, &to = assembly.copies[k].pose;
    if (from.position != to.position) add(k, "translation", singles({from.position, to.position}), 3);
    if (from.rotation == to.rotation) continue;
    const Eigen::Quaterniond a = turn_of(from.rotation);
    Eigen::Quaterniond b = turn_of(to.rotation);
    if (a.dot(b) < 0.0) b.coeffs() = -b.coeffs();  // the shorter way
    std::vector<float> turns;
    for (const Eigen::Quaterniond* q : {&a, static_cast<const Eigen::Quaterniond*>(&b)})
      for (const double c : q->coeffs()) turns.push_back(static_cast<float>(c));
    add(k, "rotation", turns, 4);
  }
  if (channels.empty()) return;
  document["animations"] = json::array{json::object{
      {"name", "from rest"}, {"samplers", std::move(samplers)}, {"channels", std::move(channels)}}};
}

void put_chunk(std::string& out, std::string content, const char* kind, char filler)
{
  while (content.size() % 4 != 0) content += filler;
  const auto size = static_cast<std::uint32_t>(content.size());
  out.append(reinterpret_cast<const char*>(&size), 4);
  out.append(kind, 4);
  out += content;
}

}  // namespace

std::string glb(const Assembly& assembly)
{
  Buffer buffer;
  json::object document{{"asset", json::object{{"version", "2.0"}, {"generator", "Hauberk"}}}};
  json::array meshes, materials, nodes, children;
  for (std::size_t k = 0; k < assembly.meshes.size(); ++k) {
    meshes.push_back(mesh_json(assembly, k, buffer));
    materials.push_back(material_json(k));
  }
  for (const auto& copy : assembly.copies) {
    children.push_back(nodes.size());
    nodes.push_back(json::object{{"name", copy.name},
                                 {"mesh", copy.mesh},
                                 {"translation", array_of(copy.pose.position)},
                                 {"rotation", array_of(turn_of(copy.pose.rotation))}});
  }
  // From z upwards and the experiment's unit to y upwards and metres.
  const double scale = metres(assembly.unit), half = std::sqrt(0.5);
  nodes.push_back(json::object{{"name", assembly.name},
                               {"children", std::move(children)},
                               {"rotation", json::array{-half, 0.0, 0.0, half}},
                               {"scale", json::array{scale, scale, scale}}});
  document["scene"] = 0;
  document["scenes"] = json::array{json::object{{"nodes", json::array{nodes.size() - 1}}}};
  document["nodes"] = std::move(nodes);
  document["meshes"] = std::move(meshes);
  document["materials"] = std::move(materials);
  add_animation(assembly, buffer, document);
  buffer.enter(document);
  std::string chunks;
  put_chunk(chunks, json::serialize(document), "JSON", ' ');
  put_chunk(chunks, buffer.bytes(), "BIN\0", '\0');
  std::string out = "glTF";
  const std::uint32_t header[2] = {2, static_cast<std::uint32_t>(12 + chunks.size())};
  out.append(reinterpret_cast<const char*>(header), sizeof header);
  return out + chunks;
}

}  // namespace hauberk::exporting
