/// The section chart: scenes, methods, settings, and what is wrong with them.

#include "fake_plugins.hpp"
#include "tasks/chart/chart_section.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

const std::string section = R"("chart": { "repeats": 5, "threads": [1, 0],
  "scenes": [ { "name": "thin", "set": { "/elements/link/parameters/ring.r": 0.25 }, "exact": [0.5, null] },
              { "name": "thick", "reference": { "set": { "/solver/starts": 7 } } } ],
  "methods": [ { "name": "arc", "set": { "/solver/contact": "arc" },
                 "vary": [ { "pointer": "/solver/tolerance", "values": [1e-2, 1e-4] },
                           { "pointer": ["/seed", "/solver/starts"], "values": [3, 4] } ] },
               { "name": "plain", "scenes": ["thick"] } ] })";

std::string text(const std::string& what = section)
{
  return with(valid_text(), "\"name\": \"pair\"", "\"name\": \"pair\", \"task\": \"chart\", " + what);
}

std::string after(const std::string& from, const std::string& to)
{
  return problems_of(text(with(section, from, to)));
}

TEST(Chart, ReadsScenesAndMethods)
{
  const Experiment e = read_ok(text());
  EXPECT_EQ(e.task, "chart");
  const ExperimentChart& c = *e.section<ExperimentChart>();
  EXPECT_EQ(c.repeats, 5);
  EXPECT_EQ(c.threads, (std::vector<int>{1, 0}));
  ASSERT_EQ(c.scenes.size(), 2U);
  EXPECT_EQ(c.scenes[0].exact, (std::vector<std::optional<double>>{0.5, std::nullopt}));
  EXPECT_FALSE(c.scenes[0].reference);
  EXPECT_TRUE(c.scenes[1].exact.empty());
  ASSERT_EQ(c.methods.size(), 2U);
  EXPECT_EQ(c.methods[0].labels, (std::vector<std::string>{"0.01", "1e-04"}));
  EXPECT_EQ(c.methods[0].scenes, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(c.methods[1].labels, std::vector<std::string>{""}) << "one setting";
  EXPECT_EQ(c.methods[1].scenes, std::vector<std::size_t>{1});
  const Experiment one = read_ok(text(with(section, "[0.5, null]", "0.5")));
  EXPECT_EQ(one.section<ExperimentChart>()->scenes[0].exact, std::vector<std::optional<double>>{0.5});
}

TEST(Chart, APointIsAnOrdinaryExperiment)
{
  const Experiment e = read_ok(text());
  Diagnostics diagnostics;
  const VariantReading point =
      read_chart_setting(*e.section<ExperimentChart>(), 0, 0, 1, fake_lookup, diagnostics);
  ASSERT_TRUE(point.experiment) << point.refusal << diagnostics.text();
  EXPECT_EQ(point.experiment->name, "thin, arc, 1e-04");
  EXPECT_EQ(point.experiment->task, "limits");
  EXPECT_FALSE(point.experiment->section<ExperimentChart>());
  EXPECT_EQ(point.experiment->scene.elements[0].parameters[1], 0.25);
  EXPECT_EQ(point.experiment->solver.contact, "arc");
  EXPECT_EQ(point.experiment->solver.tolerance, 1e-4);
  EXPECT_EQ(point.experiment->solver.starts, 4);
  EXPECT_EQ(point.experiment->seed, 4U);
  const VariantReading reference =
      read_chart_scene(*e.section<ExperimentChart>(), 1, fake_lookup, diagnostics);
  ASSERT_TRUE(reference.experiment);
  EXPECT_EQ(reference.experiment->solver.starts, 7);
  EXPECT_EQ(diagnostics.text(), "");
}

TEST(Chart, MistakesAreReportedWithTheirPlace)
{
  EXPECT_EQ(after(R"(, "exact": [0.5, null])", ""),
            "t.json:3: /chart/scenes/0: expected exact or reference, found neither");
  EXPECT_EQ(after(R"("name": "thick",)", R"("name": "thick", "exact": 1,)"),
            "t.json:4: /chart/scenes/1: expected either exact or reference, found both");
  EXPECT_EQ(after("[0.5, null]", "[null, \"x\"]"),
            "t.json:3: /chart/scenes/0/exact/1: expected a number or null\n"
            "t.json:3: /chart/scenes/0/exact: expected at least one number: without any there is no error");
  EXPECT_EQ(after("\"name\": \"thick\"", "\"name\": \"thin\""),
            "t.json:4: /chart/scenes/1: scene 'thin' is given twice\n"
            "t.json:8: /chart/methods/1/scenes/0: unknown scene 'thick'; known: 'thin'");
  EXPECT_EQ(after("[\"thick\"]", "[\"thick\", \"thick\"]"),
            "t.json:8: /chart/methods/1/scenes/1: scene 'thick' is given twice");
  EXPECT_EQ(after("\"name\": \"plain\"", "\"name\": \"arc\""),
            "t.json:8: /chart/methods/1: method 'arc' is given twice");
  EXPECT_EQ(after("[3, 4]", "[3]"),
            "t.json:7: /chart/methods/0/vary/1/values: expected 2 values, one per setting, found 1");
  EXPECT_EQ(after("[1e-2, 1e-4]", "[1e-2, 0.01]"),
            "t.json:5: /chart/methods/0: setting '0.01' is given twice; give labels");
  EXPECT_EQ(after("\"scenes\": [\"thick\"]", "\"labels\": [\"a\", \"b\"]"),
            "t.json:8: /chart/methods/1/labels: expected 1 labels, one per setting, found 2");
  EXPECT_EQ(after("[1, 0]", "[1, 1]"), "t.json:2: /chart/threads/1: 1 threads are given twice");
  EXPECT_EQ(after("[1, 0]", "[-1]"),
            "t.json:2: /chart/threads/0: expected an integer in [0, 4096], found -1");
  EXPECT_EQ(after("\"repeats\": 5", "\"repeats\": 0").substr(0, 36), "t.json:2: /chart/repeats: expected a");
  EXPECT_EQ(after(R"("set": { "/solver/contact": "arc" })", R"("scenes": ["thick"])"),
            "t.json:3: /chart/scenes/0: no method solves scene 'thin'");
  EXPECT_EQ(
      after("\"/solver/contact\": \"arc\"", "\"/expect\": []"),
      "t.json:5: /chart/methods/0/set/~1expect: \"/expect\" has no effect: points are limits experiments; "
      "set something of elements, cell, load_case, solver or seed");
}

TEST(Chart, MistakesOfFormInAPointNameIt)
{
  const Experiment e = read_ok(text(with(section, "/solver/contact", "/solver/contract")));
  Diagnostics diagnostics;
  EXPECT_FALSE(
      read_chart_setting(*e.section<ExperimentChart>(), 0, 0, 1, fake_lookup, diagnostics).experiment);
  EXPECT_NE(
      diagnostics.text().find("scene 'thin', method 'arc', setting '1e-04': unknown key 'contract'; did you "
                              "mean 'contact'?"),
      std::string::npos)
      << diagnostics.text();
}

}  // namespace
}  // namespace hauberk::test
