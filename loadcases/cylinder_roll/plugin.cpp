#include "cylinder_roll.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::load_case,
    "cylinder_roll",
    "0.1.0",
    "Patch rolled onto a cylinder of large rotation, up or down, along a direction.",
    "Hauberk, loadcases/cylinder_roll",
    hauberk::cylinder_roll_fields,
    nullptr,
    hauberk::make_cylinder_roll,
    nullptr,
};
