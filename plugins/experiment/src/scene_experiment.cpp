#include "document/jsonc.hpp"
#include "document/node_access.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <filesystem>

namespace hauberk {

namespace {

namespace fs = std::filesystem;

/// Every string of a tree that is one of `paths`, relative to `from`, made relative to `to`.
void rebase(Node& node, const std::vector<std::string>& paths, const fs::path& from, const fs::path& to)
{
  if (node.type == Node::Type::string && std::find(paths.begin(), paths.end(), node.string) != paths.end() &&
      fs::path(node.string).is_relative()) {
    const fs::path file = fs::absolute(from / node.string).lexically_normal();
    const fs::path seen = file.lexically_relative(fs::absolute(to).lexically_normal());
    node.string = (seen.empty() ? file : seen).generic_string();
  }
  for (Node& item : node.items) rebase(item, paths, from, to);
  for (auto& [key, value] : node.members) rebase(value, paths, from, to);
}

Node array_node(std::vector<Node> items)
{
  Node node;
  node.type = Node::Type::array;
  node.items = std::move(items);
  return node;
}

Node placement(const SceneSpec& scene, const PlacedElement& element)
{
  const ElementType& type = scene.types[element.type];
  const Vec3& x = element.rest.position;
  Eigen::Quaterniond q(element.rest.rotation);
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  Node rotation = object_node();
  set_default(rotation, "quaternion", numbers_node(std::array{q.w(), q.x(), q.y(), q.z()}));
  Node parameters = object_node();
  for (std::size_t k = 0; k < element.parameters.size(); ++k) {
    set_default(parameters, type.shape->parameters()[k].name, number_node(element.parameters[k]));
  }
  Node entry = object_node();
  set_default(entry, "element", string_node(type.name));
  set_default(entry, "position", numbers_node(std::array{x.x(), x.y(), x.z()}));
  set_default(entry, "rotation", std::move(rotation));
  set_default(entry, "parameters", std::move(parameters));
  return entry;
}

}  // namespace

Node scene_experiment(const Experiment& experiment, const SceneSpec& scene, const std::string& name)
{
  // Cells that are alike stay a cell and its copies, which a search from rest moves alike.
  const bool alike = !scene.lattice.empty() && cells_alike(scene, characteristic_length(scene));
  const std::array<int, 3> repeat = alike ? scene.repeat : std::array<int, 3>{1, 1, 1};
  Node cell = object_node();
  if (!scene.lattice.empty()) {
    std::vector<Node> vectors;
    std::vector<double> counts;
    for (std::size_t k = 0; k < scene.lattice.size(); ++k) {
      const Vec3 v = scene.lattice[k] / repeat[k];
      vectors.push_back(numbers_node(std::span(v.data(), scene.lattice.size())));
      counts.push_back(repeat[k]);
    }
    set_default(cell, "vectors", array_node(std::move(vectors)));
    set_default(cell, "repeat", numbers_node(counts));
  } else {  // a patch: one cell that holds every element
    Node outline = object_node();
    set_default(outline, "rectangle", numbers_node(std::array{1.0, 1.0}));
    Node patch = object_node();
    set_default(patch, "vectors", experiment.expanded.at("cell").at("patch").at("vectors"));
    set_default(patch, "outline", std::move(outline));
    set_default(patch, "tile", numbers_node(std::array{1.0, 1.0}));
    set_default(cell, "patch", std::move(patch));
  }
  std::vector<Node> place;
  const auto placed = scene.elements.size() / static_cast<std::size_t>(cell_count(repeat));
  for (std::size_t k = 0; k < placed; ++k) place.push_back(placement(scene, scene.elements[k]));
  set_default(cell, "place", array_node(std::move(place)));
  Node relax;
  relax.type = Node::Type::boolean;
  relax.boolean = experiment.relax;
  set_default(cell, "relax", std::move(relax));

  Node root = object_node();
  set_default(root, "name", string_node(name));
  set_default(root, "task", string_node("limits"));
  for (const char* key : {"length_unit", "seed", "elements"})
    set_default(root, key, experiment.expanded.at(key));
  set_default(root, "cell", std::move(cell));
  for (const char* key : {"load_case", "solver"}) set_default(root, key, experiment.expanded.at(key));
  relocate(root, "", 0);
  return root;
}

Node in_folder(Node written, const Experiment& experiment, const std::string& to)
{
  for (auto& [key, value] : written.members) {
    if (key == "elements" || key == "load_case")
      rebase(value, experiment.plugin_files, experiment.folder, to);
  }
  return written;
}

}  // namespace hauberk
