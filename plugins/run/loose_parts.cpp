#include "run/loose_parts.hpp"

#include "geometry/joined.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace hauberk {
namespace {

constexpr std::size_t most_named = 4;

/// Empty where all primitives hang together.
std::string loose_parts_of(const ElementType& type, const std::vector<double>& parameters)
{
  const std::vector<Primitive> primitives = type.shape->primitives(parameters);
  const std::vector<std::vector<int>> groups = joined_primitives(primitives);
  if (groups.size() < 2) return {};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(groups.size(), most_named); ++k)
    names.push_back("'" + primitives[static_cast<std::size_t>(groups[k].front())].name + "'");
  if (groups.size() > most_named) names.emplace_back("...");
  return fmt::format(
      "the element '{}' is of {} bodies that nothing joins ({}): they move as one here, but cannot be "
      "made as one",
      type.name, groups.size(), fmt::join(names, ", "));
}

}  // namespace

std::vector<std::string> loose_parts(const SceneSpec& scene)
{
  std::set<std::pair<int, std::vector<double>>> seen;
  std::map<int, std::string> found;  // by type
  for (const PlacedElement& element : scene.elements) {
    if (found.contains(element.type) || !seen.emplace(element.type, element.parameters).second) continue;
    const ElementType& type = scene.types[static_cast<std::size_t>(element.type)];
    if (std::string line = loose_parts_of(type, element.parameters); !line.empty())
      found.emplace(element.type, std::move(line));
  }
  std::vector<std::string> out;
  for (auto& [type, line] : found) out.push_back(std::move(line));
  return out;
}

}  // namespace hauberk
