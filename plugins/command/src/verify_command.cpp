#include "dispatch.hpp"
#include "options.hpp"

#include <hauberk/results/json_text.hpp>
#include <hauberk/verify/verify.hpp>

#include <fmt/format.h>

namespace hauberk::command {

int verify_command(const std::vector<std::string>& words)
{
  Options options(
      "verify RESULTS.json",
      "Rechecks a result from its file alone: gaps, links, force balance, values. A line per limit; exits "
      "with 1 when anything fails.",
      "RESULTS.json");
  options.parse(words);
  const VerifyReport report = verify(read_json_file(options.positional()));
  fmt::print("{}", report.text());
  return report.ok ? exit_done : exit_failed;
}

}  // namespace hauberk::command
