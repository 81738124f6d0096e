#include <hauberk/conformance/isolated.hpp>
#include <hauberk/error.hpp>
#include <hauberk/host/child.hpp>
#include <hauberk/host/plugin_library.hpp>
#include <hauberk/host/registry.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

namespace hauberk::conformance {
namespace {

using Clock = std::chrono::steady_clock;

/// What sleeps, or waits for itself, is ended after this much more than the processor time it may use.
TimeLimits limits_of(double seconds) { return {.processor = seconds, .elapsed = 4.0 * seconds + 5.0}; }

/// An outcome through a pipe: its status, then text, names and times, each ended by a zero.
std::string packed(const Outcome& outcome)
{
  std::string out = static_cast<char>('0' + static_cast<int>(outcome.status)) + outcome.text + '\0';
  for (const auto& [name, seconds] : outcome.times)
    out += fmt::format("{}{}{:.17g}{}", name, '\0', seconds, '\0');
  return out;
}

/// The texts from a place on, each of which is ended by a zero.
std::vector<std::string> texts(const std::string& bytes, std::size_t at)
{
  std::vector<std::string> out;
  for (std::size_t end = 0; (end = bytes.find('\0', at)) != std::string::npos; at = end + 1)
    out.push_back(bytes.substr(at, end - at));
  return out;
}

Outcome unpacked(const std::string& bytes)
{
  const std::vector<std::string> parts = texts(bytes, 1);
  Outcome outcome{static_cast<Outcome::Status>(bytes.front() - '0'), parts.at(0)};
  for (std::size_t k = 1; k + 1 < parts.size(); k += 2)
    outcome.times.emplace_back(parts[k], std::strtod(parts[k + 1].c_str(), nullptr));
  return outcome;
}

Outcome outcome_in_child(const Check& check, const std::filesystem::path& file, const Conditions& conditions,
                         std::uint64_t seed)
{
  const Child child = in_child(
      [&] {
        const PluginTable& table = PluginLibrary::load(file).table(conditions.plugin);
        return packed(run(check, table, conditions.setup, seed));
      },
      limits_of(conditions.seconds));
  if (child.out_of_time) return {Outcome::Status::slow, child.ending};
  if (!child.returned) return {Outcome::Status::failed, child.ending};
  return unpacked(child.text);
}

/// The parts of a table that say what it is.
struct Identity {
  std::string id, version;
  PluginKind kind{};
};

/// Those of a library, or why it cannot be used.
struct Contents {
  std::string error;
  std::vector<Identity> plugins;
};

Contents look_into(const std::filesystem::path& file)
{
  Contents found;
  try {
    const PluginLibrary library = PluginLibrary::load(file);
    for (const PluginTable* table : library.tables())
      found.plugins.push_back({table->id, table->version, table->kind});
  } catch (const PluginError& error) {
    found.error = error.what();
  }
  return found;
}

/// Through a pipe go texts that are ended by a zero: the error, then id, version and kind of each plugin.
Contents look_into_in_child(const std::filesystem::path& file, double seconds)
{
  const Child child = in_child(
      [&] {
        const Contents found = look_into(file);
        std::string out = found.error + '\0';
        for (const Identity& p : found.plugins)
          out += p.id + '\0' + p.version + '\0' + static_cast<char>('0' + static_cast<int>(p.kind)) + '\0';
        return out;
      },
      seconds);
  if (!child.returned) return {"loading it " + child.ending, {}};
  const std::vector<std::string> parts = texts(child.text, 0);
  Contents found{parts.at(0), {}};
  for (std::size_t k = 1; k + 2 < parts.size(); k += 3)
    found.plugins.push_back({parts[k], parts[k + 1], static_cast<PluginKind>(parts[k + 2].at(0) - '0')});
  return found;
}

/// A check with one seed after the other, until it does not pass.
Result with_seeds(const Check& check, const std::filesystem::path& file, const Conditions& conditions)
{
  Result result{check.name, check.about, {}};
  for (int k = 0; k < conditions.seeds; ++k) {
    result.seed = conditions.seed + static_cast<std::uint64_t>(k);
    result.outcome = conditions.in_process ? run(check, PluginLibrary::load(file).table(conditions.plugin),
                                                 conditions.setup, result.seed)
                                           : outcome_in_child(check, file, conditions, result.seed);
    if (result.outcome.status != Outcome::Status::passed) break;
  }
  return result;
}

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What the conditions say of a report on this file.
Report begun(const std::filesystem::path& file, const Conditions& conditions)
{
  Report report;
  report.file = file.string();
  report.setup = conditions.setup;
  report.seed = conditions.seed;
  report.seeds = conditions.seeds;
  return report;
}

/// Why a library could not be loaded, or has not the plugin that is asked for.
Report not_loaded(Report report, const std::string& why, double seconds)
{
  report.results.push_back({"load",
                            "the library can be loaded and its table agrees with this program",
                            {Outcome::Status::failed, why},
                            report.seed,
                            seconds});
  return report;
}

Report conform_one(Report report, const Identity& identity, const Conditions& conditions)
{
  const std::filesystem::path file = report.file;
  report.id = identity.id;
  report.version = identity.version;
  report.kind = with_article(identity.kind);
  const std::vector<Check> all = matching(checks(identity.kind), conditions.filter);
  for (const Check& check : all) {
    if (conditions.on_check) conditions.on_check(check.name, report.results.size(), all.size());
    const auto begin = Clock::now();
    report.results.push_back(with_seeds(check, file, conditions));
    report.results.back().seconds = seconds_since(begin);
    if (conditions.until_failure && !report.passed()) break;
  }
  return report;
}

Contents contents_of(const std::filesystem::path& file, const Conditions& conditions)
{
  return conditions.in_process ? look_into(file) : look_into_in_child(file, conditions.seconds);
}

std::string ids_of(const Contents& contents)
{
  std::vector<std::string> ids;
  for (const Identity& identity : contents.plugins) ids.push_back(identity.id);
  return fmt::format("{}", fmt::join(ids, ", "));
}

/// The reports of the plugins that a library has and the conditions name.
std::vector<Report> conform_contents(Report report, const Contents& contents, const Conditions& conditions,
                                     Clock::time_point start)
{
  std::vector<Report> reports;
  std::optional<InputError> unmatched;
  report.one_of_several = contents.plugins.size() > 1;
  Conditions named = conditions;
  for (const Identity& identity : contents.plugins) {
    named.plugin = identity.id;
    if (!conditions.plugin.empty() && conditions.plugin != identity.id) continue;
    try {
      reports.push_back(conform_one(report, identity, named));
    } catch (const InputError& error) {
      unmatched = error;
    }
  }
  if (reports.empty() && unmatched) throw *unmatched;
  if (reports.empty()) {
    const std::string why = fmt::format("it has no plugin '{}', but {}", conditions.plugin, ids_of(contents));
    reports.push_back(not_loaded(report, why, seconds_since(start)));
  }
  return reports;
}

}  // namespace

std::vector<Report> conform_all(const std::filesystem::path& file, const Conditions& conditions)
{
  const auto start = Clock::now();
  const Contents contents = contents_of(file, conditions);
  Report report = begun(file, conditions);
  if (!contents.error.empty()) return {not_loaded(report, contents.error, seconds_since(start))};
  return conform_contents(std::move(report), contents, conditions, start);
}

Report conform(const std::filesystem::path& file, const Conditions& conditions)
{
  const auto start = Clock::now();
  const Contents contents = contents_of(file, conditions);
  Report report = begun(file, conditions);
  if (!contents.error.empty()) return not_loaded(report, contents.error, seconds_since(start));
  if (contents.plugins.size() > 1 && conditions.plugin.empty()) {
    return not_loaded(report, fmt::format("it has several plugins, {}; name one of them", ids_of(contents)),
                      seconds_since(start));
  }
  return std::move(conform_contents(std::move(report), contents, conditions, start).front());
}

}  // namespace hauberk::conformance
