/// Whether shapes depend on their smooth parameters without jumps or kinks.

#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hauberk::conformance {
namespace {

using Values = std::vector<double>;

/// Follows the largest change of values or derivatives over [low, high] down to an interval of no length.
/// What is left of a continuous function is nothing.
class JumpSearch {
 public:
  JumpSearch(const Shape& shape, const Point& point, std::size_t k) : shape_(shape), point_(point), k_(k) {}

  /// The place of a jump; null where there is none, or where parameters are refused.
  std::optional<double> find(double low, double high) const
  {
    auto left = at(low), right = at(high);
    const double first = left && right ? jump(*left, *right) : 0.0;
    for (int halving = 0; halving < 44; ++halving) {
      if (!left || !right || jump(*left, *right) <= least_jump) return std::nullopt;
      const double middle = 0.5 * (low + high);
      auto centre = at(middle);
      if (!centre) return std::nullopt;
      if (jump(*left, *centre) >= jump(*centre, *right)) {
        high = middle;
        right = std::move(centre);
      } else {
        low = middle;
        left = std::move(centre);
      }
    }
    // Steep is allowed: it falls with the interval, by 2^-44 where it is differentiable, and 2^-22 for a
    // root.
    return jump(*left, *right) > 1e-4 * first ? std::optional(0.5 * (low + high)) : std::nullopt;
  }

 private:
  static constexpr double least_jump = 1e-7;  ///< of the size of the element, and of derivatives

  std::optional<Values> at(double value) const
  {
    Values p = point_.p;
    p[k_] = value;
    if (refused(shape_, p)) return std::nullopt;
    Values out;
    for (const Primitive& primitive : shape_.primitives(p)) {
      const Values q = quantities(primitive);
      out.insert(out.end(), q.begin(), q.end());
    }
    for (const PrimitiveJacobian& jacobian : shape_.jacobians(p)) {
      const std::size_t rows = jacobian.size() / p.size();
      for (std::size_t row = 0; row < rows; ++row) out.push_back(jacobian[row * p.size() + k_]);
    }
    return out;
  }

  static double jump(const Values& a, const Values& b)
  {
    double largest = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      largest = std::max(largest, std::abs(a[i] - b[i]) / (1.0 + std::abs(a[i])));
    return largest;
  }

  const Shape& shape_;
  const Point& point_;
  std::size_t k_;
};

}  // namespace

void check_smoothness(Trial& trial)
{
  constexpr int intervals = 48;
  constexpr double reach = 9.0;  // margins to both sides: most of what parameters are drawn from
  const Object object = trial.make();
  const std::vector<ParameterInfo>& infos = object.shape->parameters();
  for (int draw = 0; draw < 3; ++draw) {
    const Point point = draw_point(*object.shape, trial);
    for (std::size_t k = 0; k < infos.size(); ++k) {
      if (!infos[k].smooth) continue;
      const double low = std::max(infos[k].lower, point.p[k] - reach * point.margin[k]);
      const double high = std::min(infos[k].upper, point.p[k] + reach * point.margin[k]);
      const JumpSearch search(*object.shape, point, k);
      for (int i = 0; i < intervals; ++i) {
        const double width = (high - low) / intervals;
        const auto place = search.find(low + i * width, low + (i + 1) * width);
        require(!place, "primitives or their derivatives jump at {} = {:.9g}, and it is said to be smooth",
                infos[k].name, place.value_or(0.0));
      }
    }
  }
}

}  // namespace hauberk::conformance
