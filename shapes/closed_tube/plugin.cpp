#include "closed_tube.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "closed_tube",
    "0.1.0",
    "Tube of constant radius around a closed smooth curve: oval links, rounded polygons, torus knots.",
    "Tang, Coros and Thomaszewski, SIGGRAPH 2023 (elements of general shape); curves as finite Fourier "
    "series",
    hauberk::closed_tube_fields,
    hauberk::make_closed_tube,
    nullptr,
    nullptr,
};
