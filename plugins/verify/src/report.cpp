#include <hauberk/verify/verify.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace hauberk {
namespace {

/// Indices become *; fields that a rule takes together are its pattern.
std::string pattern_of(const std::string& pointer)
{
  const VerifyRule* rule = verify_rule(without_document(pointer));
  if (rule != nullptr) return std::string(rule->pattern);
  std::string out;
  for (std::size_t k = 0; k < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', k + 1), pointer.size());
    const std::string token = pointer.substr(k + 1, end - k - 1);
    const bool index = !token.empty() && std::all_of(token.begin(), token.end(),
                                                     [](unsigned char c) { return std::isdigit(c) != 0; });
    out += '/' + (index ? "*" : token);
    k = end;
  }
  return out;
}

/// Patterns of one reason, in the order in which they appear, with how many fields each.
struct Reason {
  std::string why;
  std::size_t count = 0;
  std::vector<std::pair<std::string, std::size_t>> patterns;
};

std::vector<Reason> reasons_of(const std::vector<VerifyField>& fields)
{
  std::vector<Reason> out;
  for (const VerifyField& field : fields) {
    if (field.outcome != VerifyOutcome::not_checked) continue;
    auto reason = std::find_if(out.begin(), out.end(), [&](const Reason& r) { return r.why == field.why; });
    if (reason == out.end()) reason = out.insert(out.end(), Reason{field.why, 0, {}});
    ++reason->count;
    const std::string pattern = pattern_of(field.pointer);
    auto known = std::find_if(reason->patterns.begin(), reason->patterns.end(),
                              [&](const auto& p) { return p.first == pattern; });
    if (known == reason->patterns.end()) known = reason->patterns.insert(known, {pattern, 0});
    ++known->second;
  }
  return out;
}

}  // namespace

std::string VerifyReport::text() const
{
  std::string out;
  for (const VerifyLine& line : lines)
    out += (!line.ok ? "FAIL " : line.checked ? "PASS " : "NONE ") + line.text + '\n';
  for (const Reason& reason : reasons_of(fields)) {
    out += "not checked, " + reason.why + ":";
    for (const auto& [pattern, count] : reason.patterns)
      out += count == 1 ? fmt::format(" {}", pattern) : fmt::format(" {} ({})", pattern, count);
    out += '\n';
  }
  const auto count = [this](VerifyOutcome outcome) {
    return std::count_if(fields.begin(), fields.end(),
                         [outcome](const VerifyField& f) { return f.outcome == outcome; });
  };
  return out + fmt::format("fields: {} passed, {} failed, {} not checked\n", count(VerifyOutcome::passed),
                           count(VerifyOutcome::failed), count(VerifyOutcome::not_checked));
}

}  // namespace hauberk
