#include "in_plane_periodic.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::load_case,
    "in_plane_periodic",
    "0.1.0",
    "Periodic sheet stretched or compressed along a direction in its plane.",
    "Tang, Coros, Thomaszewski and Bickel, SIGGRAPH 2025, in-plane deformation limits",
    hauberk::in_plane_periodic_fields,
    nullptr,
    hauberk::make_in_plane_periodic,
    nullptr,
};
