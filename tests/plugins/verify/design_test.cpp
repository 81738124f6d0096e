#include "chain_document.hpp"

#include <hauberk/verify/verify.hpp>

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

namespace hauberk {
namespace {

namespace json = boost::json;
using test::Chain;
using test::chain_document;

/// A "design" of the stretch limit from r_B = 0.7 to 0.6: 0.43333 before, 0.45 after, target 0.46.
json::value design_document()
{
  const json::value before = chain_document();
  json::value document = chain_document(Chain{.r_b = 0.6});
  const double first = before.at_pointer("/limits/0/value").as_double();
  const double last = document.at_pointer("/limits/0/value").as_double();
  const auto objective = [](double value) { return 0.5 * 2.0 * (value - 0.46) * (value - 0.46); };
  const auto variable = [](const std::string& scope, int element, double final) {
    return json::value{{"name", scope + "/ring.r0=ring.r1"},
                       {"initial", 0.7},
                       {"final", final},
                       {"lower", 0.5},
                       {"upper", 0.8},
                       {"elements", json::array{element}}};
  };
  const auto iterate = [&](int k, double value) {
    return json::value{{"iteration", k}, {"objective", objective(value)}, {"values", json::array{value}}};
  };
  json::object& experiment = document.at("experiment").as_object();
  experiment["task"] = "design";
  experiment["design"] = {
      {"quantity", "stretch"},
      {"variables", json::array{json::value{{"parameters", {"ring.r0", "ring.r1"}},
                                            {"tied", true},
                                            {"per", "element"},
                                            {"lower", 0.5},
                                            {"upper", 0.8}}}},
      {"targets", json::array{json::value{{"direction_deg", 180.0}, {"value", 0.46}, {"weight", 2.0}}}}};
  // The experiment has the initial shape.
  experiment["elements"] = before.at_pointer("/experiment/elements");
  document.at("design") = {{"quantity", "stretch"},
                           {"objective_initial", objective(first)},
                           {"objective", objective(last)},
                           {"variables", {variable("0", 0, 0.7), variable("1", 1, 0.6)}},
                           {"targets", json::array{json::value{{"direction_deg", 180.0},
                                                               {"target", 0.46},
                                                               {"weight", 2.0},
                                                               {"initial", first},
                                                               {"provisional", last},
                                                               {"recomputed", last},
                                                               {"better_state", false},
                                                               {"met", true}}}},
                           {"start", 0},
                           {"starts", json::array{json::value{{"start", 0}, {"objective", objective(last)}}}},
                           {"history", {iterate(0, first), iterate(1, last)}},
                           {"initial", {{"scene", before.at("scene")}, {"limits", before.at("limits")}}}};
  return document;
}

std::string report(const json::value& document) { return verify(document).text(); }

TEST(Design, TrueDesignPasses)
{
  const VerifyReport checked = verify(design_document());
  EXPECT_TRUE(checked.ok) << checked.text();
  EXPECT_EQ(checked.lines.size(), 6u) << "final limit, profiles, initial limit, design, both scenes";
}

TEST(Design, WhatDoesNotFollowIsCaught)
{
  const auto tampered = [](const char* pointer, const json::value& v) {
    json::value document = design_document();
    document.at_pointer(pointer) = v;
    return report(document);
  };
  const auto has = [](const std::string& text, const char* what) {
    return text.find(what) != std::string::npos;
  };
  EXPECT_TRUE(has(tampered("/design/targets/0/recomputed", 0.46), "recomputed 0.46 reported, 0.45"));
  EXPECT_TRUE(
      has(tampered("/design/targets/0/initial", nullptr), "initial null reported, 0.4333333333 from"));
  EXPECT_TRUE(has(tampered("/design/targets/0/met", false), "met should be true"));
  EXPECT_TRUE(has(tampered("/design/objective", 0.0), "/design/objective: 0 reported"));
  EXPECT_TRUE(has(tampered("/design/variables/1/final", 0.65),
                  "FAIL /scene: elements/1: primitives are not what its shape makes of its parameters"));
  EXPECT_TRUE(has(tampered("/design/variables/1/upper", 0.65), "0.7 is outside [0.5, 0.65]"));
  EXPECT_TRUE(has(tampered("/design/variables/1/lower", 0.55),
                  "/design/variables/1: bounds are not the experiment's"));
  EXPECT_TRUE(
      has(tampered("/design/variables/0/elements/0", 1), "/elements: not those that the variable is of"));
  EXPECT_TRUE(
      has(tampered("/design/history/1/values/0", 0.4501), "/design/history/1/objective: 0.0001 reported"));
  EXPECT_TRUE(has(tampered("/design/targets/0/target", 0.461), "/design/targets/0: not the experiment's"));
  EXPECT_TRUE(has(tampered("/design/quantity", "colour"), "/design/quantity: \"colour\" is not known here"));
  EXPECT_TRUE(has(tampered("/design/initial/limits/0/value", 0.4), "FAIL /design/initial/limits/0"));
}

/// The bound that the final value keeps, and the initial one, too.
TEST(Design, BoundsAreCheckedAsBounds)
{
  const auto bounded = [](const char* asked, const char* reported, bool met, double objective) {
    json::value document = design_document();
    document.at_pointer("/experiment/design/targets/0").as_object()["aim"] = asked;
    document.at_pointer("/design/targets/0").as_object()["aim"] = reported;
    document.at_pointer("/design/targets/0/met") = met;
    for (const char* pointer : {"/design/objective", "/design/objective_initial",
                                "/design/history/0/objective", "/design/history/1/objective"})
      document.at_pointer(pointer) = objective;
    return document;
  };
  // 0.4333 and 0.45 for 0.46.
  const VerifyReport checked = verify(bounded("no_further", "no_further", true, 0.0));
  EXPECT_TRUE(checked.ok) << checked.text();
  const std::string broken = report(bounded("no_nearer", "no_nearer", true, 0.0));
  EXPECT_NE(broken.find("met should be false"), std::string::npos)
      << "2 % beyond a bound is not met: " << broken;
  EXPECT_NE(broken.find("/design/objective: 0 reported, 0.0001"), std::string::npos) << broken;
  const std::string other = report(bounded("no_nearer", "no_further", true, 0.0));
  EXPECT_NE(other.find("/design/targets/0: not the experiment's"), std::string::npos) << other;
  EXPECT_NE(report(bounded("sideways", "sideways", true, 0.0)).find("\"sideways\" is not known here"),
            std::string::npos);
}

TEST(Profiles, OnlyLockedLimitsCount)
{
  json::value document = chain_document();
  document.at_pointer("/limits/0/status") = "stalled";
  EXPECT_NE(report(document).find("e_s: 0.4333333333 reported, null from the limits"), std::string::npos);
  document.at_pointer("/profiles/0/e_s") = nullptr;
  EXPECT_TRUE(verify(document).ok) << report(document);
}

TEST(Profiles, EtaFollowsFromBothSenses)
{
  json::value document = chain_document();
  json::value compressed = document.at_pointer("/limits/0");
  auto& limit = compressed.as_object();
  limit["sense"] = "compress";
  limit["status"] = "stalled";
  for (const char* key : {"value", "line_stretch", "min_gap", "force_balance"}) limit[key] = nullptr;
  for (const char* key : {"poses", "contacts", "starts"}) limit[key].emplace_array();
  limit["contact"] = "";
  document.at("limits").as_array().push_back(compressed);
  document.at_pointer("/experiment/load_case/senses") = {"stretch", "compress"};
  EXPECT_TRUE(verify(document).ok) << report(document);
  document.at_pointer("/profiles/0/eta") = 0.5;
  EXPECT_NE(report(document).find("FAIL profiles: /profiles/0/eta: 0.5 reported, null from the limits"),
            std::string::npos);
}

}  // namespace
}  // namespace hauberk
