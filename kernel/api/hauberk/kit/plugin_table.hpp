#pragma once
/// What a library exports: the table of its plugin, or a list of the tables of several.
///
/// One plugin, in the file ID.so:
///
///     extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin =
///         hauberk::kit::shape_table({"oval_link", "0.1.0", "Oval rings.", "your publication"}, fields,
///         make);
///
/// Several, in a file of any name; in one of its sources, at namespace scope:
///
///     extern const hauberk::PluginTable oval_link, oval_sheet;  // each defined in a source of its own
///     HAUBERK_PLUGINS(&oval_link, &oval_sheet);
///
/// Each table has its own handshake, id and kind, and all are checked when the library is loaded. Where one
/// is wrong, or two have one id, none of the library can be used. In one folder the file ID.so comes before a
/// library that has ID in its list.

#include <hauberk/plugin.hpp>

#include <memory>
#include <vector>

namespace hauberk::kit {

/// The texts of a table, see PluginTable.
struct About {
  const char *id, *version, *summary, *citation;
};

/// Of a plugin without settings of its own.
inline void no_fields(std::vector<Field>& /*out*/) {}

/// A table without a factory.
consteval PluginTable table_of(PluginKind kind, const About& about, void (*fields)(std::vector<Field>&))
{
  return {HAUBERK_HANDSHAKE, kind,   about.id, about.version, about.summary,
          about.citation,    fields, nullptr,  nullptr,       nullptr};
}

/// The table of a shape; that of the other kinds is made alike.
consteval PluginTable shape_table(const About& about, void (*fields)(std::vector<Field>&),
                                  std::unique_ptr<Shape> (*make)(const Node&, Problems&))
{
  PluginTable table = table_of(PluginKind::shape, about, fields);
  table.make_shape = make;
  return table;
}

consteval PluginTable load_case_table(const About& about, void (*fields)(std::vector<Field>&),
                                      std::unique_ptr<LoadCase> (*make)(const Node&, double, Problems&))
{
  PluginTable table = table_of(PluginKind::load_case, about, fields);
  table.make_load_case = make;
  return table;
}

consteval PluginTable optimizer_table(const About& about, void (*fields)(std::vector<Field>&),
                                      std::unique_ptr<Optimizer> (*make)(const Node&, Problems&))
{
  PluginTable table = table_of(PluginKind::optimizer, about, fields);
  table.make_optimizer = make;
  return table;
}

}  // namespace hauberk::kit

/// Exports pointers to constant tables, at least one, and what ends the list.
#define HAUBERK_PLUGINS(...)                                                                                \
  extern "C" HAUBERK_EXPORT constinit const ::hauberk::PluginTable* const hauberk_plugins[] = {__VA_ARGS__, \
                                                                                               nullptr}
