#pragma once
/// Spans of an optimizer as vectors.

#include <Eigen/Core>

#include <span>

namespace hauberk {

/// What an optimizer hands over, as a vector of its own.
inline Eigen::VectorXd as_vector(std::span<const double> x)
{
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

}  // namespace hauberk
