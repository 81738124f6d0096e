#include <hauberk/conformance/isolated.hpp>
#include <hauberk/error.hpp>
#include <hauberk/host/child.hpp>
#include <hauberk/host/plugin_library.hpp>
#include <hauberk/host/registry.hpp>

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
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

Outcome unpacked(const std::string& bytes)
{
  std::vector<std::string> parts;
  for (std::size_t at = 1, end = 0; (end = bytes.find('\0', at)) != std::string::npos; at = end + 1)
    parts.push_back(bytes.substr(at, end - at));
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
        const PluginTable& table = PluginLibrary::load(file).table();
        return packed(run(check, table, conditions.setup, seed));
      },
      limits_of(conditions.seconds));
  if (child.out_of_time) return {Outcome::Status::slow, child.ending};
  if (!child.returned) return {Outcome::Status::failed, child.ending};
  return unpacked(child.text);
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

/// A check with one seed after the other, until it does not pass.
Result with_seeds(const Check& check, const std::filesystem::path& file, const Conditions& conditions)
{
  Result result{check.name, check.about, {}};
  for (int k = 0; k < conditions.seeds; ++k) {
    result.seed = conditions.seed + static_cast<std::uint64_t>(k);
    result.outcome = conditions.in_process
                         ? run(check, PluginLibrary::load(file).table(), conditions.setup, result.seed)
                         : outcome_in_child(check, file, conditions, result.seed);
    if (result.outcome.status != Outcome::Status::passed) break;
  }
  return result;
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
  report.seeds = conditions.seeds;
  const auto start = Clock::now();
  const Identity identity =
      conditions.in_process ? identify(file) : identify_in_child(file, conditions.seconds);
  if (!identity.error.empty()) {
    report.results.push_back({"load",
                              "the library can be loaded and its table agrees with this program",
                              {Outcome::Status::failed, identity.error},
                              conditions.seed,
                              seconds_since(start)});
    return report;
  }
  report.id = identity.id;
  report.version = identity.version;
  report.kind = with_article(identity.kind);
  for (const Check& check : matching(checks(identity.kind), conditions.filter)) {
    const auto begin = Clock::now();
    report.results.push_back(with_seeds(check, file, conditions));
    report.results.back().seconds = seconds_since(begin);
    if (conditions.until_failure && !report.passed()) break;
  }
  return report;
}

}  // namespace hauberk::conformance
