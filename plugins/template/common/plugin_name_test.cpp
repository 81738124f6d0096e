/// The plugin does what every plugin of its kind must do. Add tests of what is particular to yours.

#include <hauberk/conformance/gtest.hpp>

namespace {

// A third argument would be the section of an experiment as JSON, if defaults are not what you want to test.
HAUBERK_CONFORMANCE_TESTS(PluginName, PLUGIN_FILE);

}  // namespace
