#include "union_reader.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/fields.hpp>
#include <hauberk/experiment/plugin_resolver.hpp>
#include <hauberk/experiment/union_shape.hpp>
#include <hauberk/host/factories.hpp>

#include <filesystem>

namespace hauberk {

namespace {

/// Plugins are promised a checked section. What was wrong has been removed from it and was replaced by a
/// default where there is one; true when nothing that the plugin requires is missing now. Parts of a union
/// are checked when they are made.
bool is_intact(const Node& section, const PluginTable& table)
{
  Field own;
  own.kind = Field::Kind::object;
  own.children = plugin_fields(table);
  const ExtraFieldsOf common_keys = [&](const Field& field, const Node& object, Problems&) {
    return ExtraFields{{}, object.pointer == section.pointer || field.name == union_part_field};
  };
  Node copy = section;
  Problems missing;
  check_fields(copy, own, missing, common_keys);
  return missing.empty();
}

/// Stands for an optimizer that no library has: it has no fields of its own.
const PluginTable& callers_table()
{
  static const PluginTable table = [] {
    PluginTable t{};
    t.kind = PluginKind::optimizer;
    t.id = callers_optimizer;
    t.fields = [](std::vector<Field>&) {};
    return t;
  }();
  return table;
}

}  // namespace

Node PluginResolver::located(const Node& section, const PluginTable& table) const
{
  Node copy = section;
  for (const Field& field : plugin_fields(table)) {
    if (field.kind != Field::Kind::string || field.unit != "file") continue;
    for (auto& [key, value] : copy.members) {
      if (key != field.name) continue;
      const std::string written = value.string;
      // An absolute path stays as it is.
      value.string = (std::filesystem::path(folder_) / written).string();
      if (files_) files_(written, value.string);
    }
  }
  return copy;
}

template <class Factory>
auto PluginResolver::make_guarded(const Node& section, const PluginTable* table, Problems& problems,
                                  const Factory& factory) -> decltype(factory(section))
{
  if (table == nullptr) return nullptr;
  try {
    if (is_intact(section, *table)) return factory(located(section, *table));
  } catch (const InputError& error) {
    problems.add(section, error.what());
  } catch (const PluginError& error) {
    problems.add(section, error.what());
  }
  return nullptr;
}

const PluginResolver::Found& PluginResolver::look_up(PluginKind kind, const std::string& id)
{
  const auto key = std::make_pair(kind, id);
  const auto known = found_.find(key);
  if (known != found_.end()) return known->second;
  Found found;
  if (kind == PluginKind::shape && id == union_table().id) {
    found.table = &union_table();
    return found_.emplace(key, std::move(found)).first->second;
  }
  if (kind == PluginKind::optimizer && id == callers_optimizer) {
    if (callers_optimizer_ != nullptr) found.table = &callers_table();
    found.error =
        "'caller' is an optimizer that a program brings which runs the experiment, as run(optimizer=...) of "
        "Python does";
    return found_.emplace(key, std::move(found)).first->second;
  }
  found.table = lookup_(kind, id, found.error);
  if (found.table == nullptr && found.error.empty()) found.error = "no plugin '" + id + "'";
  return found_.emplace(key, std::move(found)).first->second;
}

const PluginTable* PluginResolver::find(const Node& section, PluginKind kind, const char* key)
{
  const Node* id = section.find(key);
  return id != nullptr && id->is(Node::Type::string) ? look_up(kind, id->string).table : nullptr;
}

ExtraFields PluginResolver::extra_fields(const Field& field, const Node& object, Problems& problems)
{
  const std::optional<PluginSection> section = plugin_section(field);
  if (!section) return {};
  const Node* id = object.find(section->key);
  if (id == nullptr || !id->is(Node::Type::string))
    return {{}, true};  // reported as missing or of wrong type
  const Found& found = look_up(section->kind, id->string);
  if (found.table == nullptr) {
    problems.add(*id, found.error);
    return {{}, true};
  }
  const bool part = field.name == union_part_field;
  if (part && found.table == &union_table()) {
    problems.add(*id, "a part cannot be a union itself: list its parts beside this one");
    return {{}, true};
  }
  try {
    std::vector<Field> fields = plugin_fields(*found.table);
    const std::string unfit = part ? unfit_for_parts(fields) : "";
    if (unfit.empty()) return {std::move(fields), false};
    problems.add(*id, "shape '" + id->string + "' cannot be a part: " + unfit);
    return {{}, true};
  } catch (const PluginError& error) {
    problems.add(*id, error.what());
    return {{}, true};
  }
}

std::shared_ptr<const Shape> PluginResolver::shape(const Node& section, Problems& problems)
{
  const PluginTable* table = find(section, PluginKind::shape, "shape");
  if (table != &union_table()) return part(section, problems);
  return make_guarded(section, table, problems, [&](const Node& own) {
    return make_union(
        own, [&](const Node& of) { return part(of, problems); }, problems);
  });
}

std::shared_ptr<const Shape> PluginResolver::part(const Node& section, Problems& problems)
{
  const PluginTable* table = find(section, PluginKind::shape, "shape");
  if (table == &union_table()) return nullptr;  // a union in a union, which has been reported
  return make_guarded(section, table, problems,
                      [&](const Node& own) { return make_shape(*table, own, problems); });
}

std::shared_ptr<const LoadCase> PluginResolver::load_case(const Node& section, double length,
                                                          Problems& problems)
{
  const PluginTable* table = find(section, PluginKind::load_case, "plugin");
  return make_guarded(section, table, problems,
                      [&](const Node& own) { return make_load_case(*table, own, length, problems); });
}

std::shared_ptr<const Optimizer> PluginResolver::optimizer(const Node& section, Problems& problems)
{
  const PluginTable* table = find(section, PluginKind::optimizer, "plugin");
  if (table == &callers_table()) return callers_optimizer_;
  return make_guarded(section, table, problems,
                      [&](const Node& own) { return make_optimizer(*table, own, problems); });
}

}  // namespace hauberk
