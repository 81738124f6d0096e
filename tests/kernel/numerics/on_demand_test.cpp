/// Libraries that are loaded where they are used.

#include "numerics/on_demand.hpp"
#include "numerics/symbolic_factor.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace hauberk {
namespace {

TEST(OnDemand, WhatIsMissingIsNamed)
{
  try {
    static_cast<void>(on_demand("no_such_library", "no_such_function"));
    FAIL() << "it was found";
  } catch (const std::runtime_error& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("/hauberk/on_demand/no_such_library.so cannot be loaded: "), std::string::npos)
        << said;
  }
  EXPECT_THROW(static_cast<void>(on_demand("cholmod_symbolic", "no_such_function")), std::runtime_error);
}

/// An arrow: row and column 0 full, the diagonal. Eliminated first it would fill everything; last nothing.
TEST(OnDemand, AnArrowIsOrderedSoThatNothingFills)
{
  constexpr int n = 40;
  std::vector<int> columns{0}, rows;
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < (j == 0 ? n : j + 1); ++i) rows.push_back(i);
    columns.push_back(static_cast<int>(rows.size()));
  }
  auto* find =
      reinterpret_cast<FindSymbolicFactor*>(on_demand("cholmod_symbolic", "hauberk_symbolic_factor"));
  SymbolicFactor found;
  ASSERT_TRUE(find(n, columns.data(), rows.data(), nullptr, found));
  // One of the other columns may come after the full one: the last two fill nothing either way.
  EXPECT_TRUE(found.order[n - 1] == 0 || found.order[n - 2] == 0);
  EXPECT_EQ(found.first.front(), 0);
  EXPECT_EQ(found.first.back(), n);
  ASSERT_EQ(found.begin.size(), found.first.size());
  EXPECT_EQ(static_cast<std::size_t>(found.begin.back()), found.rows.size());
  // A given order is kept: with the full row first each column has all rows below.
  std::vector<int> given(n);
  for (int k = 0; k < n; ++k) given[k] = k;
  ASSERT_TRUE(find(n, columns.data(), rows.data(), given.data(), found));
  EXPECT_EQ(found.order.front(), 0);
  EXPECT_EQ(found.rows.size(), static_cast<std::size_t>(n)) << "one block of all columns";
}

}  // namespace
}  // namespace hauberk
