/// Rings of round wire as an author would write them: a chart, and a field that is no distance, without a
/// core.

#include "solid_kit/solids.hpp"

#include <hauberk/kit/solid_shape.hpp>
#include <hauberk/plugin.hpp>

namespace hauberk::test {
namespace {

struct Ring : PlainTorus {
  static constexpr const char* kind = "ring";
  static constexpr bool revolved = true;
  static std::vector<ParameterInfo> parameters()
  {
    return {{"R", "length", 5.0, 1e-9, 1e9, "radius of the core", true},
            {"r", "length", 0.7, 1e-9, 1e9, "radius of the wire", true}};
  }
};

void fields(std::vector<Field>&) {}

std::unique_ptr<Shape> make(const Node&, Problems&)
{
  return std::make_unique<kit::SolidShape<Ring>>("ring");
}

}  // namespace
}  // namespace hauberk::test

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "solid_rings",
    "1.0",
    "Rings as solids, for tests.",
    "none",
    hauberk::test::fields,
    hauberk::test::make,
    nullptr,
    nullptr};
