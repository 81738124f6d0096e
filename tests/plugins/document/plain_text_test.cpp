/// Text that acts nowhere.

#include "document/plain_text.hpp"
#include "document/json_text.hpp"
#include "document/utf8.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

TEST(PlainText, ShowsWhatActs)
{
  EXPECT_EQ(plain_text("a\x1b[2J\x7f\tb"), "a\\x1b[2J\\x7f\tb");
  EXPECT_EQ(plain_text("a\nb\r\n"), "a\\x0ab\\x0d\\x0a");
  EXPECT_EQ(plain_text("a\nb\r\n", LineBreaks::kept), "a\nb\\x0d\n");
  EXPECT_EQ(plain_text("\xc2\x9b \xe2\x80\xae \xe2\x81\xa9"), "\\x9b \\u{202e} \\u{2069}");
  EXPECT_EQ(plain_text("\xff\xc2"), "\\xff\\xc2");
  EXPECT_EQ(plain_text(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(PlainText, LeavesTheRest)
{
  for (const char* text : {"", "plain", "Kettenhemd \xc3\xa4\xc3\x9f", "\xe2\x80\x94 \xe6\x97\xa5",
                           "\xf0\x9f\x9b\xa1", "\xc2\xa0"})
    EXPECT_EQ(plain_text(text), text);
}

/// Whatever bytes there are, nothing acts afterwards, and doing it again changes nothing.
TEST(PlainText, AnyBytes)
{
  std::mt19937 rng(1);
  for (int round = 0; round < 2000; ++round) {
    std::string text;
    for (int k = 0; k < 20; ++k) text += static_cast<char>(rng() & 0xffU);
    const std::string plain = plain_text(text);
    EXPECT_FALSE(find_invalid_utf8(plain));
    for (const char c : plain) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\t');
    EXPECT_EQ(plain_text(plain), plain);
  }
}

TEST(PlainText, JsonKeepsItsValues)
{
  const std::string text = "{\n  \"a\xe2\x80\xae\": \"\x7f\xc2\x9b\"\n}";
  const std::string plain = plain_json(text);
  EXPECT_EQ(plain, "{\n  \"a\\u202e\": \"\\u007f\\u009b\"\n}");
  EXPECT_EQ(parse_json(plain, "a"), parse_json(text, "a"));
}

}  // namespace
}  // namespace hauberk::test
