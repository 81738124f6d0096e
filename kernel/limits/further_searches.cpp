#include "limits/further_searches.hpp"

#include <algorithm>

namespace hauberk {
namespace {

/// Of the searches from rest, so many have to come to the furthest state where they agree.
constexpr double share_that_agrees = 0.25;

}  // namespace

bool searches_agree(const LimitResult& result)
{
  const Confidence& c = result.confidence;
  if (result.status != LimitStatus::locked || !c.failed_searches.empty()) return false;
  return c.seen_once == 0 && c.ended_here >= share_that_agrees * c.searches;
}

FurtherSearches::FurtherSearches(const Model& model, const TaskSearches& searches)
    : model_(model),
      searches_(searches),
      agreed_(searches.asked()),
      begun_(searches.asked()),
      loads_(searches.asked(), 0),
      furthest_(searches.asked())
{
}

std::vector<std::size_t> FurtherSearches::undecided(const std::vector<LimitResult>& results)
{
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < searches_.asked(); ++k) {
    if (!may_go_on(k)) continue;
    const LimitStatus status = results[k].status;
    if (status == LimitStatus::unbounded || status == LimitStatus::not_attained) continue;
    if (searches_agree(results[k]))
      agreed_[k] = reached(model_, searches_.tasks()[k], results[k]);
    else
      out.push_back(k);
  }
  return out;
}

std::vector<FurtherSearch> FurtherSearches::from_rest(const std::vector<std::size_t>& undecided) const
{
  std::vector<FurtherSearch> out;
  for (const std::size_t k : undecided) {
    const TaskState& t = searches_.of(k);
    for (std::size_t j = 0; j < t.further_starts; ++j) out.push_back({k, t.starts.size() + j});
  }
  return out;
}

std::vector<std::size_t> FurtherSearches::unfolded(const std::vector<LimitResult>& results) const
{
  const double more = further_than(searches_.settings());
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < searches_.asked(); ++k) {
    if (searches_.of(k).random_loads == 0 || !may_go_on(k)) continue;
    if (results[k].status != LimitStatus::locked) continue;
    const double value = reached(model_, searches_.tasks()[k], results[k]);
    if (agreed_[k] && value <= *agreed_[k] + more) continue;
    if (!begun_[k] || value > *begun_[k] + more) out.push_back(k);
  }
  return out;
}

std::vector<FurtherSearch> FurtherSearches::refolds(const std::vector<std::size_t>& unfolded)
{
  std::vector<FurtherSearch> out;
  for (const std::size_t k : unfolded) {
    std::optional<FoundState> best = searches_.furthest_of(k);
    if (!best) continue;
    begun_[k] = reached(model_, searches_.tasks()[k], best->locked.state);
    furthest_[k] = std::move(best->locked.state);
    const TaskState& t = searches_.of(k);
    for (std::size_t j = 0; j < t.further_starts; ++j)
      out.push_back({k, t.starts.size() + t.further_starts + loads_[k]++, &furthest_[k]});
  }
  return out;
}

}  // namespace hauberk
