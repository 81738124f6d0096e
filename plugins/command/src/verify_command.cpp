#include "dispatch.hpp"
#include "document/json_text.hpp"
#include "experiment_options.hpp"
#include "options.hpp"
#include "results/document.hpp"
#include "run/prepared.hpp"
#include "say.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/stored_shapes.hpp>
#include <hauberk/verify/verify.hpp>

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>

namespace hauberk::command {
namespace {

namespace json = boost::json;

/// {ok, lines: [{outcome, text}], fields: {passed, failed, not_checked}, failed: [pointers]}.
json::object as_json(const VerifyReport& report)
{
  json::object out{
      {"ok", report.ok}, {"lines", json::array()}, {"fields", nullptr}, {"failed", json::array()}};
  for (const VerifyLine& line : report.lines) {
    const char* outcome = !line.checked ? "not_checked" : line.ok ? "passed" : "failed";
    out["lines"].as_array().push_back({{"outcome", outcome}, {"text", line.text}});
  }
  std::int64_t passed = 0, failed = 0, unchecked = 0;
  for (const VerifyField& field : report.fields) {
    passed += field.outcome == VerifyOutcome::passed ? 1 : 0;
    failed += field.outcome == VerifyOutcome::failed ? 1 : 0;
    unchecked += field.outcome == VerifyOutcome::not_checked ? 1 : 0;
    if (field.outcome == VerifyOutcome::failed) out["failed"].as_array().emplace_back(field.pointer);
  }
  out["fields"] = {{"passed", passed}, {"failed", failed}, {"not_checked", unchecked}};
  return out;
}

/// Lines that had nothing to check, as those of scenes whose plugins are not there.
std::size_t unchecked_lines(const VerifyReport& report)
{
  return static_cast<std::size_t>(
      std::ranges::count_if(report.lines, [](const VerifyLine& line) { return !line.checked; }));
}

}  // namespace

Description verify_description()
{
  return {
      .name = "verify",
      .form = "RESULTS.json",
      .line = "recheck a result from its file alone",
      .synopsis = "verify RESULTS.json",
      .summary =
          "Rechecks a result from its file alone: gaps, links, force balance, values. A line per "
          "limit; exits with 1 when anything fails. A folder stands for the results.json in it. Of "
          "solids it asks the plugins of their shapes where the surface is.",
      .arguments = {{.name = "RESULTS.json", .offer = Offer::results}},
      .options = {
          {.name = "strict",
           .help = "exit with 1 also where a line had nothing to check, as that of a scene whose plugin is "
                   "not there, or of a row that was refused"},
          json_option(),
          plugin_path_option()}};
}

int verify_command(const std::vector<std::string>& words)
{
  Options options(verify_description());
  options.parse(words);
  std::filesystem::path file = options.positional();
  std::error_code unknown;  // then reading tells
  if (std::filesystem::is_directory(file, unknown)) file /= results_file;
  const std::shared_ptr<const Registry> registry = open_registry(options);
  const VerifyReport report = verify(read_json_file(file.string()), {}, StoredShapes(lookup_in(*registry)));
  if (options.has("json"))
    say_json(write_json(as_json(report)));
  else
    say("{}", report.text());
  const std::size_t unchecked = unchecked_lines(report);
  if (unchecked > 0)
    say_error("hauberk: warning: {} of {} lines had nothing to check (NONE)\n", unchecked,
              report.lines.size());
  const bool passed = report.ok && (unchecked == 0 || !options.has("strict"));
  return passed ? exit_done : exit_failed;
}

}  // namespace hauberk::command
