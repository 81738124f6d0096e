/// The meter of memory against blocks of known size.

#include "run/memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace hauberk {
namespace {

constexpr std::int64_t mega = 1 << 20;

/// Touches every page of a block, then gives it back; returns what cannot be optimised away.
int use(std::int64_t bytes)
{
  std::vector<char> block(static_cast<std::size_t>(bytes), 1);
  return static_cast<int>(std::count(block.begin(), block.end(), 1) / mega);
}

TEST(MemoryMeter, ToldThePeakAboveTheStart)
{
  const MemoryMeter meter;
  if (!meter.peak()) GTEST_SKIP() << "this system does not tell";
  EXPECT_LT(*meter.peak(), 4 * mega);
  EXPECT_EQ(use(64 * mega), 64);
  EXPECT_GE(*meter.peak(), 60 * mega) << "also after it was given back";
  EXPECT_LT(*meter.peak(), 80 * mega);
}

TEST(MemoryMeter, ForgetsWhatWasBefore)
{
  EXPECT_EQ(use(64 * mega), 64);
  const std::int64_t before = peak_memory_bytes();
  EXPECT_GE(before, 60 * mega);
  const MemoryMeter meter;
  if (!meter.peak()) GTEST_SKIP() << "this system does not tell";
  EXPECT_LT(*meter.peak(), 4 * mega);
  EXPECT_EQ(use(16 * mega), 16);
  EXPECT_GE(*meter.peak(), 12 * mega);
  EXPECT_LT(*meter.peak(), 32 * mega);
  EXPECT_LT(peak_memory_bytes(), before) << "who wants to know the largest must ask before";
}

}  // namespace
}  // namespace hauberk
