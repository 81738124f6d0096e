/// Messages about structure: types, ranges, keys. One edit of a correct file each.

#include "fake_plugins.hpp"

#include <hauberk/suggestion.hpp>

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

std::string after(const std::string& from, const std::string& to)
{
  return problems_of(with(valid_text(), from, to));
}

TEST(Structure, TheUneditedFileIsCorrect) { EXPECT_EQ(problems_of(valid_text()), ""); }

TEST(Structure, WrongTypes)
{
  EXPECT_EQ(problems_of("[]"), "t.json:1: expected an object, found an empty array");
  EXPECT_EQ(after("\"pair\"", "5"), "t.json:2: /name: expected a string, found 5");
  EXPECT_EQ(after("\"tolerance\": 1e-3", "\"preset\": {}"),
            "t.json:14: /solver/preset: expected one of accurate, paper, found an object");
  EXPECT_EQ(after("\"lower\": 4.0", "\"lower\": \"4\""),
            "t.json:17: /design/variables/0/lower: expected a number, found \"4\"");
  EXPECT_EQ(after("\"parameters\": \"ring.R\"", "\"parameters\": null"),
            "t.json:17: /design/variables/0/parameters: expected a string or an array of at least 1 strings, "
            "found null");
  EXPECT_EQ(after("[6, 0, 0]", "[6, 0]"),
            "t.json:11: /cell/place/1/position: expected an array of 3 numbers, found an array of 2 values");
  EXPECT_EQ(after("[0, 100]]", "[0, \"x\"]]"), "t.json:8: /cell/vectors/1/1: expected a number, found \"x\"");
}

TEST(Structure, RangesAndChoices)
{
  EXPECT_EQ(after("\"tolerance\": 1e-3", "\"preset\": \"papr\""),
            "t.json:14: /solver/preset: expected one of accurate, paper, found \"papr\"; did you "
            "mean 'paper'?");
  EXPECT_EQ(after("\"tolerance\": 1e-3", "\"preset\": \"fast\""),
            "t.json:14: /solver/preset: expected one of accurate, paper, found \"fast\"; it took as long as "
            "accurate: leave preset away, or set tolerance to 1e-3 for gaps as wide");
  EXPECT_EQ(after("\"tolerance\": 1e-3", "\"clearance\": -0.1"),
            "t.json:14: /solver/clearance: expected a number >= 0, found -0.1");
  EXPECT_EQ(after("\"tolerance\": 1e-3", "\"starts\": 0"),
            "t.json:14: /solver/starts: expected an integer >= 1, found 0");
  EXPECT_EQ(after("\"tolerance\": 1e-3", "\"starts\": 1.5"),
            "t.json:14: /solver/starts: expected an integer >= 1, found 1.5");
  EXPECT_EQ(after("\"tolerance\": 1e-3", "\"starts\": 1e300"),
            "t.json:14: /solver/starts: expected an integer >= 1, found 1e+300");
  EXPECT_EQ(after("\"value\": 0.05", "\"value\": 0.05, \"weight\": 0"),
            "t.json:18: /design/targets/0/weight: expected a number > 0, found 0");
  EXPECT_EQ(after("\"value\": 0.05", "\"value\": 0.05, \"published\": \"5 %\""),
            "t.json:18: /design/targets/0/published: expected a number, found \"5 %\"");
  EXPECT_EQ(after("\"place\": [", "\"repeat\": [2, 0], \"place\": ["),
            "t.json:9: /cell/repeat/1: expected an integer >= 1, found 0");
  EXPECT_EQ(after("\"place\": [", "\"repeat\": [2], \"place\": ["),
            "t.json:9: /cell/repeat: expected one number for each of the 2 vectors, found 1");
}

TEST(Structure, PublishedResultsOfADesign)
{
  const auto published = [](const std::string& text) {
    return after("\"quantity\": \"eta\",", "\"quantity\": \"eta\", \"published\": {" + text + "},");
  };
  EXPECT_EQ(published(R"("source": "a book", "lowest": 0.1, "highest": 0.1, "iterations": 3)"), "");
  EXPECT_EQ(published(""), "t.json:16: /design/published: missing key 'source': expected a string");
  EXPECT_EQ(published(R"("source": "a book", "iterations": 0)"),
            "t.json:16: /design/published/iterations: expected an integer >= 1, found 0");
  EXPECT_EQ(published(R"("source": "a book", "lowest": 0.1)"),
            "t.json:16: /design/published: 'lowest' and 'highest' belong together; 'highest' is missing");
  EXPECT_EQ(published(R"("source": "a book", "highest": 0.1)"),
            "t.json:16: /design/published: 'lowest' and 'highest' belong together; 'lowest' is missing");
  EXPECT_EQ(published(R"("source": "a book", "lowest": 0.1, "highest": 0.05)"),
            "t.json:16: /design/published/highest: expected at least 'lowest', which is 0.1, found 0.05");
  EXPECT_EQ(published(R"("source": "a book", "profile": [[0, 0.1]], "measured": [[0, 0.1, 0.2]])"), "");
  EXPECT_EQ(published(R"("source": "a book", "measured": [[0, 0.1, 0.2], [90, 0.2, 0.1]])"),
            "t.json:16: /design/published/measured/1: expected direction, smallest and largest value, in "
            "this order");
}

TEST(Structure, UnknownKeysNameTheNearest)
{
  EXPECT_EQ(after("\"tolerance\"", "\"tolerence\""),
            "t.json:14: /solver/tolerence: unknown key 'tolerence'; did you mean 'tolerance'?");
  EXPECT_EQ(after("\"name\": \"pair\"", "\"name\": \"pair\", \"Seed\": 1"),
            "t.json:2: /Seed: unknown key 'Seed'; did you mean 'seed'?");
  // A key of a plugin counts as known.
  EXPECT_EQ(after("\"directions_deg\"", "\"mesure\": \"paper\", \"directions_deg\""),
            "t.json:13: /load_case/mesure: unknown key 'mesure'; did you mean 'measure'?");
  EXPECT_EQ(after("\"search\"", "\"search\", \"step\": 5"),
            "t.json:16: /design/optimizer/step: unknown key 'step'; did you mean 'steps'?");
}

TEST(Structure, MissingKeys)
{
  EXPECT_EQ(after("\"name\": \"pair\",", ""), "t.json:1: missing key 'name': expected a string");
  EXPECT_EQ(after("\"element\": \"link\", \"position\": [0, 0, 0]", "\"element\": \"link\""),
            "t.json:10: /cell/place/0: missing key 'position': expected an array of 3 numbers");
  EXPECT_EQ(after("\"shape\": \"rings\", ", ""),
            "t.json:4: /elements/link: missing key 'shape': expected a string");
  EXPECT_EQ(after("\"rings\": [ { \"name\": \"ring\" } ],", ""),
            "t.json:4: /elements/link: missing key 'rings': expected an array of at least 1 objects");
  EXPECT_EQ(after("\"quantity\": \"eta\",", ""),
            "t.json:15: /design: missing key 'quantity': expected one of eta, stretch, compress, curvature");
  EXPECT_EQ(after("\"targets\": [ { \"direction_deg\": 0, \"value\": 0.05 } ],", ""),
            "t.json:15: /design: missing key 'targets': expected an array of at least 1 objects");
}

TEST(Structure, EmptyLists)
{
  EXPECT_EQ(after("[ { \"direction_deg\": 0, \"value\": 0.05 } ]", "[]"),
            "t.json:18: /design/targets: expected an array of at least 1 objects, found an empty array");
  EXPECT_EQ(
      after("[0, 30]", "[]"),
      "t.json:13: /load_case/directions_deg: expected an array of at least 1 numbers, found an empty array");
  const std::string text =
      with(valid_text(), "      { \"element\": \"link\", \"position\": [0, 0, 0] },\n", "");
  EXPECT_EQ(
      problems_of(with(text,
                       "      { \"element\": \"link\", \"position\": [6, 0, 0], \"rotation\": { \"axis\": "
                       "[1, 0, 0], \"degrees\": 90 } },\n",
                       "")),
      "t.json:9: /cell/place: expected an array of at least 1 objects, found an empty array");
}

TEST(Structure, AFileWithOnlySyntaxErrorsOrNothing)
{
  EXPECT_EQ(problems_of("{"),
            "t.json:1: syntax error at column 2: expected a key in double quotes or '}', found end of file");
  EXPECT_EQ(problems_of("{}"),
            "t.json:1: missing key 'name': expected a string\n"
            "t.json:1: missing key 'elements': expected an object\n"
            "t.json:1: missing key 'cell': expected an object\n"
            "t.json:1: missing key 'load_case': expected an object");
}

TEST(Structure, NumbersThatAreNotFiniteAreReportedOnce)
{
  EXPECT_EQ(after("\"ring.R\": 5.0", "\"ring.R\": NaN"),
            "t.json:5: /elements/link/parameters/ring.R: expected a finite number, found NaN");
  EXPECT_EQ(after("[6, 0, 0]", "[6, 1e999, 0]"),
            "t.json:11: /cell/place/1/position/1: expected a finite number, found 1e999, which is beyond the "
            "largest double (about 1.8e308)");
}

TEST(Structure, ProblemsStayOnOneLineEach)
{
  EXPECT_EQ(
      after("\"name\": \"pair\"", "\"name\": \"pair\", \"a\\nb\\u001b\": 1"),
      "t.json:2: /a\\x0ab\\x1b: unknown key 'a\\x0ab\\x1b'; known: '$schema', 'extends', 'name', 'description', "
      "'task', 'length_unit', 'values', 'seed', "
      "'elements', 'cell', 'load_case', 'solver', 'design', 'sweep', 'chart', 'stability', "
      "'transition', 'expect'");
}

TEST(Structure, SeveralMistakesAreReportedTogetherInTheOrderOfTheFile)
{
  std::string text = valid_text();
  text = with(text, "\"ring.R\": 5.0", "\"ring.R\": -5.0");
  text = with(text, "\"link\", \"position\": [6", "\"lnk\", \"position\": [6");
  text = with(text, "[0, 30]", "[0, 30, 210]");
  text = with(text, "\"tolerance\": 1e-3",
              "\"preset\": \"accurate\", \"preset\": \"paper\", \"contakt\": \"arc\"");
  text = with(text, "\"lower\": 4.0", "\"lower\": 7.0");
  text = with(text, "\"value\": 0.05", "\"value\": -0.05");
  EXPECT_EQ(problems_of(text),
            "t.json:5: /elements/link/parameters/ring.R: expected a number in [0, 1000000], found -5\n"
            "t.json:11: /cell/place/1/element: unknown element 'lnk'; did you mean 'link'?\n"
            "t.json:13: /load_case/directions_deg/2: direction 210 is the same as 30: directions count "
            "modulo 180 degrees\n"
            "t.json:14: /solver/preset: duplicate key 'preset': first given on line 14\n"
            "t.json:14: /solver/contakt: unknown key 'contakt'; did you mean 'contact'?\n"
            "t.json:17: /design/variables/0: expected lower < upper, found lower 7 and upper 6.5\n"
            "t.json:18: /design/targets/0/value: expected a number >= 0 for eta, found -0.05");
}

TEST(Nearest, CountsHalfSteps)
{
  EXPECT_EQ(edit_distance("", "abc"), 6u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 6u);
  EXPECT_EQ(edit_distance("ab", "ba"), 2u);
  EXPECT_EQ(edit_distance("Ab", "ab"), 1u);
  EXPECT_EQ(nearest_name("Ring.r", {"Ring.R", "Xing.r"}), "Ring.R");
  EXPECT_EQ(nearest_name("x", {}), "");
  // Up to a third of the letters may be wrong: "bar" is no slip of the pen for "ring".
  EXPECT_EQ(nearest_name("bar", {"ring", "solver"}), "");
  EXPECT_EQ(suggestion("bar", {"ring", "solver"}), "; known: 'ring', 'solver'");
  EXPECT_EQ(suggestion("bar", {"ring", "solver", "ring"}), "; known: 'ring', 'solver'");
  std::vector<std::string> many;
  for (int k = 0; k < 24; ++k) many.push_back("name_" + std::to_string(k));
  const std::string all = suggestion("bar", many);
  EXPECT_EQ(all.substr(all.size() - 9), "'name_23'");
  many.push_back("name_24");
  EXPECT_EQ(suggestion("bar", many), all + ", ...");
  EXPECT_EQ(suggestion("rong", {"ring", "solver"}), "; did you mean 'ring'?");
  EXPECT_EQ(did_you_mean("bar", {"ring"}), "");
}

}  // namespace
}  // namespace hauberk::test
