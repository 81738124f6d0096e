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

}  // namespace

std::vector<Problem> Diagnostics::of_file() const
{
  std::vector<Problem> out = problems.list();
  for (Problem& problem : out) {
    const Place place = Place::of(problem.line);
    if (place.other < 0) continue;
    problem.message = fmt::format("{}:{}: {}", others[place.other], place.line, problem.message);
    problem.line = 0;
  }
  return out;
}

std::string Diagnostics::text() const
{
  std::vector<const Problem*> order;
  for (const Problem& problem : problems.list()) order.push_back(&problem);
  // Lines of other files are larger than all of the file itself.
  std::stable_sort(order.begin(), order.end(), [](const Problem* a, const Problem* b) {
    return a->line > 0 && (b->line == 0 || a->line < b->line);
  });
  std::string out;
  const std::size_t told = order.size() > most_problems ? most_problems : order.size();
  for (const Problem* problem : std::span(order).first(told)) {
    const Place place = Place::of(problem->line);
    const bool set_on_command_line =
        problem->line == 0 && std::any_of(overridden.begin(), overridden.end(), [&](const std::string& root) {
          return pointer_within(problem->pointer, root);
        });
    if (!out.empty()) out += '\n';
    if (set_on_command_line)
      out += "command line";
    else
      out += (place.other >= 0 ? plain_text(others[place.other]) : file) +
             (place.line > 0 ? ":" + std::to_string(place.line) : "");
    if (!problem->pointer.empty()) out += ": " + plain_text(problem->pointer);
    out += ": " + plain_text(problem->message);
  }
  if (told < order.size())
    out += fmt::format("\n{}: and {} more problems, {} in all", file, order.size() - told, order.size());
  return out;
}

}  // namespace hauberk
