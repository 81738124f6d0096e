#include "dispatch.hpp"
#include "document/atomic_file.hpp"
#include "experiment_options.hpp"
#include "options.hpp"
#include "say.hpp"

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/experiment/union_shape.hpp>
#include <hauberk/host/search_path.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

namespace hauberk::command {
namespace {

namespace fs = std::filesystem;

/// A template, and the kind of plugin that it is.
struct Template {
  std::string_view name, kind;
};
constexpr std::array<Template, 5> templates = {{{"shape", "shape"},
                                                {"solid", "shape"},
                                                {"load_case", "load_case"},
                                                {"patch", "load_case"},
                                                {"optimizer", "optimizer"}}};
constexpr const char* expected = "shape, solid, load_case, patch or optimizer";
/// Targets that CMake makes itself, and what classes of the interface would be called.
constexpr std::array<std::string_view, 22> taken = {
    "all",   "clean", "edit_cache", "help",      "install",   "package",       "test",  "rebuild_cache",
    "list",  "shape", "load_case",  "optimizer", "primitive", "solid",         "field", "node",
    "point", "turn",  "problems",   "direction", "about",     "parameter_info"};

/// What stands for the name in the template, and as the name of a class; for the kind and the template.
constexpr std::string_view name_mark = "plugin_name", class_mark = "PluginName", kind_mark = "plugin_kind",
                           template_mark = "plugin_template";

bool lower(char c) { return c >= 'a' && c <= 'z'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

void check_name(const std::string& name, const Registry& registry)
{
  const bool identifier =
      !name.empty() && lower(name.front()) && name.back() != '_' && name.find("__") == std::string::npos &&
      std::all_of(name.begin(), name.end(), [](char c) { return lower(c) || digit(c) || c == '_'; });
  if (!identifier) {
    throw InputError(fmt::format(
        "'{}' is no name for a plugin; expected small letters, digits and single '_', such as oval_link",
        name));
  }
  const auto has = [&name](std::string_view mark) { return name.find(mark) != std::string::npos; };
  const bool marked = has(name_mark) || has(kind_mark) || has(template_mark);
  if (std::find(taken.begin(), taken.end(), name) != taken.end() || marked)
    throw InputError(fmt::format(
        "'{}' is no name for a plugin: it means something else to CMake, or to Hauberk's headers", name));
  if (name == union_table().id)
    throw InputError(
        fmt::format("there is a shape '{}' already, which is built in; choose another name", name));
  for (const PluginEntry& entry : registry.list()) {
    if (entry.id == name)
      throw InputError(
          fmt::format("there is a plugin '{}' already ({}); choose another name", name, entry.file.string()));
  }
}

/// oval_link -> OvalLink
std::string class_name(const std::string& name)
{
  std::string out;
  bool first = true;
  for (const char c : name) {
    if (c != '_') out += first && lower(c) ? static_cast<char>(c - 'a' + 'A') : c;
    first = c == '_';
  }
  return out;
}

std::string replaced(std::string text, std::string_view from, const std::string& to)
{
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::vector<std::string> template_names()
{
  std::vector<std::string> names;
  for (const Template& t : templates) names.emplace_back(t.name);
  return names;
}

const Template& template_of(const Options& options)
{
  if (!options.has("kind")) throw UsageError("--kind is missing", options.usage());
  const auto word = options.get<std::string>("kind");
  const auto found =
      std::find_if(templates.begin(), templates.end(), [&word](const Template& t) { return t.name == word; });
  if (found == templates.end())
    throw UsageError(fmt::format("--kind: expected {}, found '{}'", expected, word), options.usage());
  return *found;
}

/// The files of the template, with the name put in.
std::vector<NamedContent> project_files(const Template& from, const std::string& name)
{
  const fs::path root = shared_data_folder() / "template";
  std::vector<NamedContent> files;
  for (const fs::path& folder : {root / "common", root / from.name}) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      const auto named = [&](std::string text) {
        text = replaced(replaced(std::move(text), name_mark, name), class_mark, class_name(name));
        text = replaced(std::move(text), kind_mark, std::string(from.kind));
        return replaced(std::move(text), template_mark, std::string(from.name));
      };
      files.push_back(
          {named(entry.path().filename().string()), named(read_text_file(entry.path().string()))});
    }
    if (error)
      throw ComputationError(fmt::format("{}: the template cannot be read: {}; install Hauberk again",
                                         folder.string(), error.message()));
  }
  std::sort(files.begin(), files.end(),
            [](const NamedContent& a, const NamedContent& b) { return a.name < b.name; });
  return files;
}

void write_project(const fs::path& folder, const std::vector<NamedContent>& files)
{
  std::error_code error;
  for (const NamedContent& file : files) {
    const fs::path path = folder / file.name;
    if (fs::exists(fs::symlink_status(path, error)))
      throw InputError(fmt::format("{}: exists already; give a folder without it", path.string()));
  }
  const bool made = fs::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("{}: this folder cannot be made: {}", folder.string(), error.message()));
  try {
    write_files_atomically(folder, files, {});
  } catch (const ComputationError&) {
    if (made) fs::remove(folder, error);
    throw;
  }
}

/// What tells CMake where Hauberk is; nothing where it looks anyway, or where it is not installed.
std::string prefix_option()
{
  const fs::path prefix = shared_data_folder().parent_path().parent_path();  // <prefix>/share/hauberk
  const bool found = prefix == "/usr" || prefix == "/usr/local" || !fs::exists(prefix / "lib/cmake/hauberk");
  return found ? "" : fmt::format(" -D CMAKE_PREFIX_PATH='{}'", prefix.string());
}

}  // namespace

Description new_description()
{
  return {
      .name = "plugins new",
      .line = "write a project to begin a plugin with",
      .synopsis = "plugins new --kind shape|solid|load_case|patch|optimizer NAME DIR",
      .summary = "Writes a small complete project of a plugin to DIR: it builds, conforms and runs as it is.",
      .more =
          "A `solid` is a shape whose surface is given by a chart and a field, a `patch` a load case "
          "that is not periodic. NAME is made of small letters, digits and single `_`, and is not that of "
          "a plugin that is found. Files that exist are refused, and all files are written or none.",
      .arguments = {{.name = "NAME"}, {.name = "DIR", .offer = Offer::folders}},
      .options = {{.name = "kind",
                   .takes = Takes::text,
                   .value = "KIND",
                   .help = expected,
                   .offer = Offer::words,
                   .choices = template_names()}}};
}

int new_command(const std::vector<std::string>& words)
{
  Options options(new_description());
  options.parse(words);
  const Template& from = template_of(options);
  const std::string& name = options.positionals()[0];
  const fs::path folder = options.positionals()[1];
  check_name(name, *open_registry(options));
  write_project(folder, project_files(from, name));
  say("{0} '{1}' is in {2}; next:\n\n  cd {2}\n  cmake -B build{3} && cmake --build build && ctest "
      "--test-dir build\n"
      "  hauberk plugins conform build/plugins/{1}.so\n"
      "  hauberk run experiment.json --plugin-path build/plugins -o out\n",
      from.name, name, folder.string(), prefix_option());
  return exit_done;
}

}  // namespace hauberk::command
