#include "tasks/transition/tracks.hpp"

#include <algorithm>
#include <tuple>

namespace hauberk {
namespace {

double moved_by(const TransitionMinimum& a, const TransitionMinimum& b)
{
  return std::max((a.on_fixed - b.on_fixed).norm(), (a.on_moving - b.on_moving).norm());
}

}  // namespace

void number_contacts(std::vector<TransitionSample>& samples, double reach)
{
  int next = 0;
  const std::vector<TransitionMinimum>* before = nullptr;
  for (TransitionSample& sample : samples) {
    // Nearest pairs first; ties in the order of the minima.
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    const std::size_t old = before == nullptr ? 0 : before->size();
    for (std::size_t i = 0; i < old; ++i) {
      for (std::size_t k = 0; k < sample.minima.size(); ++k) {
        const double distance = moved_by((*before)[i], sample.minima[k]);
        if (distance < reach && (*before)[i].primitives == sample.minima[k].primitives)
          pairs.emplace_back(distance, i, k);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<bool> taken(old, false), known(sample.minima.size(), false);
    for (const auto& [distance, i, k] : pairs) {
      if (taken[i] || known[k]) continue;
      sample.minima[k].contact = (*before)[i].contact;
      taken[i] = known[k] = true;
    }
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (!known[k]) sample.minima[k].contact = next++;
    }
    before = &sample.minima;
  }
}

}  // namespace hauberk
