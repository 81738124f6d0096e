// A library that exports something else by the name of the list of plugins.
extern "C" __attribute__((visibility("default"))) int hauberk_plugins() { return 1; }
