#include "sqp.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::optimizer,
    "sqp",
    "0.1.0",
    "Sequential quadratic programming with bundled residuals or a damped BFGS Hessian, for few and expensive "
    "evaluations.",
    "Nocedal and Wright, Numerical Optimization, 2nd ed., chapter 18; Goldfarb and Idnani 1983",
    hauberk::sqp_fields,
    nullptr,
    nullptr,
    hauberk::make_sqp,
};
