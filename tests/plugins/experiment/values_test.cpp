/// Named values and the strings that stand for numbers.

#include "document/json_writer.hpp"
#include "fake_plugins.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hauberk::test {
namespace {

/// valid_text() with values before its cell, and the first vector's length an expression.
std::string text_of(const std::string& values, const std::string& expression)
{
  const std::string text =
      with(valid_text(), "\"vectors\": [[12, 0]", "\"vectors\": [[\"" + expression + "\", 0]");
  return values.empty() ? text : with(text, "\"cell\":", "\"values\": " + values + ", \"cell\":");
}

double value_of(const std::string& expression)
{
  const Experiment e = read_ok(
      text_of(R"json({ "pitch": 12, "half": "$pitch / 2", "ratio_2": "=sqrt($half * 6)" })json", expression));
  return e.scene.lattice.at(0).x();
}

TEST(Values, AreNumbersOfTheUsualArithmetic)
{
  EXPECT_EQ(value_of("$pitch"), 12.0);
  EXPECT_EQ(value_of("$half"), 6.0);
  EXPECT_EQ(value_of("$ratio_2"), 6.0);
  EXPECT_EQ(value_of("$pitch - 2 - 3"), 7.0);
  EXPECT_EQ(value_of("$pitch / 2 / 3"), 2.0);
  EXPECT_EQ(value_of("$pitch + 2 * 3 ^ 2"), 30.0);
  EXPECT_EQ(value_of("$half * 0 + 2 ^ 3 ^ 2"), 512.0);
  EXPECT_EQ(value_of("$half * 0 - -2 ^ 2 + 2 ^ -1"), 4.5);
  EXPECT_EQ(value_of("$pitch*(1+1.5e1)"), 192.0);
  EXPECT_EQ(value_of("$pitch * cos(60)"), 12.0 * std::cos(std::numbers::pi / 3.0));
  EXPECT_DOUBLE_EQ(value_of("$pitch * asin(0.5) * tan(atan(2)) * sin(90) / acos(0)"), 8.0);
  EXPECT_EQ(value_of("$half*pi"), 6.0 * std::numbers::pi);
  EXPECT_EQ(value_of("= 2 * (3 + 4)"), 14.0);
}

/// Everything after knows numbers only: the same experiment, but for the section itself.
TEST(Values, StandForNumbersEverywhere)
{
  Node named = read_ok(text_of(R"({ "L": 12 })", "$L")).resolved;
  std::erase_if(named.members, [](const auto& member) { return member.first == "values"; });
  EXPECT_EQ(write_json(named), write_json(read_ok(valid_text()).resolved));
  const Node kept = read_ok(text_of(R"({ "L": "$M + 2", "M": 10 })", "$L")).resolved;
  EXPECT_EQ(kept.at("values").at("L").number, 12.0);
  // What was resolved is an experiment again.
  EXPECT_EQ(write_json(read_ok(write_json(kept)).resolved), write_json(kept));
}

TEST(Values, AreReplacedByNameOnTheCommandLine)
{
  const Experiment e = read_ok(text_of(R"({ "L": 3, "M": "=4 * $L" })", "$M"), {"/values/L=4"});
  EXPECT_EQ(e.scene.lattice.at(0).x(), 16.0);
}

std::string message(const std::string& values, const std::string& expression)
{
  return problems_of(text_of(values, expression));
}

TEST(Values, MistakesAreNamedWithTheirPlace)
{
  const auto says = [](const std::string& expression, const std::string& what,
                       const std::string& values = R"({ "pitch": 12 })") {
    const std::string found = message(values, expression);
    EXPECT_NE(found.find("/cell/vectors/0/0"), std::string::npos) << found;
    EXPECT_NE(found.find("'" + expression + "': " + what), std::string::npos) << found;
  };
  says("$pich", "there is no value 'pich'; did you mean 'pitch'?");
  says("$pitch +", "it ends where a number is expected");
  says("$pitch 2", "'2' was not expected");
  says("$", "'$' without a name");
  says("$pitch * (2", "')' is missing");
  says("$pitch * pitch", "'pitch' is no function; a named value is written $pitch");
  says("$pitch / 0", "it comes to no finite number");
  says("$pitch * sqrt(-1)", "it comes to no finite number");
  says("$a", "the value 'a' depends on itself", R"({ "a": "$b", "b": "$a" })");
  says("$a", "the value 'a' is no number", R"({ "a": true })");
  says("$" + std::string(2000, 'a'), "longer than 1000 characters");
  says("$pitch*" + std::string(100, '('), "nested more than", R"({ "pitch": 1 })");
  EXPECT_NE(problems_of(text_of("", "$L")).find("there is no value 'L'"), std::string::npos);
}

/// Each value is worked out once, and a long row of them does not exhaust the stack.
TEST(Values, ManyOnesAreNoWork)
{
  std::string doubled = R"({ "a0": 1)", chain = "{ ";
  for (int k = 1; k <= 45; ++k)
    doubled += ", \"a" + std::to_string(k) + "\": \"$a" + std::to_string(k - 1) + "+$a" +
               std::to_string(k - 1) + "\"";
  const Experiment e = read_ok(text_of(doubled + " }", "$a45 / 2 ^ 42"));
  EXPECT_EQ(e.scene.lattice.at(0).x(), 8.0);
  for (int k = 0; k < 20000; ++k)
    chain += "\"b" + std::to_string(k) + "\": \"$b" + std::to_string(k + 1) + "\", ";
  EXPECT_NE(message(chain + R"("b20000": 1 })", "$b0").find("depends on more than 50 values in a row"),
            std::string::npos);
}

TEST(Values, NamesAreLeftAlone)
{
  EXPECT_EQ(problems_of(with(valid_text(), "\"name\": \"", "\"name\": \"$")), "");
  EXPECT_EQ(problems_of(with(valid_text(), "\"name\": \"", "\"name\": \"=")), "");
}

}  // namespace
}  // namespace hauberk::test
