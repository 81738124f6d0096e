#pragma once
/// Quantiles of measured numbers, for the tables that the programs print.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hauberk::brute {

class Sample {
 public:
  void add(double x) { values_.push_back(x); }
  std::size_t size() const { return values_.size(); }
  /// Value that the fraction q of the sample does not exceed.
  double quantile(double q)
  {
    if (values_.empty()) return 0.0;
    std::sort(values_.begin(), values_.end());
    const auto k = static_cast<std::size_t>(std::lround(q * static_cast<double>(values_.size() - 1)));
    return values_[k];
  }
  double mean() const
  {
    double sum = 0.0;
    for (const double x : values_) sum += x;
    return values_.empty() ? 0.0 : sum / static_cast<double>(values_.size());
  }
  std::string summary()
  {
    return fmt::format("min {:.4g}, 1 % {:.4g}, median {:.4g}, mean {:.4g}, 99 % {:.4g}, max {:.4g}",
                       quantile(0.0), quantile(0.01), quantile(0.5), mean(), quantile(0.99), quantile(1.0));
  }

 private:
  std::vector<double> values_;
};

}  // namespace hauberk::brute
