#include "checks.hpp"
#include "read.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk::verification {

void check_counts(const boost::json::value& counts, const std::vector<std::string>& statuses,
                  const std::string& what, Sentences& problems)
{
  std::size_t known = 0;
  for (const char* status : {"done", "failed", "refused", "interrupted"}) {
    const auto count = static_cast<std::size_t>(std::count(statuses.begin(), statuses.end(), status));
    const double recorded = number(member(counts, status, "/counts"), "/counts");
    if (recorded != static_cast<double>(count))
      problems.push_back(fmt::format("counts/{}: {} expected, found {:g}", status, count, recorded));
    known += count;
  }
  if (known != statuses.size())
    problems.push_back(what + ": a status other than done, failed, refused, interrupted");
}

}  // namespace hauberk::verification
