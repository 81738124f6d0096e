#include "design/design_scene.hpp"

namespace hauberk {

std::vector<double> DesignScene::variables() const
{
  std::vector<double> x;
  for (const DesignVariable& v : design.variables) {
    const auto& [element, parameter] = v.entries.front();
    x.push_back(scene.elements[element].parameters[parameter]);
  }
  return x;
}

}  // namespace hauberk
