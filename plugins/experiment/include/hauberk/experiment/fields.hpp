#pragma once
/// The one table of everything an experiment file may hold. Checking, defaults, the schema file and the
/// reference (share/doc/experiment.md) are derived from it.

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/plugin.hpp>
#include <hauberk/section.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// The root object, with the sections of the tasks `formats`. Sections filled by plugins hold only the fields
/// common to all plugins of their kind.
Field experiment_fields(TaskFormats formats);

/// A section whose further fields are declared by the plugin named in it.
struct PluginSection {
  PluginKind kind;
  const char* key;  ///< member that holds the plugin's id
};

/// Which plugin completes this object, if any: an entry of elements, a part of a union,
/// load_case, design.optimizer.
std::optional<PluginSection> plugin_section(const Field& object);

}  // namespace hauberk
