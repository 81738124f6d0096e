// Chains of two rings: the locked period is known exactly, or found by an independent search.

#include "counts.hpp"
#include "limit_cases.hpp"
#include "period_search.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hauberk::brute {
namespace {

using Size = std::array<double, 3>;

double formula(const Size& a, const Size& b) { return 2.0 * (a[0] + b[0] - a[1] - b[1]); }

Torus ring(const Size& s)
{
  Torus t;
  t.R = s[0];
  t.r0 = s[1];
  t.r1 = s[2];
  return t;
}

void expect_formula(const std::vector<std::pair<Size, Size>>& chains)
{
  for (const auto& [a, b] : chains) {
    const SceneSpec scene = slack_chain(a, b);
    const double exact = formula(a, b) / scene.lattice[0].x();
    for (const bool fast : {false, true}) {
      const LimitResult r = limit(scene, 0.0, Sense::positive, fast ? fast_settings() : LimitSettings{});
      ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
      const double error = (1.0 + *r.value) / exact - 1.0;
      fmt::print(
          "chain ({}, {}, {}) ({}, {}, {}) {}: 1 + value {:.12f}, exact {:.12f}, relative error {:.1e}\n",
          a[0], a[1], a[2], b[0], b[1], b[2], fast ? "fast" : "accurate", 1.0 + *r.value, exact, error);
      EXPECT_NEAR(error, 0.0, fast ? 1e-3 : 1e-8);
      EXPECT_TRUE(r.links_kept);
    }
  }
}

TEST(Chain, RoundRingsLockAtTheExactPeriod)
{
  expect_formula({{{5, 0.7, 0.7}, {5, 0.7, 0.7}},
                  {{5, 0.7, 0.7}, {4, 0.5, 0.5}},
                  {{3, 0.9, 0.9}, {6, 0.4, 0.4}},
                  {{2, 0.1, 0.1}, {2, 0.5, 0.5}},
                  {{4.9, 1.15, 1.15}, {4.9, 1.15, 1.15}},
                  {{8, 0.3, 0.3}, {2.5, 0.6, 0.6}},
                  {{1, 0.3, 0.3}, {1, 0.3, 0.3}}});
}

TEST(Chain, EllipticalRingsLockAtTheExactPeriodWhileTheyFitTheHole)
{
  const std::vector<std::pair<Size, Size>> chains{{{5, 0.7, 0.9}, {5, 0.7, 0.9}},
                                                  {{5, 0.9, 0.4}, {4, 0.5, 0.8}},
                                                  {{5, 0.7, 0.7}, {5, 0.7, 1.4}},
                                                  {{6, 1.0, 1.8}, {5, 0.6, 1.2}},
                                                  {{3, 0.6, 0.2}, {4, 0.8, 0.3}}};
  for (const auto& [a, b] : chains) {  // inside the formula's range
    ASSERT_LT(a[2] * a[2] / a[1], b[0] - b[1]);
    ASSERT_LT(b[2] * b[2] / b[1], a[0] - a[1]);
  }
  expect_formula(chains);
}

TEST(Chain, SearchFindsTheExactPeriodOfRoundRings)
{
  const Size a{5, 0.7, 0.7}, b{4, 0.5, 0.5};
  EXPECT_NEAR(longest_period(ring(a), ring(b), 1) / formula(a, b), 1.0, 1e-5);
}

TEST(Chain, TallTubesLockWhereAnIndependentSearchEnds)
{
  const std::vector<std::pair<Size, Size>> chains{
      {{5, 0.7, 2.5}, {5, 0.7, 0.7}}, {{5, 0.7, 2.2}, {5, 0.7, 2.2}}, {{6, 0.8, 2.6}, {4.5, 0.9, 0.5}}};
  const long starts = search_starts();
  for (std::size_t k = 0; k < (starts > 1 ? chains.size() : 1); ++k) {
    const auto& [a, b] = chains[k];
    ASSERT_TRUE(a[2] * a[2] / a[1] > b[0] - b[1] || b[2] * b[2] / b[1] > a[0] - a[1]);
    const SceneSpec scene = slack_chain(a, b);
    LimitSettings settings;
    settings.starts = 4;
    const LimitResult r = limit(scene, 0.0, Sense::positive, settings);
    ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
    const double locked = (1.0 + *r.value) * scene.lattice[0].x();
    const double searched = longest_period(ring(a), ring(b), static_cast<int>(starts));
    fmt::print(
        "tall chain ({}, {}, {}) ({}, {}, {}): locked period {:.8f}, searched {:.8f} ({} starts), difference "
        "{:.1e}; formula {:.4f}\n",
        a[0], a[1], a[2], b[0], b[1], b[2], locked, searched, starts, locked / searched - 1.0, formula(a, b));
    EXPECT_LT(locked, formula(a, b) * (1.0 - 1e-4));
    EXPECT_GT(locked, searched * (1.0 - 1e-5));
    EXPECT_NEAR(locked / searched, 1.0, starts > 1 ? 2e-5 : 1e-3);
  }
}

}  // namespace
}  // namespace hauberk::brute
