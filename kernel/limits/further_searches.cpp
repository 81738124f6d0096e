#include "limits/further_searches.hpp"

#include "model/links.hpp"

#include <algorithm>
#include <set>
#include <tuple>

namespace hauberk {
namespace {

/// Of the searches from rest, so many have to come to the furthest state where they agree.
constexpr double share_that_agrees = 0.25;

/// Forces between elements that are not linked are at most 0.28 of all in stretches of 18 fabrics at five
/// directions; of dragonscale, whose scales clasp, they are 0.18 to 0.63.
constexpr double share_that_jams = 0.3;

/// Degrees by which loads are tilted that lead a jammed stretch elsewhere. Of 24, from 20 degrees none to 11
/// come to the furthest state that is known of dragonscales of 8 and 5.4 mm rings of 0.885 to 0.9 mm wire,
/// from 40 degrees 18 to 21.
constexpr double tilt_of_jammed = 40.0;

/// Two elements and the image of the second, either of them first.
using Pair = std::tuple<int, int, Image>;

Pair pair_of(int first, int second, const Image& image)
{
  const Image opposite{-image[0], -image[1], -image[2]};
  return std::min(Pair{first, second, image}, Pair{second, first, opposite});
}

}  // namespace

bool searches_agree(const LimitResult& result)
{
  const Confidence& c = result.confidence;
  if (result.status != LimitStatus::locked || !c.failed_searches.empty()) return false;
  return c.seen_once == 0 && c.ended_here >= share_that_agrees * c.searches;
}

bool is_jammed(const Model& model, const LimitResult& result)
{
  std::set<Pair> linked;
  for (const Link& link : model.links)
    linked.insert(pair_of(element_of_cycle(model, link.a), element_of_cycle(model, link.b), link.image));
  double all = 0.0, unlinked = 0.0;
  for (const ContactForce& contact : result.contacts) {
    if (!contact.wall.empty()) continue;
    all += contact.force;
    if (!linked.contains(pair_of(contact.elements[0], contact.elements[1], contact.image)))
      unlinked += contact.force;
  }
  return unlinked > share_that_jams * all;
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
    const LimitTask& task = searches_.tasks()[k];
    if (is_taut(model_, task)) {
      if (is_jammed(model_, results[k])) out.push_back(k);
    } else if (searches_agree(results[k])) {
      agreed_[k] = reached(model_, task, results[k]);
    } else {
      out.push_back(k);
    }
  }
  return out;
}

std::vector<FurtherSearch> FurtherSearches::from_rest(const std::vector<std::size_t>& undecided) const
{
  std::vector<FurtherSearch> out;
  for (const std::size_t k : undecided) {
    const TaskState& t = searches_.of(k);
    const bool taut = is_taut(model_, searches_.tasks()[k]);
    for (std::size_t j = 0; j < t.further_starts; ++j)
      out.push_back({k, (taut ? static_cast<std::size_t>(searches_.settings().tilts) : t.starts.size()) + j,
                     nullptr, taut ? tilt_of_jammed : 0.0});
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
    for (std::size_t j = 0; j < t.refolds; ++j)
      out.push_back({k, t.starts.size() + t.further_starts + loads_[k]++, &furthest_[k], 0.0});
  }
  return out;
}

}  // namespace hauberk
