#include "ipopt_optimizer.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::optimizer,
    "ipopt",
    "0.1.0",
    "Interior points of Ipopt: a filter line search, exact Hessians or limited-memory BFGS.",
    "Waechter and Biegler, Mathematical Programming 106 (2006) 25",
    hauberk::ipopt_fields,
    nullptr,
    nullptr,
    hauberk::make_ipopt,
};
