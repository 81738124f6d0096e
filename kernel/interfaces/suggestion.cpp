#include <hauberk/suggestion.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace hauberk {
namespace {

/// More names than this are not listed.
constexpr std::size_t longest_list = 24;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::size_t substitution(char a, char b)
{
  if (a == b) return 0;
  return lower(a) == lower(b) ? 1 : 2;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b)
{
  // Rows of the dynamic programme for a[0..i-2], a[0..i-1] and a[0..i].
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = 2 * j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = 2 * i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      current[j] =
          std::min({previous[j] + 2, current[j - 1] + 2, previous[j - 1] + substitution(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before[j - 2] + 2);
      }
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates)
{
  std::string best;
  std::size_t least = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    const std::size_t letters = std::max<std::size_t>(1, std::max(name.size(), candidate.size()) / 3);
    if (distance > 2 * letters || (!best.empty() && distance >= least)) continue;
    best = candidate;
    least = distance;
  }
  return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates)
{
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates)
{
  std::string near = did_you_mean(name, candidates);
  if (!near.empty() || candidates.empty()) return near;
  // Elements of one kind have the same names.
  std::vector<std::string> known;
  for (const std::string& candidate : candidates) {
    if (known.size() > longest_list) break;
    if (std::find(known.begin(), known.end(), candidate) == known.end()) known.push_back(candidate);
  }
  const bool all = known.size() <= longest_list;
  if (!all) known.pop_back();
  return fmt::format("; known: '{}'{}", fmt::join(known, "', '"), all ? "" : ", ...");
}

}  // namespace hauberk
