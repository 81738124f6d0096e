#include "paraboloid_bending.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::load_case,
    "paraboloid_bending",
    "0.1.0",
    "Patch bent onto a paraboloid, up or down, along a direction.",
    "Tang, Coros, Thomaszewski and Bickel, SIGGRAPH 2025, out-of-plane deformation limits",
    hauberk::paraboloid_bending_fields,
    nullptr,
    hauberk::make_paraboloid_bending,
    nullptr,
};
