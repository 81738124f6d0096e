/// Results files: whatever the bytes are, the independent check gives a report, and `report` an entry or a
/// message.

#include "document/json_text.hpp"
#include "harness.hpp"
#include "report/report.hpp"

#include <hauberk/error.hpp>
#include <hauberk/verify/verify.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

[[noreturn]] void violated(const char* property)
{
  std::fprintf(stderr, "results: %s\n", property);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace hauberk;
  boost::json::value document;
  try {
    document = parse_json(std::string(reinterpret_cast<const char*>(data), size), "results.json");
  } catch (const InputError& error) {
    if (std::string(error.what()).find("results.json") == std::string::npos)
      violated("a message does not name the file");
    return 0;
  }
  const VerifyReport report = verify(document);
  if (report.text().empty()) violated("the check says nothing");
  if (report.ok && report.lines.empty()) violated("the check passes what it did not look at");
  try {
    const std::vector<ReportEntry> entries{read_report_entry(document, "results.json")};
    if (report_text(entries).empty() || report_csv(entries).empty()) violated("an empty report");
    const std::string picture = report_svg(entries);
    if (!picture.ends_with("</svg>\n")) violated("a picture that does not end");
  } catch (const InputError& error) {
    if (std::string(error.what()).find("results.json") == std::string::npos)
      violated("a message does not name the file");
  }
  return 0;
}
