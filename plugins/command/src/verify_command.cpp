#include "dispatch.hpp"
#include "options.hpp"

#include <hauberk/verify/verify.hpp>
#include "document/json_text.hpp"
#include "results/document.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace hauberk::command {

int verify_command(const std::vector<std::string>& words)
{
  Options options(
      "verify RESULTS.json",
      "Rechecks a result from its file alone: gaps, links, force balance, values. A line per limit; exits "
      "with 1 when anything fails. A folder stands for the results.json in it.",
      "RESULTS.json");
  options.parse(words);
  std::filesystem::path file = options.positional();
  std::error_code unknown;  // then reading tells
  if (std::filesystem::is_directory(file, unknown)) file /= results_file;
  const VerifyReport report = verify(read_json_file(file.string()));
  fmt::print("{}", report.text());
  return report.ok ? exit_done : exit_failed;
}

}  // namespace hauberk::command
