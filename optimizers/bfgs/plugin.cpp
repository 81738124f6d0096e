#include "bfgs.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::optimizer,
    "bfgs",
    "0.1.0",
    "Projected BFGS or limited-memory BFGS; constraints by an augmented Lagrangian.",
    "Nocedal and Wright, Numerical Optimization, 2nd ed., chapters 6, 7 and 17; Birgin and Martinez 2014",
    hauberk::bfgs_fields,
    nullptr,
    nullptr,
    hauberk::make_bfgs,
};
