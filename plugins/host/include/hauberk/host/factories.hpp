#pragma once
/// Makes objects from plugins. Every call into the plugin, at creation and later, goes through a Guard: what
/// is returned are wrappers that own the plugin's object and guard each of its methods.

#include <hauberk/plugin.hpp>

#include <memory>
#include <vector>

namespace hauberk {

/// The fields of the plugin's own section. Throws PluginError when the plugin throws.
std::vector<Field> plugin_fields(const PluginTable& table);

/// Null when the section is wrong, and then `problems` has at least one entry. Throws PluginError when the
/// plugin throws, or returns null without a problem. The table must be of the matching kind.
std::unique_ptr<Shape> make_shape(const PluginTable& table, const Node& section, Problems& problems);

/// As make_shape; `length` is the scene's characteristic length L in file units.
std::unique_ptr<LoadCase> make_load_case(const PluginTable& table, const Node& section, double length,
                                         Problems& problems);

/// As make_shape. What the problem or the observer throws during `minimize` passes through unchanged. Runs of
/// optimizers of one library that do not declare themselves thread safe wait for each other; a run that the
/// problem of another one starts in its thread does not. So a problem must not wait in a callback for such a
/// run in another thread.
std::unique_ptr<Optimizer> make_optimizer(const PluginTable& table, const Node& section, Problems& problems);

}  // namespace hauberk
