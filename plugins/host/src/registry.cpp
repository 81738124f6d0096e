#include <hauberk/error.hpp>
#include <hauberk/host/registry.hpp>
#include <hauberk/suggestion.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <system_error>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

bool well_formed(std::string_view id)
{
  return !id.empty() && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

/// Files of a folder that would be plugins, sorted; nothing if the folder cannot be read.
std::vector<fs::path> library_files(const fs::path& folder)
{
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == ".so") files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// A link that leads nowhere counts: it is reported rather than passed over.
bool present(const fs::path& file)
{
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

std::string plain(PluginKind kind)
{
  std::string text = with_article(kind);
  return text.substr(text.find(' ') + 1);
}

}  // namespace

std::string with_article(PluginKind kind)
{
  switch (kind) {
    case PluginKind::shape:
      return "a shape";
    case PluginKind::load_case:
      return "a load case";
    case PluginKind::optimizer:
      return "an optimizer";
  }
  return "a plugin";
}

Registry::Registry(std::vector<fs::path> directories) : directories_(std::move(directories)) {}

const Registry::Loaded& Registry::load(const fs::path& file) const
{
  const std::lock_guard lock(mutex_);
  const auto [it, is_new] = loaded_.try_emplace(file);
  if (is_new) {
    try {
      it->second.table = &PluginLibrary::load(file).table();
    } catch (const PluginError& error) {
      it->second.problem = error.what();
    } catch (...) {
      loaded_.erase(it);  // nothing is known of it, so that the next one who asks tries again
      throw;
    }
  }
  return it->second;
}

std::vector<PluginEntry> Registry::list() const
{
  std::vector<PluginEntry> entries;
  std::map<std::string, fs::path> first;
  for (const fs::path& folder : directories_) {
    for (const fs::path& file : library_files(folder)) {
      PluginEntry entry;
      entry.id = file.stem().native();
      entry.file = file;
      const auto [it, is_first] = first.try_emplace(entry.id, file);
      if (is_first) {
        const Loaded& loaded = load(file);
        entry.table = loaded.table;
        entry.problem = loaded.problem;
      } else {
        entry.shadowed_by = it->second;
      }
      entries.push_back(std::move(entry));
    }
  }
  return entries;
}

const PluginTable& Registry::find(PluginKind kind, std::string_view id) const
{
  if (!well_formed(id)) {
    throw InputError(fmt::format("'{}' is not a plugin id; expected letters, digits, '_' and '-'", id));
  }
  for (const fs::path& file : files(id)) {
    const Loaded& loaded = load(file);
    if (!loaded.table) throw InputError(loaded.problem);
    if (loaded.table->kind != kind) {
      throw InputError(
          fmt::format("'{}' is {}, not {}", id, with_article(loaded.table->kind), with_article(kind)));
    }
    return *loaded.table;
  }
  report_missing(kind, id);
}

std::vector<fs::path> Registry::files(std::string_view id) const
{
  std::vector<fs::path> out;
  for (const fs::path& folder : directories_) {
    fs::path file = folder / (std::string(id) + ".so");
    if (well_formed(id) && present(file)) out.push_back(std::move(file));
  }
  return out;
}

void Registry::report_missing(PluginKind kind, std::string_view id) const
{
  std::vector<std::string> known;
  for (const PluginEntry& entry : list()) {
    if (entry.table && entry.table->kind == kind) known.push_back(entry.id);
  }
  std::string message = fmt::format("no {} '{}' found", plain(kind), id);
  message += suggestion(id, known);
  std::vector<std::string> searched;
  for (const fs::path& folder : directories_) searched.push_back(folder.native());
  message += fmt::format(" (searched: {})", fmt::join(searched, ", "));
  throw InputError(message);
}

}  // namespace hauberk
