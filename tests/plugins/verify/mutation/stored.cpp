#include "stored.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/stored_shapes.hpp>
#include <hauberk/host/registry.hpp>

#include <filesystem>

namespace hauberk::test {

VerifyShapes stored_shapes()
{
  const std::filesystem::path program(HAUBERK_PROGRAM);
  const auto registry = std::make_shared<const Registry>(std::vector<std::filesystem::path>{
      HAUBERK_SOLID_SHAPES, program.parent_path() / "../lib/hauberk/plugins"});
  return StoredShapes(
      [registry](PluginKind kind, const std::string& id, std::string& error) -> const PluginTable* {
        try {
          return &registry->find(kind, id);
        } catch (const InputError& problem) {
          error = problem.what();
          return nullptr;
        }
      });
}

std::string solid_chain_text()
{
  return R"({
  "name": "solid chain", "task": "limits",
  "elements": {
    "a": { "shape": "solid_rings", "parameters": { "R": 5, "r": 0.7 } },
    "b": { "shape": "solid_rings", "parameters": { "R": 4.6, "r": 0.7 } } },
  "cell": { "vectors": [[15.5, 0], [0, 100]],
    "place": [
      { "element": "a", "position": [0, 0, 0] },
      { "element": "b", "position": [7.75, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 90 } } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "solver": { "preset": "accurate" }
})";
}

}  // namespace hauberk::test
