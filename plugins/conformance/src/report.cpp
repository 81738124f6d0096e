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

std::string again(const Report& report, const std::string& check)
{
  std::string text = fmt::format("hauberk plugins conform {} --seed {}", quoted(report.file), report.seed);
  if (!report.setup.section.empty()) text += " --section " + quoted(report.setup.section);
  return check == "load" ? text : fmt::format("{} --filter '^{}$'", text, check);
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
  out += fmt::format("seed {}\n\n", seed);
  for (const Result& r : results) {
    out += fmt::format("{:<8} {}",
                       r.outcome.status == Status::failed ? "FAILED" : status_name(r.outcome.status), r.name);
    if (!r.outcome.text.empty()) out += fmt::format(": {}", r.outcome.text);
    out += '\n';
  }
  out += fmt::format("\n{} checks: {} passed, {} failed, {} skipped\n", results.size(), count(Status::passed),
                     count(Status::failed), count(Status::skipped));
  for (const Result& r : results) {
    if (r.outcome.status == Status::failed)
      out += fmt::format("{} ({})\n    again: {}\n", r.name, r.about, again(*this, r.name));
  }
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
  out += fmt::format("  \"section\": {}, \"seed\": {}, \"passed\": {},\n  \"checks\": [",
                     setup.section.empty() ? "null" : quote_json(setup.section), seed, passed());
  for (const Result& r : results) {
    out += fmt::format(
        "{}\n    {{\"name\": {}, \"about\": {}, \"status\": {}, \"text\": {}, \"seconds\": {:.3f}}}",
        &r == results.data() ? "" : ",", quote_json(r.name), quote_json(r.about),
        quote_json(status_name(r.outcome.status)), quote_json(r.outcome.text), r.seconds);
  }
  return out + "\n  ]\n}\n";
}

}  // namespace hauberk::conformance
