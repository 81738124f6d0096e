#include "rounded_ring.hpp"

#include <hauberk/plugin.hpp>

namespace hauberk {
namespace {

void no_fields(std::vector<Field>&) {}

std::unique_ptr<Shape> make_rounded_ring(const Node&, Problems&)
{
  return std::make_unique<kit::SolidShape<RoundedRing>>("ring");
}

}  // namespace
}  // namespace hauberk

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "rounded_ring",
    "0.1.0",
    "Rings of rounded rectangular wire.",
    "distance from a rectangle less the radius of its corners, revolved",
    hauberk::no_fields,
    hauberk::make_rounded_ring,
    nullptr,
    nullptr,
};
