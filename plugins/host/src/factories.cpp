#include "guarded.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/factories.hpp>
#include <hauberk/host/guard.hpp>

#include <fmt/format.h>

namespace hauberk {
namespace {

/// Runs a factory, and holds it to its contract: null only together with a problem.
template <class Make>
auto make(const PluginTable& table, const char* call, Problems& problems, Make&& factory)
    -> decltype(factory())
{
  const std::size_t before = problems.list().size();
  auto object = Guard(table.id).with_process_state(call, std::forward<Make>(factory));
  if (problems.list().size() > before) return nullptr;  // made or not, the section is wrong
  if (!object) {
    throw PluginError(
        fmt::format("plugin '{}': {} returned nothing and reported no problem", table.id, call));
  }
  return object;
}

}  // namespace

std::vector<Field> plugin_fields(const PluginTable& table)
{
  std::vector<Field> fields;
  Guard(table.id).with_process_state("fields", [&] { table.fields(fields); });
  return fields;
}

std::unique_ptr<Shape> make_shape(const PluginTable& table, const Node& section, Problems& problems)
{
  auto shape = make(table, "make_shape", problems, [&] { return table.make_shape(section, problems); });
  return shape ? guard_shape(std::move(shape), Guard(table.id)) : nullptr;
}

std::unique_ptr<LoadCase> make_load_case(const PluginTable& table, const Node& section, double length,
                                         Problems& problems)
{
  auto load_case = make(table, "make_load_case", problems,
                        [&] { return table.make_load_case(section, length, problems); });
  return load_case ? guard_load_case(std::move(load_case), Guard(table.id)) : nullptr;
}

std::unique_ptr<Optimizer> make_optimizer(const PluginTable& table, const Node& section, Problems& problems)
{
  auto optimizer =
      make(table, "make_optimizer", problems, [&] { return table.make_optimizer(section, problems); });
  return optimizer ? guard_optimizer(std::move(optimizer), Guard(table.id), table) : nullptr;
}

}  // namespace hauberk
