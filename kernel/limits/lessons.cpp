#include "limits/lessons.hpp"

#include <algorithm>
#include <limits>

namespace hauberk {

Lessons::Lessons(std::size_t learners, std::size_t donors, double margin)
    : donors_(donors), margin_(margin), begun_(learners, -std::numeric_limits<double>::infinity())
{
}

std::vector<Lesson> Lessons::next(const Own& own, const Reached& reached)
{
  std::vector<Lesson> lessons;
  for (std::size_t k = 0; k < begun_.size(); ++k) {
    const std::optional<double> there = own(k);
    if (!there) continue;
    double most = std::max(*there, begun_[k]) + margin_;
    std::optional<std::size_t> donor;
    for (std::size_t j = 0; j < donors_; ++j) {
      const std::optional<double> further = reached(j, k);
      if (!further || *further <= most) continue;
      most = *further;
      donor = j;
    }
    if (!donor) continue;
    begun_[k] = most;
    lessons.push_back({k, *donor});
  }
  return lessons;
}

std::vector<Lesson> Walks::next(const State& state, double margin)
{
  std::vector<Lesson> lessons;
  for (std::size_t i = 0; i < beside_.size(); ++i) {
    const std::optional<double> there = state(beside_[i].donor);
    if (!there || (taught_[i] && !(*there > *taught_[i] + margin))) continue;
    taught_[i] = there;
    lessons.push_back(beside_[i]);
  }
  return lessons;
}

}  // namespace hauberk
