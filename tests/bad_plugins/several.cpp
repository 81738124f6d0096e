// Two plugins in one library, a shape and an optimizer. CMake defines PLUGIN_ID, with which their ids begin;
// ALTERATION: a statement that may spoil the second table; and LIST: what the library exports.
#include "ring.hpp"

#include <hauberk/kit/plugin_table.hpp>

namespace hauberk {
namespace {

class Nothing final : public Optimizer {
 protected:
  OptimizerResult do_minimize(OptimizationProblem&, std::span<const double> start,
                              OptimizerObserver&) const override
  {
    return {"failed", "it never tries", {start.begin(), start.end()}};
  }
};

std::unique_ptr<Shape> make_ring(const Node&, Problems&) { return std::make_unique<Ring>(); }
std::unique_ptr<Optimizer> make_nothing(const Node&, Problems&) { return std::make_unique<Nothing>(); }

constexpr PluginTable ring =
    kit::shape_table({PLUGIN_ID "_ring", "1.0", "A ring for tests.", "none"}, kit::no_fields, make_ring);

constexpr PluginTable make_second()
{
  PluginTable table = kit::optimizer_table({PLUGIN_ID "_search", "2.0", "A search for tests.", "none"},
                                           kit::no_fields, make_nothing);
  ALTERATION;
  return table;
}
constexpr PluginTable second = make_second();

}  // namespace
}  // namespace hauberk

using hauberk::ring, hauberk::second;
HAUBERK_PLUGINS(LIST);

#if defined(WITH_ONE)
extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = ring;
#endif
