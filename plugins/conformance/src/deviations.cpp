#include "deviations.hpp"

#include "verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hauberk::conformance {
namespace {

constexpr std::size_t steps = 12;
/// A least slope between what is right (2) and what is wrong (0), near enough to 2 to see a kink (1).
constexpr double least_slope = 1.6;
/// Roundings of the largest value that a value may be off by: compositions of a few dozen operations.
constexpr double roundings = 64.0;

/// Roundings of the largest of all values compared: a component that is nought but for them, as R cos(pi/2)
/// is, is a difference of such values.
constexpr double roundings_of_largest = 4.0;

/// Mean slope over the last three halvings.
double final_slope(std::span<const double, steps> error)
{
  return std::log2(error[steps - 4] / error[steps - 1]) / 3.0;
}

}  // namespace

std::vector<Deviation> deviations(const Along& f, std::span<const double> claimed, double largest)
{
  std::array<std::vector<double>, steps> difference;
  std::vector<double> size(claimed.size(), 0.0);
  double h = largest;
  for (auto& at : difference) {
    const std::vector<double> ahead = f(h), behind = f(-h);
    require(ahead.size() == claimed.size() && behind.size() == claimed.size(),
            "{} derivatives for {} quantities", claimed.size(), ahead.size());
    at.resize(claimed.size());
    for (std::size_t i = 0; i < claimed.size(); ++i) {
      size[i] = std::max({size[i], std::abs(ahead[i]), std::abs(behind[i])});
      at[i] = (ahead[i] - behind[i]) / (2.0 * h);
    }
    h *= 0.5;
  }
  double largest_size = 0.0;
  for (const double s : size) largest_size = std::max(largest_size, s);
  std::vector<Deviation> out;
  for (std::size_t i = 0; i < claimed.size(); ++i) {
    std::array<double, steps> error, floor;
    bool reached = false, stayed = true;
    h = largest;
    for (std::size_t k = 0; k < steps; ++k, h *= 0.5) {
      error[k] = std::abs(difference[k][i] - claimed[i]);
      floor[k] = std::numeric_limits<double>::epsilon() *
                 (roundings * (size[i] / h + std::abs(claimed[i])) + roundings_of_largest * largest_size / h);
      const bool within = error[k] <= floor[k];  // false for not-a-number
      stayed = stayed && (within || !reached);   // a wrong derivative may be crossed once
      reached = reached || within;
    }
    const double slope = final_slope(error);
    if (reached ? stayed : slope >= least_slope) continue;
    out.push_back({i, claimed[i], difference[steps - 1][i], slope});
  }
  return out;
}

std::string text_of(const Deviation& d)
{
  return fmt::format(
      "the plugin says {:.12g}, central differences say {:.12g} (their error falls with slope {:.1f}, not 2)",
      d.claimed, d.difference, d.slope);
}

}  // namespace hauberk::conformance
