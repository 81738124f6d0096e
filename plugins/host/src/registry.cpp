#include <hauberk/error.hpp>
#include <hauberk/host/handshake.hpp>
#include <hauberk/host/registry.hpp>
#include <hauberk/suggestion.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <system_error>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

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

const PluginTable* Registry::Loaded::find(std::string_view id) const
{
  const auto found = std::find_if(tables.begin(), tables.end(), [id](const auto* t) { return t->id == id; });
  return found == tables.end() ? nullptr : *found;
}

std::string Registry::Loaded::why_not(const fs::path& file, std::string_view id) const
{
  return tables.empty() ? problem : fmt::format("plugin '{}' has no plugin '{}'", file.native(), id);
}

const Registry::Loaded& Registry::load(const fs::path& file) const
{
  const std::lock_guard lock(mutex_);
  const auto [it, is_new] = loaded_.try_emplace(file);
  if (is_new) {
    try {
      const PluginLibrary library = PluginLibrary::load(file);
      it->second.tables.assign(library.tables().begin(), library.tables().end());
    } catch (const PluginError& error) {
      it->second.problem = error.what();
    } catch (...) {
      loaded_.erase(it);  // nothing is known of it, so that the next one who asks tries again
      throw;
    }
  }
  return it->second;
}

const std::vector<fs::path>& Registry::lists(const fs::path& folder) const
{
  const std::lock_guard lock(mutex_);
  const auto [it, is_new] = lists_.try_emplace(folder);
  if (is_new) {
    it->second = library_files(folder);
    std::erase_if(it->second, [](const fs::path& file) { return !PluginLibrary::has_several(file); });
  }
  return it->second;
}

std::vector<PluginEntry> Registry::entries_in(const fs::path& folder) const
{
  std::vector<PluginEntry> entries;
  const std::vector<fs::path>& several = lists(folder);
  for (const fs::path& file : library_files(folder))
    if (!std::binary_search(several.begin(), several.end(), file))
      entries.push_back({file.stem().native(), file});
  for (const fs::path& file : several) {
    const Loaded& loaded = load(file);
    if (loaded.tables.empty()) entries.push_back({file.stem().native(), file, nullptr, loaded.problem});
    for (const PluginTable* table : loaded.tables) entries.push_back({table->id, file, table});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const PluginEntry& a, const PluginEntry& b) { return a.id < b.id; });
  return entries;
}

std::vector<PluginEntry> Registry::list() const
{
  std::vector<PluginEntry> entries;
  std::map<std::string, fs::path> first;
  for (const fs::path& folder : directories_) {
    for (PluginEntry& entry : entries_in(folder)) {
      if (entry.problem.empty()) {  // of a library of several nobody knows what it would have had
        const auto [it, is_first] = first.try_emplace(entry.id, entry.file);
        if (!is_first) {
          entry.table = nullptr;
          entry.shadowed_by = it->second;
        } else if (!entry.table) {
          const Loaded& loaded = load(entry.file);
          entry.table = loaded.find(entry.id);
          if (!entry.table) entry.problem = loaded.why_not(entry.file, entry.id);
        }
      }
      entries.push_back(std::move(entry));
    }
  }
  return entries;
}

const PluginTable& Registry::find(PluginKind kind, std::string_view id) const
{
  if (!well_formed_id(id)) {
    throw InputError(fmt::format("'{}' is not a plugin id; expected letters, digits, '_' and '-'", id));
  }
  for (const fs::path& folder : directories_) {
    const std::vector<fs::path> files = files_in(folder, id, true);
    if (files.empty()) continue;
    const Loaded& loaded = load(files.front());
    const PluginTable* table = loaded.find(id);
    if (!table) throw InputError(loaded.why_not(files.front(), id));
    if (table->kind != kind) {
      throw InputError(fmt::format("'{}' is {}, not {}", id, with_article(table->kind), with_article(kind)));
    }
    return *table;
  }
  report_missing(kind, id);
}

std::vector<fs::path> Registry::files_in(const fs::path& folder, std::string_view id, bool first_only) const
{
  std::vector<fs::path> out;
  fs::path own = folder / (std::string(id) + ".so");
  const std::vector<fs::path>& several = lists(folder);
  const bool is_list = std::binary_search(several.begin(), several.end(), own);
  // A file of that name that cannot be used is reported, whatever it may have had.
  if (present(own) && (!is_list || load(own).tables.empty())) out.push_back(std::move(own));
  for (const fs::path& file : several) {
    if (first_only && !out.empty()) break;
    if (load(file).find(id)) out.push_back(file);
  }
  return out;
}

std::vector<fs::path> Registry::files(std::string_view id) const
{
  std::vector<fs::path> out;
  if (!well_formed_id(id)) return out;
  for (const fs::path& folder : directories_) {
    std::vector<fs::path> here = files_in(folder, id, false);
    std::move(here.begin(), here.end(), std::back_inserter(out));
  }
  return out;
}

void Registry::report_missing(PluginKind kind, std::string_view id) const
{
  std::vector<std::string> known, unusable;
  for (const PluginEntry& entry : list()) {
    if (entry.table && entry.table->kind == kind) known.push_back(entry.id);
    if (!entry.problem.empty() && PluginLibrary::has_several(entry.file)) unusable.push_back(entry.problem);
  }
  std::string message = fmt::format("no {} '{}' found", plain(kind), id);
  message += suggestion(id, known);
  std::vector<std::string> searched;
  for (const fs::path& folder : directories_) searched.push_back(folder.native());
  message += fmt::format(" (searched: {}; other folders with --plugin-path or HAUBERK_PLUGIN_PATH)",
                         fmt::join(searched, ", "));
  // It may be in one of these.
  for (const std::string& problem : unusable) message += "; " + problem;
  throw InputError(message);
}

}  // namespace hauberk
