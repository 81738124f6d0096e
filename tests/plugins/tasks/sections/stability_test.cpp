/// Families and methods of a stability experiment, and the ordinary experiments made of them.

#include "fake_plugins.hpp"
#include "tasks/design/design_section.hpp"
#include "tasks/stability/stability_section.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

const std::string section = R"("stability": {
  "methods": [ { "name": "plain" }, { "name": "arc", "set": { "/solver/contact": "arc" } } ],
  "families": [ { "name": "thin", "set": { "/load_case/directions_deg": [90], "/solver/starts": 3 },
    "vary": [ { "pointer": ["/elements/link/parameters/ring.r", "/cell/vectors/1/1"], "values": [0.5, 6.0] },
              { "pointer": "/seed", "values": [7, 8] } ],
    "exact": [0.5, null], "solvable": false } ] })";

std::string text(const std::string& what = section)
{
  return with(valid_text(), "\"name\": \"pair\"", "\"name\": \"pair\", \"task\": \"stability\", " + what);
}

VariantReading read_member(const Experiment& e, std::size_t member, std::size_t method,
                           Diagnostics& diagnostics)
{
  return read_stability_member(*e.section<ExperimentStability>(), 0, member, method, fake_lookup,
                               diagnostics);
}

TEST(Stability, ReadsFamiliesAndMethods)
{
  const Experiment e = read_ok(text());
  EXPECT_EQ(e.task, "stability");
  const ExperimentStability& s = *e.section<ExperimentStability>();
  EXPECT_EQ(s.tolerance, 1e-6);
  ASSERT_EQ(s.methods.size(), 2U);
  EXPECT_EQ(s.methods[1].set.at(0).pointer, "/solver/contact");
  ASSERT_EQ(s.families.size(), 1U);
  EXPECT_EQ(s.families[0].labels, (std::vector<std::string>{"0.5", "6"}));
  EXPECT_EQ(s.families[0].exact, (std::vector<std::optional<double>>{0.5, std::nullopt}));
  EXPECT_FALSE(s.families[0].solvable);
  EXPECT_EQ(s.families[0].members[1].size(), 5U);
}

TEST(Stability, AMemberIsAnOrdinaryExperiment)
{
  const Experiment e = read_ok(text());
  Diagnostics diagnostics;
  const VariantReading reading = read_member(e, 0, 1, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_TRUE(reading.experiment) << reading.refusal;
  const Experiment& m = *reading.experiment;
  EXPECT_EQ(m.name, "thin, 0.5, arc");
  EXPECT_EQ(m.task, "limits");
  EXPECT_FALSE(m.section<ExperimentStability>());
  EXPECT_FALSE(m.section<ExperimentDesign>());
  EXPECT_EQ(m.solver.contact, "arc");
  EXPECT_EQ(m.solver.starts, 3);
  EXPECT_EQ(m.solver.start_seed, 7U) << "defaults follow what the member sets";
  EXPECT_EQ(m.directions_deg, std::vector<double>{90});
  EXPECT_EQ(m.scene.elements[0].parameters[1], 0.5);
  EXPECT_EQ(m.scene.lattice[1].y(), 0.5);
  EXPECT_EQ(read_member(e, 0, 0, diagnostics).experiment->solver.contact, "auto");
}

TEST(Stability, AMemberThatMakesNoSceneIsRefusedAndNoMistake)
{
  const Experiment e = read_ok(text());
  Diagnostics diagnostics;
  const VariantReading reading = read_member(e, 1, 0, diagnostics);  // r = 6 > R = 5
  EXPECT_EQ(diagnostics.text(), "");
  EXPECT_FALSE(reading.experiment);
  EXPECT_NE(reading.refusal, "");
}

TEST(Stability, MistakesOfFormAreReportedWithTheirPlace)
{
  const Experiment e = read_ok(text(with(section, "/solver/contact", "/solver/contract")));
  Diagnostics diagnostics;
  EXPECT_FALSE(read_member(e, 0, 1, diagnostics).experiment);
  EXPECT_NE(
      diagnostics.text().find("family 'thin', member '0.5', method 'arc': unknown key 'contract'; did you "
                              "mean 'contact'?"),
      std::string::npos)
      << diagnostics.text();
  const Experiment lost = read_ok(text(with(section, "\"/seed\"", "\"/cell/vectors/7\"")));
  Diagnostics unreached;
  read_member(lost, 0, 0, unreached);
  EXPECT_NE(unreached.text().find("cannot reach '7': expected an index from 0 to 2"), std::string::npos)
      << unreached.text();
}

TEST(Stability, ListsMustFitTheMembers)
{
  EXPECT_NE(
      problems_of(text(with(section, "[7, 8]", "[7]"))).find("expected 2 values, one per member, found 1"),
      std::string::npos);
  EXPECT_NE(problems_of(text(with(section, "[0.5, null]", "[0.5, \"x\"]"))).find("expected a number or null"),
            std::string::npos);
  EXPECT_NE(problems_of(text(with(section, "\"arc\", \"set\"", "\"plain\", \"set\"")))
                .find("method 'plain' is given twice"),
            std::string::npos);
  EXPECT_EQ(problems_of(text("\"description\": \"none\"")),
            "t.json:1: missing key 'stability': task stability needs it");
}

}  // namespace
}  // namespace hauberk::test
