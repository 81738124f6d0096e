#include "document/json_text.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace hauberk {
namespace {

TEST(JsonText, EveryNumberSurvivesWritingAndReading)
{
  std::mt19937_64 random(20);
  boost::json::array numbers;
  for (int i = 0; i < 20000; ++i) {
    const auto x = std::bit_cast<double>(random());
    if (std::isfinite(x)) numbers.push_back(x);
    numbers.push_back(std::uniform_real_distribution<>(-20.0, 20.0)(random));
  }
  numbers.push_back(std::numeric_limits<double>::denorm_min());
  numbers.push_back(std::numeric_limits<double>::max());
  numbers.push_back(0.43333333333333335);
  const auto back = parse_json(write_json(numbers), "numbers").as_array();
  ASSERT_EQ(back.size(), numbers.size());
  for (std::size_t i = 0; i < back.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back[i].to_number<double>()),
              std::bit_cast<std::uint64_t>(numbers[i].get_double()))
        << number_text(numbers[i].get_double());
}

TEST(JsonText, NumbersAreShortestAndZeroHasOneForm)
{
  EXPECT_EQ(number_text(12.2), "12.2");
  EXPECT_EQ(number_text(5.0), "5");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(1e-9), "1e-09");
  EXPECT_EQ(number_text(std::nan("")), "null");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "null");
}

TEST(JsonText, FoldsShortValuesAndKeepsKeyOrder)
{
  boost::json::object document;
  document["z"] = {1, 2.5, "a\"b"};
  document["a"] = boost::json::object{};
  document["long"] = boost::json::array(60, boost::json::value(7));
  const std::string text = write_json(document);
  EXPECT_EQ(text.substr(0, 46), "{\n  \"z\": [1, 2.5, \"a\\\"b\"],\n  \"a\": {},\n  \"long\"");
  EXPECT_TRUE(text.ends_with("    7\n  ]\n}\n"));
  EXPECT_EQ(parse_json(text, "text"), boost::json::value(document));
}

TEST(JsonText, ErrorsNameFileAndLine)
{
  try {
    parse_json("{\n\"a\": 1,\n\"b\": x}", "results.json");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "results.json:3: not valid JSON: syntax error");
  }
  EXPECT_THROW(parse_json("{} {}", "twice"), InputError);
  EXPECT_THROW(parse_json("[1, 2", "cut"), InputError);
  EXPECT_THROW(parse_json("", "empty"), InputError);
  EXPECT_THROW(read_json_file("/nonexistent/results.json"), InputError);
}

}  // namespace
}  // namespace hauberk
