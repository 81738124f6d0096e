#pragma once
/// Derivatives of a pair's contact energy in the poses of both bodies.

#include "contact/body_pair.hpp"
#include "curve_pairs.hpp"
#include "differences.hpp"

#include <functional>
#include <random>

namespace hauberk::test {

/// How small a difference counts as rounding, relative to the gradient and to the Hessian.
struct SmallDifferences {
  double gradient, hessian;
};

/// Six of the couples that `draw` makes, in contact and away from merging minima: along a random motion of
/// the first element and turns of both, differences of the energy converge to the gradient and to the
/// Hessian.
inline void expect_pose_derivatives(const std::function<Couple(std::mt19937_64&)>& draw,
                                    const ContactSettings& settings, const SmallDifferences& small,
                                    std::uint64_t seed)
{
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal;
  int tried = 0;
  for (int trial = 0; trial < 40 && tried < 6; ++trial) {
    const Couple c = draw(rng);
    const PairContact now = pair_contact(c.A, c.pose, c.B, Pose{}, settings, 2);
    if (!(now.min_gap > 0.01) || now.terms.energy == 0.0 || !(now.regularity > 0.02)) continue;
    ++tried;
    Vec9 y;
    for (int k = 0; k < 9; ++k) y[k] = normal(rng);
    const auto at = [&](double h) {
      const Pose first{c.pose.position + h * y.head<3>(),
                       rotation_exp(h * y.segment<3>(3)) * c.pose.rotation};
      const Pose second{Vec3::Zero(), rotation_exp(h * y.tail<3>())};
      return pair_contact(c.A, first, c.B, second, settings, 0).terms.energy;
    };
    std::array<double, 3> slope{}, bend{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double h = 1e-3 / (1 << k), plus = at(h), minus = at(-h);
      slope[k] = std::abs((plus - minus) / (2.0 * h) - now.terms.gradient.dot(y));
      bend[k] = std::abs((plus - 2.0 * now.terms.energy + minus) / (h * h) - y.dot(now.terms.hessian * y));
    }
    expect_second_order(slope, now.terms.gradient.norm(), small.gradient, "gradient");
    expect_second_order(bend, now.terms.hessian.norm(), small.hessian, "Hessian");
  }
  EXPECT_EQ(tried, 6);
}

}  // namespace hauberk::test
