#include "document/diagnostics.hpp"

#include "document/jsonc.hpp"
#include "document/plain_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace hauberk {

namespace {

/// Problems that are told one by one.
constexpr std::size_t most_problems = 50;

/// The other file that a problem's value comes from; null: it comes from none.
const std::string* source_of(const Problem& problem,
                             const std::vector<std::pair<std::string, std::string>>& inherited)
{
  const std::pair<std::string, std::string>* longest = nullptr;
  for (const auto& entry : inherited) {
    if (problem.line == 0 || !pointer_within(problem.pointer, entry.first)) continue;
    if (longest == nullptr || entry.first.size() > longest->first.size()) longest = &entry;
  }
  return longest == nullptr ? nullptr : &longest->second;
}

}  // namespace

std::vector<Problem> Diagnostics::of_file() const
{
  std::vector<Problem> out = problems.list();
  for (Problem& problem : out) {
    const std::string* other = source_of(problem, inherited);
    if (other == nullptr) continue;
    problem.message = fmt::format("{}:{}: {}", *other, problem.line, problem.message);
    problem.line = 0;
  }
  return out;
}

std::string Diagnostics::text() const
{
  struct Placed {
    const Problem* problem;
    const std::string* other;  ///< the file that it is in, if not this one
    int line;                  ///< of this one
  };
  std::vector<Placed> order;
  for (const Problem& problem : problems.list()) {
    const std::string* other = source_of(problem, inherited);
    order.push_back({&problem, other, other == nullptr ? problem.line : 0});
  }
  std::stable_sort(order.begin(), order.end(), [](const Placed& a, const Placed& b) {
    return a.line > 0 && (b.line == 0 || a.line < b.line);
  });
  std::string out;
  const std::size_t told = order.size() > most_problems ? most_problems : order.size();
  for (const auto& [problem, other, line] : std::span(order).first(told)) {
    const bool set_on_command_line =
        problem->line == 0 &&
        std::any_of(overridden.begin(), overridden.end(),
                    [&at = problem->pointer](const std::string& root) { return pointer_within(at, root); });
    if (!out.empty()) out += '\n';
    if (set_on_command_line)
      out += "command line";
    else
      out += (other != nullptr ? plain_text(*other) : file) +
             (problem->line > 0 ? ":" + std::to_string(problem->line) : "");
    if (!problem->pointer.empty()) out += ": " + plain_text(problem->pointer);
    out += ": " + plain_text(problem->message);
  }
  if (told < order.size())
    out += fmt::format("\n{}: and {} more problems, {} in all", file, order.size() - told, order.size());
  return out;
}

}  // namespace hauberk
