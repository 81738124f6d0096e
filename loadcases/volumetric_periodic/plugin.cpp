#include "volumetric_periodic.hpp"

#include <hauberk/plugin.hpp>

namespace {

void no_fields(std::vector<hauberk::Field>&) {}

std::unique_ptr<hauberk::LoadCase> make(const hauberk::Node&, double, hauberk::Problems&)
{
  return std::make_unique<hauberk::VolumetricPeriodic>();
}

}  // namespace

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::load_case,
    "volumetric_periodic",
    "0.1.0",
    "Periodic solid of interlocked elements, strained in space.",
    "Zhou et al., Science 2025 (polycatenated architected materials); strains as in_plane_periodic has them",
    no_fields,
    nullptr,
    make,
    nullptr,
};
