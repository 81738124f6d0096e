#include <hauberk/conformance/isolated.hpp>
#include <hauberk/error.hpp>
#include <hauberk/host/child.hpp>
#include <hauberk/host/plugin_library.hpp>
#include <hauberk/host/registry.hpp>

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace hauberk::conformance {
namespace {

using Clock = std::chrono::steady_clock;

Outcome outcome_in_child(const Check& check, const std::filesystem::path& file, const Conditions& conditions)
{
  const Child child = in_child(
      [&] {
        const PluginTable& table = PluginLibrary::load(file).table();
        const Outcome outcome = run(check, table, conditions.setup, conditions.seed);
        return static_cast<char>('0' + static_cast<int>(outcome.status)) + outcome.text;
      },
      conditions.seconds);
  if (!child.returned) return {Outcome::Status::failed, child.ending};
  return {static_cast<Outcome::Status>(child.text.front() - '0'), child.text.substr(1)};
}

/// The parts of a table that say what it is.
struct Identity {
  std::string error, id, version;
  PluginKind kind{};
};

Identity identify(const std::filesystem::path& file)
{
  try {
    const PluginTable& table = PluginLibrary::load(file).table();
    return {"", table.id, table.version, table.kind};
  } catch (const PluginError& error) {
    return {error.what(), "", "", {}};
  }
}

Identity identify_in_child(const std::filesystem::path& file, double seconds)
{
  const Child child = in_child(
      [&] {
        const Identity found = identify(file);
        return fmt::format("{}{}{}{}{}", static_cast<char>('0' + static_cast<int>(found.kind)), found.id,
                           '\0', found.version, '\0') +
               found.error;
      },
      seconds);
  Identity found;
  if (!child.returned) {
    found.error = "loading it " + child.ending;
    return found;
  }
  const std::size_t first = child.text.find('\0'), second = child.text.find('\0', first + 1);
  found.kind = static_cast<PluginKind>(child.text.front() - '0');
  found.id = child.text.substr(1, first - 1);
  found.version = child.text.substr(first + 1, second - first - 1);
  found.error = child.text.substr(second + 1);
  return found;
}

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Report conform(const std::filesystem::path& file, const Conditions& conditions)
{
  Report report;
  report.file = file.string();
  report.setup = conditions.setup;
  report.seed = conditions.seed;
  const auto start = Clock::now();
  const Identity identity =
      conditions.in_process ? identify(file) : identify_in_child(file, conditions.seconds);
  if (!identity.error.empty()) {
    report.results.push_back({"load",
                              "the library can be loaded and its table agrees with this program",
                              {Outcome::Status::failed, identity.error},
                              seconds_since(start)});
    return report;
  }
  report.id = identity.id;
  report.version = identity.version;
  report.kind = with_article(identity.kind);
  for (const Check& check : matching(checks(identity.kind), conditions.filter)) {
    const auto begin = Clock::now();
    Outcome outcome = conditions.in_process
                          ? run(check, PluginLibrary::load(file).table(), conditions.setup, conditions.seed)
                          : outcome_in_child(check, file, conditions);
    report.results.push_back({check.name, check.about, std::move(outcome), seconds_since(begin)});
  }
  return report;
}

}  // namespace hauberk::conformance
