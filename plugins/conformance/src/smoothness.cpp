/// Whether shapes depend on their smooth parameters without jumps or kinks.

#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hauberk::conformance {
namespace {

using Values = std::vector<double>;

/// Follows the largest second difference of values and derivatives over [low, high] down to an interval of no
/// length: of each component by itself, since a jump of one may be far smaller than the slope of another.
/// What is left of a continuous function is nothing: a smooth one loses three quarters with every halving, a
/// root a third.
class JumpSearch {
 public:
  JumpSearch(const Shape& shape, const Point& point, std::size_t k, Trial& trial)
      : shape_(shape), point_(point), k_(k), trial_(trial)
  {
  }

  /// The place of a jump; null where there is none, or where parameters are refused.
  std::optional<double> find(double low, double high) const
  {
    auto left = at(low), right = at(high);
    double first = 0.0, last = 0.0;
    for (int halving = 0; halving < 44; ++halving) {
      if (!left || !right) return std::nullopt;
      const double middle = 0.5 * (low + high);
      auto centre = at(middle);
      if (!centre) return std::nullopt;
      const auto [size, component] = bend(*left, *centre, *right);
      if (size <= least_jump) return std::nullopt;
      last = size;
      if (halving == 0) first = size;
      if (std::abs((*centre)[component] - (*left)[component]) >=
          std::abs((*right)[component] - (*centre)[component])) {
        high = middle;
        right = std::move(centre);
      } else {
        low = middle;
        left = std::move(centre);
      }
    }
    return last > 1e-4 * first ? std::optional(0.5 * (low + high)) : std::nullopt;
  }

 private:
  static constexpr double least_jump = 1e-7;  ///< of the size of the element, and of derivatives

  std::optional<Values> at(double value) const
  {
    Values p = point_.p;
    p[k_] = value;
    if (refused(shape_, p, trial_)) return std::nullopt;
    Values out;
    for (const Primitive& primitive : shape_.primitives(p)) {
      const Values q = quantities(primitive);
      out.insert(out.end(), q.begin(), q.end());
      out.insert(out.end(), primitive.rotation.data(), primitive.rotation.data() + primitive.rotation.size());
    }
    for (const PrimitiveJacobian& jacobian : shape_.jacobians(p)) {
      const std::size_t rows = jacobian.size() / p.size();
      for (std::size_t row = 0; row < rows; ++row) out.push_back(jacobian[row * p.size() + k_]);
    }
    return out;
  }

  /// The largest second difference and its component.
  static std::pair<double, std::size_t> bend(const Values& a, const Values& b, const Values& c)
  {
    std::pair<double, std::size_t> most{0.0, 0};
    for (std::size_t i = 0; i < std::min({a.size(), b.size(), c.size()}); ++i) {
      const double size = std::abs(a[i] - 2.0 * b[i] + c[i]) / (1.0 + std::abs(b[i]));
      if (size > most.first) most = {size, i};
    }
    return most;
  }

  const Shape& shape_;
  const Point& point_;
  std::size_t k_;
  Trial& trial_;
};

/// Looks for jumps in intervals between `low` and `high`, of equal ratios where these differ by more than a
/// decade.
void require_no_jump(const Shape& shape, const Point& point, std::size_t k, double low, double high,
                     int intervals, Trial& trial)
{
  const bool wide = low > 0.0 && high > 10.0 * low;
  const auto at = [&](int i) {
    const double s = static_cast<double>(i) / intervals;
    return wide ? low * std::pow(high / low, s) : low + s * (high - low);
  };
  const JumpSearch search(shape, point, k, trial);
  for (int i = 0; i < intervals; ++i) {
    const auto place = search.find(std::max(low, at(i)), std::min(high, at(i + 1)));
    require(!place, "primitives or their derivatives jump at {} = {:.9g}, and it is said to be smooth",
            shape.parameters()[k].name, place.value_or(0.0));
  }
}

}  // namespace

void check_smoothness(Trial& trial)
{
  constexpr double reach = 9.0;  // margins to both sides: most of what parameters are drawn from
  const Object object = trial.make();
  const std::vector<ParameterInfo>& infos = object.shape->parameters();
  // Near the defaults closely; over whole bounds, and where a switch is set otherwise, as many in all for any
  // number of parameters.
  constexpr int near = 48, of_all = 128, least_number = 6;
  const int shared = std::clamp(of_all / std::max(1, static_cast<int>(infos.size())), least_number, near);
  const int draws = trial.switched ? 1 : 3;
  for (int draw = 0; draw < draws; ++draw) {
    const Point point = draw_point(*object.shape, trial);
    for (std::size_t k = 0; k < infos.size(); ++k) {
      if (!infos[k].smooth) continue;
      const double low = std::max(infos[k].lower, point.p[k] - reach * point.margin[k]);
      const double high = std::min(infos[k].upper, point.p[k] + reach * point.margin[k]);
      require_no_jump(*object.shape, point, k, low, high, trial.switched ? shared : near, trial);
      if (draw > 0 || trial.switched) continue;
      const auto [least, most] = whole_range(infos[k]);
      require_no_jump(*object.shape, point, k, least, most, shared, trial);
    }
  }
}

}  // namespace hauberk::conformance
