#include "strip_roll.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::load_case,
    "strip_roll",
    "0.1.0",
    "Strip without end that is rolled about its length, up or down.",
    "Hauberk, loadcases/strip_roll",
    hauberk::strip_roll_fields,
    nullptr,
    hauberk::make_strip_roll,
    nullptr,
};
