#include "chain_document.hpp"

#include <hauberk/verify/verify.hpp>

#include <gtest/gtest.h>
#include <boost/json/object.hpp>

namespace hauberk {
namespace {

using test::Chain;
using test::chain_document;
using test::limit_line;

TEST(TrueChain, PassesForAllRadiiGapsAndClearances)
{
  for (const Chain& chain :
       {Chain{}, Chain{.gap = 0.0}, Chain{.gap = 1e-4}, Chain{.gap = 1e-11, .clearance = 0.1},
        Chain{.R_a = 5.0, .r_a = 0.7, .R_b = 4.0, .r_b = 0.5}, Chain{.axial = 0.4}, Chain{.axial = 0.9},
        Chain{.turned_deg = 30.0}, Chain{.turned_deg = 107.0}, Chain{.axial = 0.4, .turned_deg = 45.0},
        Chain{.turned_deg = 90.0, .measure = "equation_12"}}) {
    const VerifyReport report = verify(chain_document(chain));
    EXPECT_TRUE(report.ok) << report.text();
    ASSERT_EQ(report.lines.size(), 3u) << "limit, profiles, scene";
    EXPECT_NE(report.lines[0].text.find("2 links kept"), std::string::npos) << report.text();
  }
}

TEST(TrueChain, LineSaysWhatWasFound)
{
  EXPECT_EQ(limit_line(chain_document(Chain{.gap = 1e-4})).substr(0, 86),
            "PASS /limits/0 (0 deg, stretch): locked 0.4333166667: smallest gap 0.0001, 2 links kep");
}

TEST(TrueChain, TurnedChainLoadedAlongItsOldDirectionFails)
{
  // The contacts of a chain along 30 degrees carry (c^2, s^2, 2 c s) = (3/4, 1/4, 0.866), not (1, 0, 0).
  auto document = chain_document(Chain{.turned_deg = 30.0});
  document.at_pointer("/limits/0/direction_deg") = 0.0;
  const std::string line = limit_line(document);
  EXPECT_NE(line.find("forces miss the load by 0.866"), std::string::npos) << line;
}

TEST(States, WithoutPosesNeedAStatusThatSaysSo)
{
  auto document = chain_document();
  auto& limit = document.at_pointer("/limits/0").as_object();
  limit["poses"].emplace_array();
  EXPECT_EQ(limit_line(document), "FAIL /limits/0 (0 deg, stretch): locked, but no state is given");
  limit["status"] = "unbounded";
  EXPECT_EQ(limit_line(document),
            "FAIL /limits/0 (0 deg, stretch): unbounded: a value or contacts, though nothing stops it; "
            "no witness is given");
  for (const char* key : {"value", "line_stretch", "min_gap", "force_balance"}) limit[key] = nullptr;
  limit["contacts"].emplace_array();
  limit["contact"] = "";
  EXPECT_EQ(limit_line(document), "FAIL /limits/0 (0 deg, stretch): unbounded: no witness is given");
  document = chain_document();
  document.at_pointer("/limits/0/status") = "not_attained";
  EXPECT_EQ(limit_line(document),
            "FAIL /limits/0 (0 deg, stretch): not_attained limits have no locked state");
}

TEST(Walls, TakePartInTheBalance)
{
  auto document = chain_document();
  document.at_pointer("/experiment/load_case/out_of_plane") = 0.5;
  auto& contacts = document.at_pointer("/limits/0/contacts").as_array();
  const auto wall = [](double normal, double force) {
    return boost::json::value{{"elements", {1, -1}},
                              {"primitives", {0, -1}},
                              {"image", {0, 0}},
                              {"wall", "ceiling"},
                              {"points", {{8.6, 0, 0}, {8.6, 0, 0.5}}},
                              {"normal", {0, 0, normal}},
                              {"gap", 0.5},
                              {"force", force}};
  };
  contacts.push_back(wall(1.0, 0.01));
  contacts.push_back(wall(-1.0, 0.01));
  EXPECT_EQ(limit_line(document).substr(0, 4), "PASS") << limit_line(document);
  contacts.back() = wall(-1.0, 0.011);
  // 0.001 L, less the half that falls back on the element through the mean height.
  EXPECT_NE(limit_line(document).find("forces miss the load by 0.0025"), std::string::npos)
      << limit_line(document);
  contacts.back() = wall(-1.0, 0.01);
  contacts.back().at("gap") = 0.4;
  EXPECT_NE(limit_line(document).find("contact 3: gap 0.4 listed, 0.5 found"), std::string::npos);
}

}  // namespace
}  // namespace hauberk
