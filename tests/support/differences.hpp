#pragma once
/// The one template that derivatives are tested by.

#include <gtest/gtest.h>

#include <array>

namespace hauberk::test {

/// Errors of central differences over the steps h, h/2, h/4: the last is below `small` of `scale`, where
/// rounding decides, or they fall by four each. A derivative that is wrong leaves an error that does not
/// fall.
inline void expect_second_order(const std::array<double, 3>& error, double scale, double small,
                                const char* what = "differences")
{
  if (error[2] < small * scale) return;
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(error[k] / error[k + 1], 4.0, 0.8)
        << what << ": " << error[0] << " " << error[1] << " " << error[2] << " of " << scale;
  }
}

}  // namespace hauberk::test
