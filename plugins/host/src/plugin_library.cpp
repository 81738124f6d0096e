#include "elf.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/child.hpp>
#include <hauberk/host/floating_point.hpp>
#include <hauberk/host/handshake.hpp>
#include <hauberk/host/plugin_library.hpp>
#include <hauberk/host/process_state.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/dll/shared_library.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>

namespace hauberk {
namespace {

namespace fs = std::filesystem;
/// What a library exports: the table of its plugin, or a list of those of several.
constexpr const char* entry_name = "hauberk_plugin";
constexpr const char* list_name = "hauberk_plugins";

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args)
{
  throw PluginError(fmt::format(format, std::forward<Args>(args)...));
}

void check_is_file(const fs::path& file)
{
  std::error_code error, ignored;
  const fs::file_status link = fs::symlink_status(file, ignored);
  const fs::file_status status = fs::status(file, error);
  if (fs::is_symlink(link) && status.type() == fs::file_type::not_found) {
    fail("plugin '{}' is a link to '{}', which does not exist; remove or mend it", file.native(),
         fs::read_symlink(file, ignored).native());
  }
  if (status.type() == fs::file_type::none) {
    fail("plugin '{}' cannot be looked at: {}; mend links and the permissions of its folders", file.native(),
         error.message());
  }
  if (!fs::exists(status)) fail("plugin '{}' does not exist", file.native());
  if (fs::is_directory(status)) fail("plugin '{}' is a folder; expected a shared library", file.native());
  // Opening a pipe would wait for somebody to write to it.
  if (!fs::is_regular_file(status)) fail("plugin '{}' is no file; expected a shared library", file.native());
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) {
    fail("plugin '{}' cannot be read: {}; mend its permissions", file.native(),
         std::generic_category().message(errno));
  }
  ::close(fd);
}

bool exports(const ElfSummary& elf, const char* name)
{
  return std::find(elf.exported.begin(), elf.exported.end(), name) != elf.exported.end();
}

/// Everything that can be decided without running the library's constructors. In particular a library built
/// with a sanitizer this program lacks would end the program as soon as it is loaded.
ElfSummary check_contents(const fs::path& file)
{
  const ElfSummary elf = read_elf(file);
  if (!elf.elf) fail("plugin '{}' is not a shared library; build it with hauberk_add_plugin", file.native());
  // The loader would map what is not there, and the program would end at the first touch.
  if (elf.damaged) fail("plugin '{}' is incomplete; build or copy it again", file.native());
  if (!elf.this_machine) {
    fail("plugin '{}' was built for another kind of processor than this program; rebuild it here",
         file.native());
  }
  if (!elf.tables) return elf;  // stripped of its section table: the loader decides

  const bool has_entry = exports(elf, entry_name), has_list = exports(elf, list_name);
  if (has_entry && has_list)
    fail("plugin '{}' exports both '{}' and '{}'; leave one of them", file.native(), entry_name, list_name);
  if (!has_entry && !has_list) {
    fail(
        "plugin '{}' does not export '{}'; expected one constant hauberk::PluginTable of that name, marked "
        "HAUBERK_EXPORT",
        file.native(), entry_name);
  }
  // As far as the file shows it: a program with a sanitizer brings its runtime along.
  Handshake found = program_handshake();
  for (const std::string& library : elf.needed) {
    if (library.starts_with("libasan.")) found.sanitizers = "address";
    if (library.starts_with("libtsan.")) found.sanitizers = "thread";
  }
  check_handshake(found, file);
  return elf;
}

/// What the system's loader said, without Boost's wrapping.
std::string loader_message(const std::string& what)
{
  constexpr std::string_view open = "dlerror system message: ";
  const std::size_t begin = what.find(open);
  const std::size_t end = what.rfind("): ");
  if (begin == std::string::npos || end == std::string::npos) return what;
  return what.substr(begin + open.size(), end - begin - open.size());
}

/// Where the exported constants are; null: there is none of that name.
struct Entries {
  const void* table = nullptr;
  const void* const* list = nullptr;  ///< of tables; null ends it
};

Entries load_entries(const fs::path& file)
{
  using namespace boost::dll;
  // RTLD_NODELETE: the destructor of `library` leaves the plugin in memory.
  const auto mode = static_cast<load_mode::type>(load_mode::rtld_now | load_mode::rtld_local | RTLD_NODELETE);
  try {
    const shared_library library(file, mode);
    Entries found;
    if (library.has(entry_name)) found.table = &library.get<const char>(entry_name);
    if (library.has(list_name)) found.list = &library.get<const void* const>(list_name);
    return found;
  } catch (const std::system_error& error) {
    fail("plugin '{}' cannot be loaded: {}", file.native(), loader_message(error.what()));
  }
}

/// A constructor that throws, crashes or never returns would end the program, and nothing could be said. So
/// libraries that have any besides the compiler's own are loaded by a child process first.
void try_constructors(const fs::path& file, const ElfSummary& elf)
{
  constexpr double seconds = 5.0;  // loading takes milliseconds; a busy machine is a hundred times slower
  if (elf.tables && elf.constructors <= 1) return;
  const auto load = [&]() -> std::string {
    try {
      load_entries(file);
    } catch (const PluginError&) {
      return "refused";  // it will be again, with the reason
    }
    return "loaded";
  };
  Child child;
  try {
    child = in_child(load, seconds);
  } catch (const ComputationError& error) {
    fail("plugin '{}' cannot be tried: {}", file.native(), error.what());
  }
  if (!child.returned) {
    fail("plugin '{}' cannot be loaded: its static constructors {}; a plugin must not have any with effects",
         file.native(), child.ending);
  }
}

/// The handshake is at the start of a table; nothing behind it is looked at before it agrees.
const PluginTable* checked(const void* entry, const fs::path& file, int number)
{
  check_handshake(*static_cast<const Handshake*>(entry), file, number);
  const auto* table = static_cast<const PluginTable*>(entry);
  check_table(*table, file, number);
  return table;
}

/// Of addresses of anything; nothing is read there.
bool in_one_library(const void* a, const void* b)
{
  Dl_info of_a{}, of_b{};
  return ::dladdr(a, &of_a) != 0 && ::dladdr(b, &of_b) != 0 && of_a.dli_fbase == of_b.dli_fbase;
}

std::vector<const PluginTable*> checked_list(const void* const* list, const fs::path& file)
{
  std::vector<const PluginTable*> tables;
  for (; *list != nullptr; ++list) {
    const int number = static_cast<int>(tables.size()) + 1;
    if (!in_one_library(*list, list))
      fail("plugin '{}': part {} of its '{}' is no table of this library; make the list by HAUBERK_PLUGINS",
           file.native(), number, list_name);
    const PluginTable* table = checked(*list, file, number);
    for (std::size_t k = 0; k < tables.size(); ++k) {
      if (std::string_view(tables[k]->id) == table->id)
        fail("plugin '{}' has two plugins '{}' (tables {} and {}); give each an id of its own", file.native(),
             table->id, k + 1, number);
    }
    tables.push_back(table);
  }
  if (tables.empty()) fail("plugin '{}': its '{}' is empty; name a table in it", file.native(), list_name);
  return tables;
}

}  // namespace

bool PluginLibrary::has_several(const fs::path& file)
{
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && exports(read_elf(file), list_name);
}

const PluginTable& PluginLibrary::table(std::string_view id) const
{
  std::vector<std::string> known;
  for (const PluginTable* table : tables_) {
    if (table->id == id || (id.empty() && tables_.size() == 1)) return *table;
    known.push_back(fmt::format("'{}'", table->id));
  }
  throw InputError(id.empty() ? fmt::format("plugin '{}' has several plugins, {}; name one of them",
                                            file_.native(), fmt::join(known, ", "))
                              : fmt::format("plugin '{}' has no plugin '{}', but {}", file_.native(), id,
                                            fmt::join(known, ", ")));
}

PluginLibrary PluginLibrary::load(const fs::path& file)
{
  const fs::path path = fs::absolute(file).lexically_normal();
  check_is_file(path);
  try_constructors(path, check_contents(path));

  const ProcessState state;
  const FloatingPointMode before = floating_point_mode();
  const Entries entries = load_entries(path);
  const FloatingPointMode after = floating_point_mode();
  set_floating_point_mode(before);
  const std::string changed = state.restore();
  if (after != before) {
    fail("plugin '{}' changed the floating-point mode ({}) when it was loaded; build it without -ffast-math",
         path.native(), describe_change(before, after));
  }
  if (!changed.empty()) {
    fail(
        "plugin '{}' changed the state of the process ({}) when it was loaded; a plugin must not have static "
        "constructors with effects",
        path.native(), changed);
  }
  if (entries.table) return {path, {checked(entries.table, path, 0)}};
  if (entries.list) return {path, checked_list(entries.list, path)};
  fail("plugin '{}' does not export '{}'", path.native(), entry_name);
}

}  // namespace hauberk
