#pragma once
/// Checking a value tree against a table of fields.

#include <hauberk/section.hpp>

#include <functional>
#include <string>
#include <vector>

namespace hauberk {

/// Fields a section has beyond its declared children, because a plugin chosen in it declares more.
struct ExtraFields {
  std::vector<Field> fields;  ///< replace declared children of the same name
  bool open = false;          ///< the plugin is not known: further keys cannot be judged
};

/// Asked for every object; adds problems of its own (a plugin that is missing) to `problems`.
using ExtraFieldsOf = std::function<ExtraFields(const Field& field, const Node& object, Problems& problems)>;

/// Checks `node` against `field` and fills in defaults (line 0), reporting every problem: wrong types, values
/// out of range, unknown keys (with the nearest known one), missing keys. Returns whether `node` itself is
/// usable; members that are not are removed, so that what remains has the declared types and later checks
/// only need to expect absence. Thread safe.
bool check_fields(Node& node, const Field& field, Problems& problems, const ExtraFieldsOf& extra = {});

/// What a field accepts, for people: "a number >= 0", "one of fast, accurate", "an array of 2 numbers".
std::string describe_expected(const Field& field);

/// What a value is, for people: "5", "\"abc\"", "an array of 3 values", "an object".
std::string describe_found(const Node& node);

/// The default as a tree with pointer `pointer` and line 0. Throws PluginError when it is not valid JSON.
Node default_node(const Field& field, const std::string& pointer);

}  // namespace hauberk
