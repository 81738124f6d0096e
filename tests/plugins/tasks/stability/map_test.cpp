/// Counts, tables and the picture of a map.

#include "document/json_text.hpp"
#include "tasks/stability/stability_results.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hauberk {
namespace {

StabilityCase entry(std::size_t member, std::size_t method, Outcome outcome)
{
  StabilityCase c;
  c.member = member;
  c.method = method;
  c.sense = "stretch";
  c.status = "locked";
  c.value = 0.25;
  c.outcome = outcome;
  return c;
}

StabilityMap sample()
{
  StabilityMap map;
  map.tolerance = 1e-6;
  map.methods = {"one", "two"};
  map.families = {{"rings, \"thin\"", "they are <thin>", {"0.1", "0.01"}, true}};
  map.cases = {entry(0, 0, Outcome::verified), entry(0, 0, Outcome::local),
               entry(0, 1, Outcome::honest_failure), entry(1, 0, Outcome::silent_wrong),
               entry(1, 1, Outcome::verified)};
  map.cases[3].reason = "intersects, by 0.1";
  return map;
}

TEST(Map, CountsByFamilyAndMethod)
{
  const StabilityMap map = sample();
  EXPECT_EQ(count_outcomes(map, {}, {}), (OutcomeCounts{2, 1, 1, 1, 0}));
  EXPECT_EQ(count_outcomes(map, 0, 0), (OutcomeCounts{1, 1, 0, 1, 0}));
  EXPECT_EQ(count_outcomes(map, {}, 1), (OutcomeCounts{1, 0, 1, 0, 0}));
  EXPECT_EQ(worst_outcome(map, 0, 0, 0), Outcome::local);
  EXPECT_EQ(worst_outcome(map, 0, 1, 0), Outcome::silent_wrong);
  EXPECT_EQ(worst_outcome(map, 1, 0, 0), Outcome::interrupted);
}

TEST(Map, DocumentHasCountsThatCanBeExpected)
{
  const boost::json::value document = stability_json(sample());
  EXPECT_EQ(document.at_pointer("/counts/silent_wrong").as_int64(), 1);
  EXPECT_EQ(document.at_pointer("/methods/1/counts/honest_failure").as_int64(), 1);
  EXPECT_EQ(document.at_pointer("/families/0/methods/0/counts/local").as_int64(), 1);
  EXPECT_EQ(document.at_pointer("/cases/3/member").as_string(), "0.01");
  EXPECT_EQ(document.at_pointer("/cases/3/reason").as_string(), "intersects, by 0.1");
}

TEST(Map, TableHasARowPerCaseAndQuotesNames)
{
  const std::string text = stability_csv(sample());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6);
  EXPECT_NE(
      text.find(
          "\"rings, \"\"thin\"\"\",0.01,one,0,stretch,silent_wrong,\"intersects, by 0.1\",locked,0.25,"),
      std::string::npos)
      << text;
}

TEST(Map, PictureShowsEveryCellByColourAndInitial)
{
  const std::string text = stability_svg(sample(), "a & b");
  EXPECT_NE(text.find("a &amp; b"), std::string::npos);
  EXPECT_NE(text.find("rings, &quot;thin&quot;"), std::string::npos);
  const auto count = [&text](const std::string& what) {
    int n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
  };
  // One in the legend, one per cell with that worst outcome.
  EXPECT_EQ(count(">V<"), 2);
  EXPECT_EQ(count(">L<"), 2);
  EXPECT_EQ(count(">F<"), 2);
  EXPECT_EQ(count(">W<"), 2);
  EXPECT_EQ(count("#f28b82"), 2);
  EXPECT_EQ(stability_svg(sample(), "a & b"), text);
}

}  // namespace
}  // namespace hauberk
