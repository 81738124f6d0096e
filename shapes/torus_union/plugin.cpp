#include "torus_union.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "torus_union",
    "0.1.0",
    "Rigid union of tori with circular or elliptical cross-sections.",
    "Tang, Coros, Thomaszewski and Bickel, SIGGRAPH 2025, equation (1)",
    hauberk::torus_union_fields,
    hauberk::make_torus_union,
    nullptr,
    nullptr,
};
