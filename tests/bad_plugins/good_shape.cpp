// The smallest correct shape. CMake defines PLUGIN_ID, and ALTERATION: a statement that may spoil the table.
#include "ring.hpp"

#include <hauberk/plugin.hpp>

namespace hauberk {
namespace {

void fields(std::vector<Field>&) {}

std::unique_ptr<Shape> make_ring(const Node&, Problems&) { return std::make_unique<Ring>(); }

[[maybe_unused]] std::unique_ptr<Optimizer> make_nothing(const Node&, Problems&) { return nullptr; }

constexpr PluginTable make_table()
{
  PluginTable table{
      HAUBERK_HANDSHAKE, PluginKind::shape, PLUGIN_ID, "1.0", "A ring for tests.", "none", fields,
      make_ring,         nullptr,           nullptr};
  ALTERATION;
  return table;
}

}  // namespace
}  // namespace hauberk

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = hauberk::make_table();
