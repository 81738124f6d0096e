#include "limited_memory.hpp"

namespace hauberk {

void LimitedMemory::reset(Eigen::Index n, double curvature)
{
  curvature_ = curvature;
  pairs_.clear();
  bfgs_.reset(n, curvature);
}

void LimitedMemory::update(const Eigen::VectorXd& s, const Eigen::VectorXd& y)
{
  if (memory_ == 0 || pairs_.size() < memory_) {
    if (memory_ > 0) pairs_.push_back({s, y});
    bfgs_.update(s, y);
    return;
  }
  pairs_.pop_front();
  pairs_.push_back({s, y});
  bfgs_.reset(s.size(), curvature_);
  for (const Pair& p : pairs_) bfgs_.update(p.s, p.y);
}

}  // namespace hauberk
