#include "elf.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/child.hpp>
#include <hauberk/host/floating_point.hpp>
#include <hauberk/host/handshake.hpp>
#include <hauberk/host/plugin_library.hpp>
#include <hauberk/host/process_state.hpp>

#include <fmt/format.h>
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
constexpr const char* entry_name = "hauberk_plugin";

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

  if (std::find(elf.exported.begin(), elf.exported.end(), entry_name) == elf.exported.end()) {
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

const void* load_entry(const fs::path& file)
{
  using namespace boost::dll;
  // RTLD_NODELETE: the destructor of `library` leaves the plugin in memory.
  const auto mode = static_cast<load_mode::type>(load_mode::rtld_now | load_mode::rtld_local | RTLD_NODELETE);
  try {
    const shared_library library(file, mode);
    return library.has(entry_name) ? &library.get<const char>(entry_name) : nullptr;
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
      load_entry(file);
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

}  // namespace

PluginLibrary PluginLibrary::load(const fs::path& file)
{
  const fs::path path = fs::absolute(file).lexically_normal();
  check_is_file(path);
  try_constructors(path, check_contents(path));

  const ProcessState state;
  const FloatingPointMode before = floating_point_mode();
  const void* entry = load_entry(path);
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
  if (!entry) fail("plugin '{}' does not export '{}'", path.native(), entry_name);

  // The handshake is at the start of the table; nothing behind it is looked at before it agrees.
  check_handshake(*static_cast<const Handshake*>(entry), path);
  const auto& table = *static_cast<const PluginTable*>(entry);
  check_table(table, path);
  return {path, table};
}

}  // namespace hauberk
