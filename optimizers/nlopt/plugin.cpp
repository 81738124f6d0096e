#include "nlopt_optimizer.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::optimizer,
    "nlopt",
    "0.1.0",
    "Local algorithms of NLopt: SLSQP, MMA, CCSAQ, L-BFGS with an augmented Lagrangian, COBYLA.",
    "S. G. Johnson, The NLopt nonlinear-optimization package; Kraft 1994, Svanberg 2002, Powell 1994",
    hauberk::nlopt_fields,
    nullptr,
    nullptr,
    hauberk::make_nlopt,
};
