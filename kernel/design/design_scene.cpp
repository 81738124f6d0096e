#include "design/design_scene.hpp"

namespace hauberk {

std::vector<double> DesignScene::variables() const
{
  std::vector<double> x;
  for (const DesignVariable& v : design.variables) {
    const auto& [element, parameter] = v.entries.front();
    x.push_back(
        scene.elements[static_cast<std::size_t>(element)].parameters[static_cast<std::size_t>(parameter)]);
  }
  return x;
}

}  // namespace hauberk
