#include "pagmo_optimizer.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::optimizer,
    "pagmo",
    "0.1.0",
    "CMA-ES of pagmo: populations drawn from a normal distribution that adapts itself, without gradients.",
    "Biscani and Izzo, J. Open Source Softw. 5 (2020) 2338; Hansen 2006, Deb 2000",
    hauberk::pagmo_fields,
    nullptr,
    nullptr,
    hauberk::make_pagmo,
};
