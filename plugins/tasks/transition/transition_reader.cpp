#include "document/node_access.hpp"
#include "tasks/transition/transition_section.hpp"

#include <algorithm>

namespace hauberk {

namespace {

std::array<double, 3> numbers_of(const Node& section, const char* key)
{
  std::array<double, 3> out{};
  const Node* list = find_typed(section, key, Node::Type::array);
  if (list == nullptr) return out;
  for (std::size_t k = 0; k < std::min(list->items.size(), out.size()); ++k) out[k] = list->items[k].number;
  return out;
}

Vec3 vector_of(const Node& section, const char* key)
{
  const std::array<double, 3> x = numbers_of(section, key);
  return {x[0], x[1], x[2]};
}

void read_motion(const Node& section, const Vec3& origin, Problems& problems, TransitionPathInput& path)
{
  path.through = origin;
  if (const Node* rotation = find_typed(section, "rotation", Node::Type::object)) {
    const Vec3 axis = vector_of(*rotation, "axis");
    const Node* given = find_typed(*rotation, "axis", Node::Type::array);
    if (given != nullptr && axis.norm() == 0.0) problems.add(*given, "expected an axis that is not zero");
    if (axis.norm() > 0.0) path.axis = axis.normalized();
    const std::array<double, 3> degrees = numbers_of(*rotation, "degrees");
    path.degrees_from = degrees[0];
    path.degrees_to = degrees[1];
    if (rotation->find("through") != nullptr) path.through = vector_of(*rotation, "through");
  }
  if (const Node* translation = find_typed(section, "translation", Node::Type::object)) {
    path.shift_from = vector_of(*translation, "from");
    path.shift_to = vector_of(*translation, "to");
  }
  if (path.degrees_from == path.degrees_to && path.shift_from == path.shift_to)
    problems.add(section, "expected a rotation or a translation that changes along the path");
}

/// Element number, checked against the scene.
int element_of(const Node& section, const char* key, int otherwise, const SceneSpec& scene,
               bool scene_complete, Problems& problems)
{
  const int k = int_or(section, key, otherwise);
  const int count = static_cast<int>(scene.elements.size());
  if (!scene_complete || k < count) return k;
  const Node* node = section.find(key);
  problems.add(node != nullptr ? *node : section, "expected the number of a placed element, from 0 to " +
                                                      std::to_string(count - 1) + ", found " +
                                                      std::to_string(k));
  return k;
}

}  // namespace

std::shared_ptr<const TaskSection> read_transition(Node& section, SectionContext& context)
{
  const SceneSpec& scene = context.experiment.scene;
  const bool scene_complete = context.scene_complete;
  Problems& problems = context.problems;
  auto transition = std::make_shared<ExperimentTransition>();
  ExperimentTransition& out = *transition;
  out.fixed = element_of(section, "fixed", 0, scene, scene_complete, problems);
  out.moving = element_of(section, "moving", 1, scene, scene_complete, problems);
  if (out.fixed == out.moving) problems.add(section, "fixed and moving name the same element");
  out.activation_distance = number_or(section, "activation_distance", 1.0);
  set_default(section, "range",
              number_node(3.0 * out.activation_distance + context.experiment.solver.clearance));
  out.range = number_or(section, "range", 1.0);
  if (const Node* contacts = find_typed(section, "contacts", Node::Type::array)) {
    for (const Node& item : contacts->items) {
      if (std::find(out.contacts.begin(), out.contacts.end(), item.string) != out.contacts.end())
        problems.add(item, "'" + item.string + "' is given twice");
      out.contacts.push_back(item.string);
    }
  }
  Vec3 origin = Vec3::Zero();
  if (scene_complete && out.moving < static_cast<int>(scene.elements.size()))
    origin = scene.elements[out.moving].rest.position;
  const Node* paths = find_typed(section, "paths", Node::Type::array);
  if (paths == nullptr) return transition;
  for (const Node& item : paths->items) {
    TransitionPathInput path;
    path.name = string_or(item, "name", "");
    path.steps = int_or(item, "steps", 200);
    for (const TransitionPathInput& other : out.paths) {
      if (other.name == path.name) problems.add(item, "path '" + path.name + "' is given twice");
    }
    read_motion(item, origin, problems, path);
    out.paths.push_back(std::move(path));
  }
  return transition;
}

}  // namespace hauberk
