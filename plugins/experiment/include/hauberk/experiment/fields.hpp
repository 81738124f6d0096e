#pragma once
/// The one table of everything an experiment file may hold. Checking, defaults, the schema file and the
/// reference (share/doc/experiment.md) are derived from it.

#include <hauberk/plugin.hpp>
#include <hauberk/settings.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// The root object. Sections filled by plugins hold only the fields common to all plugins of their kind.
Field experiment_fields();

/// A section whose further fields are declared by the plugin named in it.
struct PluginSection {
  PluginKind kind;
  const char* key;  ///< member that holds the plugin's id
};

/// Which plugin completes this object, if any: an entry of elements, load_case, design.optimizer.
std::optional<PluginSection> plugin_section(const Field& object);

/// `declared` with `extra` appended; an extra field replaces a declared one of the same name.
std::vector<Field> merge_fields(std::vector<Field> declared, const std::vector<Field>& extra);

}  // namespace hauberk
