#include "document/json_writer.hpp"

#include <hauberk/conformance/report.hpp>
#include <hauberk/version.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace hauberk::conformance {
namespace {

using Status = Outcome::Status;

/// A text as one word of a shell.
std::string quoted(const std::string& text)
{
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string again(const Report& report, const Result& result)
{
  std::string text = fmt::format("hauberk plugins conform {} --seed {}", quoted(report.file), result.seed);
  if (report.one_of_several) text += " --plugin " + quoted(report.id);
  if (!report.setup.section.empty()) text += " --section " + quoted(report.setup.section);
  return result.name == "load" ? text : fmt::format("{} --filter '^{}$'", text, result.name);
}

bool is_wrong(const Result& result)
{
  return result.outcome.status == Status::failed || result.outcome.status == Status::slow;
}

/// What is wrong without its numbers and without where it was found: checks that say the same have met the
/// same cause.
std::string cause(const Result& result)
{
  std::string out;
  const std::string text = result.outcome.text.substr(0, result.outcome.text.find(" (parameters: "));
  for (const char c : text) {
    const bool number = (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
    if (!number) out += c;
  }
  return out;
}

/// The results that are wrong, those of one cause together, in the order of the first of each.
std::vector<std::vector<const Result*>> causes(const std::vector<Result>& results)
{
  std::vector<std::vector<const Result*>> out;
  for (const Result& r : results) {
    if (!is_wrong(r)) continue;
    const auto known = std::find_if(out.begin(), out.end(), [&r](const auto& group) {
      return group.front()->outcome.status == r.outcome.status && cause(*group.front()) == cause(r);
    });
    if (known != out.end()) {
      known->push_back(&r);
    } else {
      out.push_back({&r});
    }
  }
  return out;
}

/// "primitives 1.2 us, jacobians 3.4 us".
std::string times_text(const std::vector<Result>& results)
{
  std::string out;
  for (const Result& r : results) {
    for (const auto& [name, seconds] : r.outcome.times)
      out += fmt::format("{}{} {:.3g} us", out.empty() ? "" : ", ", name, 1e6 * seconds);
  }
  return out;
}

}  // namespace

int Report::count(Status status) const
{
  return static_cast<int>(std::count_if(results.begin(), results.end(),
                                        [&](const Result& r) { return r.outcome.status == status; }));
}

std::string Report::text() const
{
  std::string out = fmt::format("hauberk {} ({}), interface revision {}, {}\n", hauberk::version, build_type,
                                interface_revision, HAUBERK_COMPILER);
  out += id.empty() ? fmt::format("plugin {}\n", file)
                    : fmt::format("plugin {} {}, {}: {}\n", id, version, kind, file);
  if (!setup.section.empty()) out += fmt::format("section {}\n", setup.section);
  out += seeds == 1 ? fmt::format("seed {}\n\n", seed)
                    : fmt::format("seeds {} to {}\n\n", seed, seed + seeds - 1);
  const std::vector<std::vector<const Result*>> wrong = causes(results);
  for (const Result& r : results) {
    const bool loud = is_wrong(r);
    out += fmt::format("{:<8} {}",
                       !loud                              ? status_name(r.outcome.status)
                       : r.outcome.status == Status::slow ? "SLOW"
                                                          : "FAILED",
                       r.name);
    const auto group = std::find_if(wrong.begin(), wrong.end(), [&r](const auto& g) {
      return std::find(g.begin(), g.end(), &r) != g.end();
    });
    if (group != wrong.end() && group->front() != &r) {
      out += fmt::format(": as {}", group->front()->name);
    } else if (!r.outcome.text.empty()) {
      out += fmt::format(": {}", r.outcome.text);
    }
    out += '\n';
  }
  out += fmt::format("\n{} checks: {} passed, {} failed, {} skipped{}\n", results.size(),
                     count(Status::passed), count(Status::failed), count(Status::skipped),
                     count(Status::slow) == 0 ? "" : fmt::format(", {} slow", count(Status::slow)));
  for (const auto& group : wrong) {
    const Result& r = *group.front();
    out += fmt::format("{} ({})\n    again: {}\n", r.name, r.about, again(*this, r));
  }
  const std::string times = times_text(results);
  if (!times.empty()) out += fmt::format("a call takes: {}\n", times);
  return out;
}

std::string Report::json() const
{
  std::string out = fmt::format(
      "{{\n  \"format\": \"hauberk-conformance/1\",\n  \"program\": {{\"version\": {}, \"build\": {}, "
      "\"interface_revision\": {}, \"compiler\": {}}},\n",
      quote_json(hauberk::version), quote_json(build_type), interface_revision, quote_json(HAUBERK_COMPILER));
  out += fmt::format("  \"plugin\": {{\"file\": {}, \"id\": {}, \"version\": {}, \"kind\": {}}},\n",
                     quote_json(file), quote_json(id), quote_json(version), quote_json(kind));
  out += fmt::format("  \"section\": {}, \"seed\": {}, \"seeds\": {}, \"passed\": {},\n  \"checks\": [",
                     setup.section.empty() ? "null" : quote_json(setup.section), seed, seeds, passed());
  for (const Result& r : results) {
    std::string calls;
    for (const auto& [name, seconds] : r.outcome.times)
      calls += fmt::format("{}{}: {:.3g}", calls.empty() ? "" : ", ", quote_json(name), seconds);
    out += fmt::format(
        "{}\n    {{\"name\": {}, \"about\": {}, \"status\": {}, \"text\": {}, \"seed\": {}, \"seconds\": {:.3f}, "
        "\"seconds_per_call\": {{{}}}}}",
        &r == results.data() ? "" : ",", quote_json(r.name), quote_json(r.about),
        quote_json(status_name(r.outcome.status)), quote_json(r.outcome.text), r.seed, r.seconds, calls);
  }
  return out + "\n  ]\n}\n";
}

}  // namespace hauberk::conformance
