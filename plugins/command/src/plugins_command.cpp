#include "dispatch.hpp"
#include "document/check.hpp"
#include "document/json_text.hpp"
#include "experiment_options.hpp"
#include "say.hpp"

#include <hauberk/experiment/schema.hpp>
#include <hauberk/experiment/union_shape.hpp>
#include <hauberk/host/factories.hpp>
#include <hauberk/host/trust.hpp>
#include <hauberk/suggestion.hpp>

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>

namespace hauberk::command {
namespace {

std::string kind_text(PluginKind kind)
{
  const std::string text = with_article(kind);
  return text.substr(text.find(' ') + 1);
}

/// Where a section of this kind stands in an experiment.
std::string section_place(PluginKind kind)
{
  switch (kind) {
    case PluginKind::shape:
      return "/elements/NAME";
    case PluginKind::load_case:
      return "/load_case";
    case PluginKind::optimizer:
      return "/design/optimizer";
  }
  return "";
}

void print_line(const PluginTable& table)
{
  say("{:<20} {:<10} {:<8} {}\n", table.id, kind_text(table.kind), table.version, table.summary);
}

void describe_in(boost::json::object& out, const PluginTable& table)
{
  out["kind"] = kind_text(table.kind);
  out["version"] = table.version;
  out["summary"] = table.summary;
}

/// What whoever trusts the listed plugins should know, on stderr.
void warn(const Registry& registry, const std::vector<PluginEntry>& entries)
{
  for (const std::string& warning : open_to_others(registry.directories()))
    say_error("hauberk: warning: {}\n", warning);
  for (const PluginEntry& entry : entries) {
    if (entry.shadowed_by)
      say_error("hauberk: warning: {}\n", shadow_text(entry.id, *entry.shadowed_by, entry.file));
  }
}

/// The built-in union comes last. Broken plugins are said so and make the exit code 1.
int list(const Registry& registry)
{
  bool broken = false;
  const std::vector<PluginEntry> entries = registry.list();
  warn(registry, entries);
  for (const PluginEntry& entry : entries) {
    if (entry.table != nullptr) {
      print_line(*entry.table);
    } else if (entry.shadowed_by) {
      say("{:<20} not used: {} is found before {}\n", entry.id, entry.shadowed_by->string(),
          entry.file.string());
    } else {
      say("{:<20} cannot be used: {}\n", entry.id, entry.problem);
      broken = true;
    }
  }
  print_line(union_table());
  return broken ? exit_failed : exit_done;
}

/// [{id, kind, version, summary, file}], with `problem` instead of the middle three where one cannot be used;
/// of what is built in, `file` is null.
int list_as_json(const Registry& registry)
{
  boost::json::array out;
  bool broken = false;
  const std::vector<PluginEntry> entries = registry.list();
  warn(registry, entries);
  for (const PluginEntry& entry : entries) {
    boost::json::object plugin{{"id", entry.id}, {"file", entry.file.string()}};
    if (entry.table != nullptr) {
      describe_in(plugin, *entry.table);
    } else if (entry.shadowed_by) {
      plugin["problem"] = fmt::format("not used: {} is found before", entry.shadowed_by->string());
    } else {
      plugin["problem"] = entry.problem;
      broken = true;
    }
    out.push_back(std::move(plugin));
  }
  boost::json::object built_in{{"id", union_table().id}, {"file", nullptr}};
  describe_in(built_in, union_table());
  out.push_back(std::move(built_in));
  say_json(write_json(out));
  return broken ? exit_failed : exit_done;
}

/// What `make` (of factories.hpp) makes of a section in which nothing is set; null where the plugin needs
/// settings.
template <class Made>
std::unique_ptr<Made> with_defaults(std::unique_ptr<Made> (*make)(const PluginTable&, const Node&, Problems&),
                                    const PluginTable& table)
{
  Field fields;
  fields.kind = Field::Kind::object;
  fields.children = plugin_fields(table);
  Node section;
  section.type = Node::Type::object;
  Problems problems;
  if (!check_fields(section, fields, problems) || !problems.empty()) return nullptr;
  return make(table, section, problems);
}

/// What an optimizer declares, as one that is asked for with default settings does.
std::string traits_text(const PluginTable& table)
{
  const std::unique_ptr<Optimizer> optimizer = with_defaults(make_optimizer, table);
  if (!optimizer) return "What it declares depends on these fields.\n";
  const OptimizerTraits traits = optimizer->traits();
  const auto word = [](bool holds) { return holds ? "yes" : "no"; };
  return fmt::format("with defaults: keeps equations: {}; draws random numbers: {}; thread safe: {}\n",
                     word(traits.equalities), word(traits.stochastic), word(traits.thread_safe));
}

/// Parameters of a shape that needs no settings of its own; others depend on them.
std::string parameters_text(const PluginTable& table)
{
  if (table.make_shape == nullptr) return "Its parameters are those of its parts, and where these are.\n";
  const std::unique_ptr<Shape> shape = with_defaults(make_shape, table);
  if (!shape) return "Its parameters depend on these fields.\n";
  std::string text = fmt::format("{:<20} {:<8} {:>10} {:>10} {:>10}  {}\n", "parameter", "unit", "default",
                                 "lower", "upper", "meaning");
  for (const ParameterInfo& info : shape->parameters()) {
    const std::string value =
        std::isnan(info.default_value) ? "required" : fmt::format("{:g}", info.default_value);
    text += fmt::format("{:<20} {:<8} {:>10} {:>10g} {:>10g}  {}\n", info.name, info.unit, value, info.lower,
                        info.upper, info.doc);
  }
  return text;
}

int describe(const PluginTable& table, const std::string& file)
{
  say("{} {}: {}\n{}\n\n", table.id, table.version, kind_text(table.kind), table.summary);
  say("source: {}\nfile:   {}\n\n", table.citation, file);
  const std::vector<Field> fields = plugin_fields(table);
  if (!fields.empty()) say("{}", fields_reference(fields, section_place(table.kind)));
  if (table.kind == PluginKind::shape) say("{}", parameters_text(table));
  if (table.kind == PluginKind::optimizer) say("{}", traits_text(table));
  return exit_done;
}

int describe(const Registry& registry, const std::string& id)
{
  if (id == union_table().id) return describe(union_table(), "built in");
  std::vector<std::string> known{union_table().id}, searched;
  for (const PluginEntry& entry : registry.list()) {
    if (entry.table == nullptr) {
      if (entry.id == id && !entry.problem.empty()) throw InputError(entry.problem);
      continue;
    }
    known.push_back(entry.id);
    if (entry.id == id) return describe(*entry.table, entry.file.string());
  }
  for (const auto& folder : registry.directories()) searched.push_back(folder.string());
  throw InputError(fmt::format("no plugin '{}'{} (searched: {}; others with --plugin-path)", id,
                               suggestion(id, known), fmt::join(searched, ", ")));
}

}  // namespace

Description plugins_description()
{
  return {.name = "plugins",
          .form = "[list | describe ID | conform FILE.so | new NAME DIR]",
          .line = "shapes, load cases and optimizers that are found",
          .synopsis = "plugins [list | describe ID | conform FILE.so | new NAME DIR] [--plugin-path DIR]",
          .summary =
              "Lists the plugins that are found, or explains one with all its fields. conform checks "
              "one that was built elsewhere, new writes a project to begin with; both have their own --help.",
          .arguments =
              {{.name = "WHAT", .offer = Offer::words, .choices = {"list", "describe"}, .optional = true},
               {.name = "ID", .offer = Offer::plugins, .after = "describe", .optional = true}},
          .options = {plugin_path_option(), json_option()}};
}

int plugins_command(const std::vector<std::string>& words)
{
  Options options(plugins_description());
  options.parse(words);
  const std::vector<std::string> what = options.positionals();
  const auto registry = open_registry(options);
  if (what.empty() || (what.size() == 1 && what[0] == "list"))
    return options.has("json") ? list_as_json(*registry) : list(*registry);
  if (what.size() == 2 && what[0] == "describe") return describe(*registry, what[1]);
  if (what[0] == "describe") throw UsageError("describe: expected the id of one plugin", options.usage());
  if (what[0] == "list") throw UsageError("list: expected nothing after it", options.usage());
  throw UsageError(fmt::format("plugins: expected list, describe, conform or new, found '{}'", what[0]),
                   options.usage());
}

}  // namespace hauberk::command
