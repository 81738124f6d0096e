#pragma once
/// What is derived from the table of fields for editors and people.

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/plugin.hpp>
#include <hauberk/section.hpp>

#include <span>
#include <string>

namespace hauberk {

/// JSON Schema (draft 7, which editors understand) of experiment files. Sections of the given plugins are
/// described by their fields; those of other plugins may hold anything. Write it with write_json.
Node experiment_schema(std::span<const PluginTable* const> plugins, TaskFormats formats);

/// Schema of one field, without plugins.
Node field_schema(const Field& field);

/// Markdown reference of all fields, then of the fields of each plugin (share/doc/experiment.md).
std::string experiment_reference(std::span<const PluginTable* const> plugins, TaskFormats formats);

/// Markdown tables of the fields of one section, headed by `place` ("/load_case") and followed by those of
/// the objects in them.
std::string fields_reference(const std::vector<Field>& fields, const std::string& place);

}  // namespace hauberk
