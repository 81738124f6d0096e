// Refers to a function nobody defines.
#include <hauberk/plugin.hpp>

extern "C" void hauberk_test_undefined_function(std::vector<hauberk::Field>&);

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin{
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "missing_symbol",
    "1.0",
    "Cannot be loaded.",
    "none",
    [](std::vector<hauberk::Field>& out) { hauberk_test_undefined_function(out); },
    nullptr,
    nullptr,
    nullptr};
