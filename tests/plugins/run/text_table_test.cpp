#include "run/text_table.hpp"

#include <gtest/gtest.h>

namespace hauberk {
namespace {

TEST(TextTable, ColumnsAreAsWideAsTheirLongestCell)
{
  EXPECT_EQ(text_table({{"name", "n"}, {"a", "100"}}), "name    n\n   a  100\n");
  EXPECT_EQ(text_table({{"name", "n"}, {"a", "100"}}, 1), "name    n\na     100\n");
  EXPECT_EQ(text_table({{"a"}, {"b", "c"}}), "a\nb  c\n") << "lines may be short";
  EXPECT_EQ(text_table({}), "");
}

}  // namespace
}  // namespace hauberk
