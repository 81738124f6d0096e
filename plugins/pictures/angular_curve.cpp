#include "pictures/angular_curve.hpp"

#include <boost/math/interpolators/pchip.hpp>

#include <cmath>
#include <functional>

namespace hauberk::detail {
namespace {

constexpr double longest_step_deg = 2.0, widest_of_curve_deg = 15.0;
/// As many as the cubic needs to have its slope where the circle closes.
constexpr std::size_t wrapped = 2;
constexpr std::size_t fewest_of_cubic = 4;

std::function<double(double)> interpolant(const AngularValues& values)
{
  std::vector<double> degrees, at;
  for (const auto& [d, v] : values) {
    degrees.push_back(d);
    at.push_back(v);
  }
  return boost::math::interpolators::pchip(std::move(degrees), std::move(at));
}

/// The values, once more on both sides as far as the slopes at the ends need them.
AngularValues around(const AngularValues& values)
{
  const std::size_t n = values.size();
  AngularValues out;
  for (std::size_t k = n - wrapped; k < n; ++k) out.emplace_back(values[k].first - 360.0, values[k].second);
  out.insert(out.end(), values.begin(), values.end());
  for (std::size_t k = 0; k <= wrapped; ++k) out.emplace_back(values[k].first + 360.0, values[k].second);
  return out;
}

}  // namespace

AngularValues angular_curve(const AngularValues& values, bool closed)
{
  AngularValues ends = values;
  if (closed && !values.empty()) ends.emplace_back(values.front().first + 360.0, values.front().second);
  const bool cubic = values.size() >= fewest_of_cubic;
  std::function<double(double)> between;
  if (cubic) between = interpolant(closed ? around(values) : values);
  AngularValues out;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    out.push_back(ends[k]);
    if (k + 1 == ends.size()) break;
    const auto [from, a] = ends[k];
    const auto [to, b] = ends[k + 1];
    const bool near = to - from <= widest_of_curve_deg + 1e-9;
    const int steps = near ? static_cast<int>(std::ceil((to - from) / longest_step_deg)) : 1;
    for (int i = 1; i < steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const double degrees = from + t * (to - from);
      out.emplace_back(degrees, cubic ? between(degrees) : a + t * (b - a));
    }
  }
  return out;
}

std::vector<AngularValues> within(const AngularValues& curve, double largest)
{
  std::vector<AngularValues> out;
  AngularValues part;
  const auto end_part = [&] {
    if (!part.empty()) out.push_back(std::move(part));
    part.clear();
  };
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const bool inside = curve[k].second <= largest;
    if (k > 0 && inside != (curve[k - 1].second <= largest)) {
      const auto [from, a] = curve[k - 1];
      const auto [to, b] = curve[k];
      part.emplace_back(from + (to - from) * (largest - a) / (b - a), largest);
      if (!inside) end_part();
    }
    if (inside) part.push_back(curve[k]);
  }
  end_part();
  return out;
}

}  // namespace hauberk::detail
