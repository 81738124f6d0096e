/// The rules by which fields are checked, and what is said of fields that no rule knows.

#include "chain_document.hpp"

#include <hauberk/verify/verify.hpp>

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace hauberk {
namespace {

using test::chain_document;

VerifyField field(const VerifyReport& report, const std::string& pointer)
{
  for (const VerifyField& f : report.fields)
    if (f.pointer == pointer) return f;
  ADD_FAILURE() << "no field " << pointer;
  return {};
}

TEST(Rules, TheDocumentedTableIsTheirs)
{
  std::ifstream file(HAUBERK_SOURCE_DIR "/share/doc/results.md");
  std::ostringstream text;
  text << file.rdbuf();
  const std::string table = verify_rules_markdown();
  EXPECT_NE(text.str().find(table), std::string::npos) << "put this into share/doc/results.md:\n" << table;
}

TEST(Rules, EachIsReachable)
{
  for (const VerifyRule& rule : verify_rules()) {
    std::string pointer;
    for (std::size_t k = 0; k < rule.pattern.size(); ++k) {
      if (rule.pattern[k] == '*') pointer += rule.pattern.substr(k, 2) == "**" ? "zz/y" : "7";
      if (rule.pattern[k] != '*') pointer += rule.pattern[k];
      if (rule.pattern.substr(k, 2) == "**") ++k;
    }
    const VerifyRule* found = verify_rule(pointer);
    ASSERT_NE(found, nullptr) << pointer;
    EXPECT_EQ(found->pattern, rule.pattern) << pointer << ": another rule comes first";
  }
}

TEST(Rules, DocumentsInDocumentsAreReadAlike)
{
  EXPECT_EQ(without_document("/sweep/rows/12/result/limits/0/value"), "/limits/0/value");
  EXPECT_EQ(without_document("/design/initial/limits/0/value"), "/limits/0/value");
  EXPECT_EQ(without_document("/design/initial/scene/length"), "/scene/length");
  EXPECT_EQ(without_document("/sweep/rows/12/status"), "/sweep/rows/12/status");
  EXPECT_EQ(without_document("/limits/0/value"), "/limits/0/value");
}

TEST(Outcomes, EveryFieldHasOneAndTheLastLineCountsThem)
{
  const VerifyReport report = verify(chain_document());
  EXPECT_EQ(field(report, "/limits/0/value").outcome, VerifyOutcome::passed);
  EXPECT_EQ(field(report, "/limits/0/starts/0/seed").outcome, VerifyOutcome::not_checked);
  EXPECT_EQ(field(report, "/experiment/cell/vectors/0/0").outcome, VerifyOutcome::passed);
  const auto passed = std::count_if(report.fields.begin(), report.fields.end(),
                                    [](const VerifyField& f) { return f.outcome == VerifyOutcome::passed; });
  const auto left = static_cast<std::ptrdiff_t>(report.fields.size()) - passed;
  const std::string last =
      "\nfields: " + std::to_string(passed) + " passed, 0 failed, " + std::to_string(left) + " not checked\n";
  EXPECT_TRUE(report.text().ends_with(last)) << report.text();
}

TEST(Outcomes, FailedChecksFailTheirFields)
{
  boost::json::value document = chain_document();
  document.at_pointer("/limits/0/contacts/0/force") = 0.1;
  const VerifyReport report = verify(document);
  EXPECT_EQ(field(report, "/limits/0/contacts/0/force").outcome, VerifyOutcome::failed);
  EXPECT_EQ(field(report, "/limits/0/force_balance").outcome, VerifyOutcome::failed);
  EXPECT_EQ(field(report, "/limits/0/value").outcome, VerifyOutcome::passed)
      << "forces do not say anything about it";
}

TEST(Outcomes, FieldsThatNobodyKnowsAreSaidSo)
{
  boost::json::value document = chain_document();
  document.as_object()["colour"] = "red";
  document.at_pointer("/limits/0").as_object()["colours"] = {1, 2};
  const VerifyReport report = verify(document);
  EXPECT_TRUE(report.ok) << report.text();
  EXPECT_EQ(field(report, "/colour").why, "unknown");
  EXPECT_NE(report.text().find("not checked, unknown: /limits/*/colours/* (2) /colour\n"), std::string::npos)
      << report.text();
}

TEST(Outcomes, LoadCasesOfOthersAreNotFailed)
{
  boost::json::value document = chain_document();
  document.at_pointer("/experiment/load_case/plugin") = "torsion";
  document.at_pointer("/limits/0/load_case") = "torsion";
  const VerifyReport report = verify(document);
  EXPECT_TRUE(report.ok) << report.text();
  EXPECT_TRUE(
      report.text().starts_with("NONE /limits/0: the load case \"torsion\" is not known to this check\n"))
      << report.text();
  EXPECT_EQ(field(report, "/limits/0/value").outcome, VerifyOutcome::not_checked);
  EXPECT_EQ(field(report, "/scene/elements/0/primitives/0/parameters/R").outcome, VerifyOutcome::passed);
  document.at_pointer("/scene/elements/0/primitives/0/parameters/r0") = 0.71;
  EXPECT_FALSE(verify(document).ok);
}

TEST(Scenes, AreThoseOfTheExperiment)
{
  const auto text = [](const char* pointer, const boost::json::value& v) {
    boost::json::value document = chain_document();
    document.at_pointer(pointer) = v;
    return verify(document).text();
  };
  const auto has = [](const std::string& in, const char* what) { return in.find(what) != std::string::npos; };
  EXPECT_TRUE(has(text("/experiment/elements/a/parameters/ring.R", 5.001),
                  "FAIL /scene: elements/0: ring.R is 5, expected 5.001"));
  EXPECT_TRUE(has(text("/experiment/elements/b/parameters/ring.r0", 0.6),
                  "FAIL /scene: elements/1: primitives are not what its shape makes of its parameters"));
  EXPECT_TRUE(has(text("/experiment/cell/vectors/1/1", 101),
                  "FAIL /scene: cell_vectors: not those of the experiment"));
  EXPECT_TRUE(has(text("/experiment/cell/place/1/position/2", 0.001),
                  "FAIL /scene: elements/1: rest is 9.09e-05 off"));
  EXPECT_TRUE(
      has(text("/experiment/load_case/directions_deg/0", 1), "/limits/0 (0 deg, stretch): not asked for"));
  EXPECT_TRUE(has(text("/experiment/load_case/measure", "equation_12"),
                  "measure equation_12 expected, found tensor"));
}

TEST(Tasks, AreThoseThatTheCheckKnows)
{
  const auto text = [](const char* task) {
    boost::json::value document = chain_document();
    document.at("experiment").as_object()["task"] = task;
    return verify(document).text();
  };
  EXPECT_EQ(text("limits").find("FAIL"), std::string::npos);
  EXPECT_NE(text("limit").find("FAIL /experiment/task: 'limit' is no task that this check knows"),
            std::string::npos);
  EXPECT_NE(text("design").find("FAIL /design: null, a design expected"), std::string::npos);
}

TEST(Scenes, RelaxedRestIsLinkedAsPlaced)
{
  // Placed 0.1 mm aside and relaxed: what can be said is that links are those of the places, and nothing
  // overlaps.
  boost::json::value document = chain_document();
  document.at_pointer("/experiment/cell/place/1/position/2") = 0.1;
  document.at_pointer("/experiment/cell").as_object()["relax"] = true;
  EXPECT_TRUE(verify(document).ok) << verify(document).text();
  document.at_pointer("/experiment/cell/place/1/position/2") = 50.0;
  EXPECT_NE(verify(document).text().find("relaxed from its places to rest, not to the limit: linking number"),
            std::string::npos)
      << verify(document).text();
}

}  // namespace
}  // namespace hauberk
