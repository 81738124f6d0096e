#pragma once
/// What hangs together, while it is found out.

#include <numeric>
#include <utility>
#include <vector>

namespace hauberk::inspecting {

/// Disjoint sets of numbers from 0, which are joined (union by the lesser root, paths halved). Not thread
/// safe.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The number that stands for the set of k: its least.
  int root(int k)
  {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }

  void join(int a, int b)
  {
    a = root(a);
    b = root(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace hauberk::inspecting
