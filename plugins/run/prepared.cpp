#include "run/prepared.hpp"

#include "numerics/fnv.hpp"
#include "run/nearest_node.hpp"
#include "run/presets.hpp"
#include "run/sha256.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

namespace hauberk {
namespace {

std::string kind_word(PluginKind kind)
{
  switch (kind) {
    case PluginKind::shape:
      return "shape";
    case PluginKind::load_case:
      return "load_case";
    case PluginKind::optimizer:
      return "optimizer";
  }
  return "plugin";
}

/// Looks plugins up and notes those that are used.
PluginLookup recording_lookup(const Registry& registry, std::vector<Provenance::Plugin>& used)
{
  return [&registry, &used, lookup = lookup_in(registry)](PluginKind kind, const std::string& id,
                                                          std::string& error) -> const PluginTable* {
    const PluginTable* table = lookup(kind, id, error);
    const bool known = std::any_of(used.begin(), used.end(), [&id](const auto& p) { return p.id == id; });
    if (table != nullptr && !known) {
      const std::filesystem::path file = registry.files(id).front();
      used.push_back({id, kind_word(kind), table->version, file.filename().string(), sha256_of_file(file)});
    }
    return table;
  };
}

using WeaveTexts = std::map<std::string, std::string>;

/// Looks weaves up and keeps what they hold: every variant is made of the same, whatever becomes of the file.
WeaveLookup recording_lookup(WeaveLookup weaves, std::shared_ptr<WeaveTexts> used)
{
  if (!weaves) return weaves;
  return [weaves = std::move(weaves), used = std::move(used)](
             const std::string& name, std::string& error) -> std::optional<std::string> {
    if (const auto known = used->find(name); known != used->end()) return known->second;
    std::optional<std::string> text = weaves(name, error);
    if (text) used->emplace(name, *text);
    return text;
  };
}

using Fingerprints = std::map<std::string, std::string>;

/// Length and 64-bit FNV-1a hash of a file: to notice that it was changed, not that someone hid that. Empty
/// where it cannot be read, or is no regular file, which its plugin tells.
std::string fingerprint(const std::string& path)
{
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return {};
  std::ifstream file(path, std::ios::binary);
  Fnv1a hash;
  std::uint64_t length = 0;
  for (char c = 0; file.get(c); ++length) hash.add(static_cast<unsigned char>(c));
  return file.eof() ? fmt::format("{} bytes, {:016x}", length, hash.value()) : std::string();
}

/// Takes the fingerprint of every file once.
FileObserver recording_files(std::shared_ptr<Fingerprints> files)
{
  return [files = std::move(files)](const std::string& written, const std::string& located) {
    if (!files->contains(written)) files->emplace(written, fingerprint(located));
  };
}

/// Rest state as used; problems of the cell otherwise.
void prepare_scene(Prepared& prepared, Diagnostics& diagnostics)
{
  const Experiment& e = prepared.experiment;
  std::vector<std::string> problems;
  try {
    static_cast<SceneAtRest&>(prepared) = scene_at_rest(e, problems);
  } catch (const InputError& error) {
    problems.emplace_back(error.what());
  } catch (const ComputationError& error) {  // not even the rest state can be computed
    problems.emplace_back(error.what());
  }
  for (const std::string& problem : problems)
    diagnostics.problems.add(nearest_node(e.resolved, "/cell"), problem);
}

}  // namespace

PluginLookup lookup_in(const Registry& registry)
{
  return [&registry](PluginKind kind, const std::string& id, std::string& error) -> const PluginTable* {
    try {
      return &registry.find(kind, id);
    } catch (const InputError& problem) {
      error = problem.what();
      return nullptr;
    }
  };
}

std::vector<std::string> macro_names(const LoadCase& load_case)
{
  std::vector<std::string> out;
  for (const MacroInfo& macro : load_case.macros()) out.push_back(macro.name);
  return out;
}

std::unique_ptr<const Prepared> prepare_experiment(
    std::shared_ptr<const Registry> registry, const ExperimentSource& source,
    const std::function<void(const Prepared&, Diagnostics&)>& then)
{
  auto out = std::make_unique<Prepared>();
  Prepared& prepared = *out;
  prepared.registry = std::move(registry);
  prepared.lookup = recording_lookup(*prepared.registry, prepared.plugins);
  Diagnostics diagnostics;
  const auto stop_on_problems = [&diagnostics] {
    if (!diagnostics.empty()) throw ReportedProblems(diagnostics);
  };
  const auto weaves = std::make_shared<WeaveTexts>();
  const auto files = std::make_shared<Fingerprints>();
  std::optional<Experiment> experiment =
      read_experiment({source.file, source.text, source.overrides, recording_lookup(source.weaves, weaves),
                       recording_files(files), source.formats, source.optimizer},
                      prepared.lookup, diagnostics);
  stop_on_problems();
  prepared.experiment = std::move(experiment.value());
  const Experiment& e = prepared.experiment;
  for (const Problem& problem : solver_problems(e))
    diagnostics.problems.add(nearest_node(e.resolved, problem.pointer), problem.message);
  if (meshes_without_contact(e)) stop_on_problems();  // the scene would say so again
  prepare_scene(prepared, diagnostics);
  stop_on_problems();
  then(prepared, diagnostics);
  stop_on_problems();
  if (e.has_variants) prepared.weaves.assign(weaves->begin(), weaves->end());
  prepared.files.assign(files->begin(), files->end());
  return out;
}

}  // namespace hauberk
