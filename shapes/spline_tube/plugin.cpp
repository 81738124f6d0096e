#include "spline_tube.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "spline_tube",
    "0.1.0",
    "Closed tube around a spline through nodes, with a radius that varies along it.",
    "canal surface: the envelope of balls along a periodic spline of degree 5 (de Boor, A Practical Guide to "
    "Splines, 2001)",
    hauberk::spline_tube_fields,
    hauberk::make_spline_tube,
    nullptr,
    nullptr,
};
