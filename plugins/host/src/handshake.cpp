#include <hauberk/error.hpp>
#include <hauberk/host/handshake.hpp>
#include <hauberk/host/registry.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>

namespace hauberk {
namespace {

constexpr Handshake program = HAUBERK_HANDSHAKE;

constexpr std::string_view rebuild = "rebuild the plugin with this program's headers and compiler settings";

/// A text of a foreign table, which may be null.
std::string quoted(const char* text) { return text ? fmt::format("\"{}\"", text) : "nothing"; }

/// How messages begin: the file and, in a library of several plugins, which of its tables.
std::string subject(const std::filesystem::path& file, int number)
{
  return number == 0 ? fmt::format("plugin '{}'", file.native())
                     : fmt::format("plugin '{}' (table {})", file.native(), number);
}

[[noreturn]] void differs(const std::string& who, std::string_view what, const std::string& plugin,
                          const std::string& mine)
{
  throw PluginError(
      fmt::format("{} was built with {} {}, this program with {}; {}", who, what, plugin, mine, rebuild));
}

void compare(const std::string& who, std::string_view what, std::uint32_t plugin, std::uint32_t mine)
{
  if (plugin != mine) differs(who, what, std::to_string(plugin), std::to_string(mine));
}

void compare(const std::string& who, std::string_view what, const char* plugin, const char* mine)
{
  if (!plugin || std::string_view(plugin) != mine) differs(who, what, quoted(plugin), quoted(mine));
}

/// The magic bytes with what cannot be printed as a dot.
std::string printable(const char (&magic)[8])
{
  std::string text;
  for (const char c : magic) {
    if (c == '\0') break;
    text += c >= ' ' && c <= '~' ? c : '.';
  }
  return text;
}

void check_texts(const PluginTable& table, const std::string& who)
{
  const auto require = [&](const void* field, const char* name) {
    if (field) return;
    throw PluginError(fmt::format(
        "{}: '{}' is null; id, version, summary, citation and fields must all be set", who, name));
  };
  require(table.id, "id");
  require(table.version, "version");
  require(table.summary, "summary");
  require(table.citation, "citation");
  require(reinterpret_cast<const void*>(table.fields), "fields");
}

void check_id(const std::string& id, const std::filesystem::path& file, int number)
{
  if (number == 0 && file.stem() != id) {
    throw PluginError(fmt::format(
        "plugin '{}' calls itself '{}'; rename the file to '{}.so' or change the id", file.native(), id, id));
  }
  if (!well_formed_id(id)) {
    throw PluginError(fmt::format("{} calls itself '{}'; expected letters, digits, '_' and '-'",
                                  subject(file, number), id));
  }
}

void check_factories(const PluginTable& table, const std::string& who)
{
  const struct {
    PluginKind kind;
    bool set;
    const char* name;
  } factories[] = {{PluginKind::shape, table.make_shape != nullptr, "make_shape"},
                   {PluginKind::load_case, table.make_load_case != nullptr, "make_load_case"},
                   {PluginKind::optimizer, table.make_optimizer != nullptr, "make_optimizer"}};
  for (const auto& factory : factories) {
    if (factory.set == (factory.kind == table.kind)) continue;
    throw PluginError(fmt::format("{} is {} but {} '{}'; set exactly the factory of its kind", who,
                                  with_article(table.kind), factory.set ? "also sets" : "does not set",
                                  factory.name));
  }
}

}  // namespace

Handshake program_handshake() { return program; }

void check_handshake(const Handshake& plugin, const std::filesystem::path& file, int number)
{
  const std::string who = subject(file, number);
  if (std::memcmp(plugin.magic, program.magic, sizeof plugin.magic) != 0) {
    throw PluginError(
        fmt::format("{}: its {} begins with \"{}\", expected \"{}\"; it must be a constant "
                    "hauberk::PluginTable",
                    who, number == 0 ? "'hauberk_plugin'" : "part of 'hauberk_plugins'",
                    printable(plugin.magic), program.magic));
  }
  compare(who, "a plugin table of size", plugin.table_size, program.table_size);
  compare(who, "interface revision", plugin.revision, program.revision);
  compare(who, "compiler", plugin.compiler, program.compiler);
  compare(who, "standard library", plugin.standard_library, program.standard_library);
  compare(who, "Eigen", plugin.eigen, program.eigen);
  compare(who, "Eigen alignment", plugin.eigen_alignment, program.eigen_alignment);
  compare(who, "a layout of the interface's types of", plugin.layout, program.layout);
  compare(who, "sanitizers", plugin.sanitizers, program.sanitizers);
}

void check_table(const PluginTable& table, const std::filesystem::path& file, int number)
{
  const std::string who = subject(file, number);
  // Through the underlying type: the value may be none of the enumerators.
  const auto kind = static_cast<std::uint32_t>(table.kind);
  if (kind < 1 || kind > 3) {
    throw PluginError(
        fmt::format("{} is of kind {}; expected 1 (shape), 2 (load case) or 3 (optimizer)", who, kind));
  }
  check_texts(table, who);
  check_id(table.id, file, number);
  check_factories(table, who);
}

bool well_formed_id(std::string_view id)
{
  return !id.empty() && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

}  // namespace hauberk
