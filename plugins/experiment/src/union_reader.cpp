#include "union_reader.hpp"

#include "rotation.hpp"

#include <hauberk/experiment/plugin_resolver.hpp>
#include <hauberk/experiment/union_shape.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace hauberk {

namespace {

/// Names of parts become the first of the words of variable names such as 3/left.ring.R and */left.x, so '/',
/// '*' and '.' must not be in them.
bool usable_name(const std::string& name)
{
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-';
  });
}

/// A part's place has parameters of its own, so its shape cannot have such ones.
void check_parameters(const Node& part, const Shape& shape, Problems& problems)
{
  for (const char* name : place_parameters) {
    if (parameter_index(shape, name) < 0) continue;
    problems.add(part.at("shape"), "shape '" + part.at("shape").string + "' has a parameter '" + name +
                                       "', which places parts, so it cannot be one");
  }
}

}  // namespace

std::shared_ptr<const Shape> make_union(const Node& section, const PartMaker& make_part, Problems& problems)
{
  const std::size_t before = problems.list().size();
  std::vector<UnionPart> parts;
  std::set<std::string> names;
  bool complete = true;
  for (const Node& node : section.at("parts").items) {
    UnionPart part;
    part.shape = make_part(node);
    part.rotation = read_rotation(node.find("rotation"), problems);
    complete = complete && part.shape && node.find("name") && node.find("position");
    if (const Node* name = node.find("name")) {
      part.name = name->string;
      if (!usable_name(part.name)) {
        problems.add(*name, "expected a name of letters, digits, '_' and '-', found '" + part.name + "'");
      } else if (!names.insert(part.name).second) {
        problems.add(*name, "there are two parts named '" + part.name + "'; give each its own name");
      }
    }
    if (part.shape) check_parameters(node, *part.shape, problems);
    if (const Node* position = node.find("position")) {
      const std::vector<double> x = position->numbers();
      part.position = Vec3(x[0], x[1], x[2]);
    }
    parts.push_back(std::move(part));
  }
  if (!complete || problems.list().size() > before) return nullptr;
  return std::make_shared<const UnionShape>(std::move(parts));
}

std::string unfit_for_parts(const std::vector<Field>& fields)
{
  for (const Field& field : fields) {
    for (const char* key : {"name", "position", "rotation"}) {
      if (field.name == key)
        return std::string("it has a field '") + key + "' of its own, which is one of parts";
    }
  }
  return {};
}

}  // namespace hauberk
