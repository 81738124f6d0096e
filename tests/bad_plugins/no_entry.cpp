// A shared library that is no plugin. Its constructor must not run: the file alone shows that it is none.
#include <cstdlib>

namespace {
[[gnu::constructor]] void run_at_load() { std::abort(); }
}  // namespace

extern "C" __attribute__((visibility("default"))) int hauberk_plugin_table() { return 0; }
