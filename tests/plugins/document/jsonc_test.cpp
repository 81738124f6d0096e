#include "document/jsonc.hpp"

#include "document/diagnostics.hpp"
#include "document/json_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace hauberk {
namespace {

/// The problems of a text, as printed for a file named f.
std::string problems_in(const std::string& text)
{
  Diagnostics diagnostics;
  diagnostics.file = "f";
  read_jsonc(text, diagnostics.problems);
  return diagnostics.text();
}

Node parsed(const std::string& text)
{
  Problems problems;
  std::optional<Node> node = read_jsonc(text, problems);
  EXPECT_TRUE(node && problems.empty()) << text;
  return node.value_or(Node{});
}

TEST(Jsonc, KnowsLineAndPointerOfEveryValue)
{
  const Node root = parsed("// first\n{ \"a/b\": [1, /* two\nlines */ {\"~\": true,},\n], \"\": null }");
  EXPECT_EQ(root.line, 2);
  EXPECT_EQ(root.pointer, "");
  const Node& list = root.at("a/b");
  EXPECT_EQ(list.pointer, "/a~1b");
  ASSERT_EQ(list.items.size(), 2u);
  EXPECT_EQ(list.items[0].line, 2);
  EXPECT_EQ(list.items[1].line, 3);
  EXPECT_EQ(list.items[1].at("~").pointer, "/a~1b/1/~0");
  EXPECT_TRUE(list.items[1].at("~").boolean);
  EXPECT_EQ(root.at("").line, 4);
  EXPECT_EQ(root.at("").pointer, "/");
  EXPECT_EQ(pointer_key("a~1b~0~01"), "a/b~~1");
}

TEST(Jsonc, ReadsNumbersToTheLastBit)
{
  EXPECT_EQ(parsed("0.1").number, 0.1);
  EXPECT_EQ(parsed("-1.7976931348623157e308").number, -std::numeric_limits<double>::max());
  EXPECT_EQ(parsed("4.9406564584124654e-324").number, std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parsed("1e-999").number, 0.0);
  EXPECT_EQ(parsed("0.000e999999999999999999999999").number, 0.0);
  EXPECT_EQ(parsed("0E0").number, 0.0);
  EXPECT_TRUE(std::signbit(parsed("-0").number));
}

TEST(Jsonc, ReadsEscapes)
{
  EXPECT_EQ(parsed(R"("\"\\\/\b\f\n\r\t")").string, "\"\\/\b\f\n\r\t");
  EXPECT_EQ(parsed(R"("\u00e9\u20AC\ud83d\ude00")").string, "é€😀");
  EXPECT_EQ(parsed("\xEF\xBB\xBF 1").number, 1.0);
}

TEST(Jsonc, NamesPlaceExpectedAndFound)
{
  EXPECT_EQ(problems_in(""), "f:1: syntax error at column 1: expected a value, found end of file");
  EXPECT_EQ(problems_in("{\n  \"a\": 1\n  \"b\": 2\n}"),
            "f:3: syntax error at column 3: expected ',' or '}', found '\"'");
  EXPECT_EQ(problems_in("{ \"a\": [1 2] }"),
            "f:1: /a: syntax error at column 11: expected ',' or ']', found '2'");
  EXPECT_EQ(problems_in("{ a: 1 }"),
            "f:1: syntax error at column 3: expected a key in double quotes or '}', found 'a'");
  EXPECT_EQ(problems_in("{ \"a\" 1 }"),
            "f:1: syntax error at column 7: expected ':' after key 'a', found '1'");
  EXPECT_EQ(problems_in("[tru]"), "f:1: /0: syntax error at column 2: expected a value, found 'tru'");
  EXPECT_EQ(problems_in("[,]"), "f:1: /0: syntax error at column 2: expected a value, found ','");
  EXPECT_EQ(problems_in("[1] x"), "f:1: syntax error at column 5: expected end of file, found 'x'");
  EXPECT_EQ(problems_in("[\"é\", é]"), "f:1: /1: syntax error at column 7: expected a value, found 'é'");
  EXPECT_EQ(problems_in("[\"abc\n\"]"),
            "f:1: /0: syntax error at column 6: expected '\"' at the end of the string");
  EXPECT_EQ(problems_in("\n/* x"),
            "f:2: syntax error at column 5: expected '*/' for the comment opened on line 2, "
            "found end of file");
  EXPECT_EQ(problems_in("\"a\x01\""),
            "f:1: syntax error at column 3: control characters in strings must be escaped");
  EXPECT_EQ(problems_in("\"\\x\""),
            "f:1: syntax error at column 2: expected one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u");
  EXPECT_EQ(problems_in("\"\\u12g4\""),
            "f:1: syntax error at column 2: expected four hexadecimal digits after \\u");
  EXPECT_EQ(problems_in("\"\\ud800x\""), "f:1: syntax error at column 2: surrogate without its partner");
}

TEST(Jsonc, RefusesWhatJsonDoesNotAllow)
{
  for (const char* text : {"01", "1.", ".5", "+1", "1e", "-", "0x10", "1_000", "--1", "1e5.5"}) {
    EXPECT_EQ(problems_in(text),
              std::string("f:1: syntax error at column 1: expected a value, found '") + text + "'");
  }
}

TEST(Jsonc, ReportsNumbersThatAreNotFiniteAndGoesOn)
{
  EXPECT_EQ(
      problems_in("[1e999,\n -1e999, NaN, -Infinity]"),
      "f:1: /0: expected a finite number, found 1e999, which is beyond the largest double (about 1.8e308)\n"
      "f:2: /1: expected a finite number, found -1e999, which is beyond the largest double (about 1.8e308)\n"
      "f:2: /2: expected a finite number, found NaN\n"
      "f:2: /3: expected a finite number, found -Infinity");
}

TEST(Jsonc, ReportsDuplicateKeysWithBothLines)
{
  EXPECT_EQ(problems_in("{ \"a\": 1,\n\n \"a\": 2, \"b\": {\"c\": 1, \"c\": 1} }"),
            "f:3: /a: duplicate key 'a': first given on line 1\n"
            "f:3: /b/c: duplicate key 'c': first given on line 3");
}

TEST(Jsonc, ChecksUtf8)
{
  const std::string message = "f:2: syntax error at column 3: expected UTF-8 text, found the byte ";
  EXPECT_EQ(problems_in("\n\"\xC3\xA9\xFF\""), message + "0xff");
  EXPECT_EQ(problems_in("\n\"a\xC0\xAF\""), message + "0xc0");          // overlong
  EXPECT_EQ(problems_in("\n\"a\xED\xA0\x80\""), message + "0xed");      // surrogate
  EXPECT_EQ(problems_in("\n\"a\xF4\x90\x80\x80\""), message + "0xf4");  // beyond U+10FFFF
  EXPECT_EQ(problems_in("\n\"a\xE2\x82"), message + "0xe2");            // cut off
}

TEST(Jsonc, RefusesDeepNesting)
{
  const std::string good = std::string(64, '[') + std::string(64, ']');
  EXPECT_EQ(problems_in(good), "");
  const std::string text = problems_in(std::string(1000000, '['));
  EXPECT_NE(text.find("nested deeper than 64 levels"), std::string::npos) << text.substr(0, 200);
}

/// A tree of random values, as deep as `depth`.
Node random_node(std::mt19937_64& random, int depth)
{
  Node node;
  switch (random() % (depth > 0 ? 6 : 4)) {
    case 0:
      break;
    case 1:
      node.type = Node::Type::boolean;
      node.boolean = random() % 2 == 0;
      break;
    case 2: {
      node.type = Node::Type::number;
      std::uint64_t bits = random();
      std::memcpy(&node.number, &bits, sizeof bits);
      if (!std::isfinite(node.number)) node.number = static_cast<double>(bits % 1000);
      break;
    }
    case 3:
      node.type = Node::Type::string;
      for (std::uint64_t k = random() % 6; k > 0; --k) node.string += "a\"\\\n\x01/~ "[random() % 8];
      break;
    case 4:
      node.type = Node::Type::array;
      for (std::uint64_t k = random() % 5; k > 0; --k) node.items.push_back(random_node(random, depth - 1));
      break;
    default:
      node.type = Node::Type::object;
      for (std::uint64_t k = 0, n = random() % 5; k < n; ++k) {
        node.members.emplace_back("k" + std::to_string(k), random_node(random, depth - 1));
      }
  }
  return node;
}

void expect_same(const Node& a, const Node& b)
{
  ASSERT_EQ(a.type, b.type);
  EXPECT_EQ(a.boolean, b.boolean);
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.string, b.string);
  ASSERT_EQ(a.items.size(), b.items.size());
  for (std::size_t k = 0; k < a.items.size(); ++k) expect_same(a.items[k], b.items[k]);
  ASSERT_EQ(a.members.size(), b.members.size());
  for (std::size_t k = 0; k < a.members.size(); ++k) {
    EXPECT_EQ(a.members[k].first, b.members[k].first);
    expect_same(a.members[k].second, b.members[k].second);
  }
}

TEST(Jsonc, WhatIsWrittenReadsBackAsTheSame)
{
  std::mt19937_64 random(7);
  for (int k = 0; k < 500; ++k) {
    const Node node = random_node(random, 5);
    expect_same(parsed(write_json(node)), node);
  }
}

TEST(Jsonc, DamagedTextNeverCrashesTheReader)
{
  std::mt19937_64 random(11);
  int refused = 0;
  for (int k = 0; k < 5000; ++k) {
    std::string text = write_json(random_node(random, 5)) + " // end";
    for (std::uint64_t n = random() % 4; n > 0 && !text.empty(); --n) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, random() % 5);
          break;
        default:
          text.insert(at, 1, "{}[],:\"\\/*1e-."[random() % 14]);
      }
    }
    Problems problems;
    const std::optional<Node> node = read_jsonc(text, problems);
    EXPECT_TRUE(node.has_value() || !problems.empty());
    refused += !problems.empty();
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace hauberk
