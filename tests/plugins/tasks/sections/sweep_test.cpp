/// The section sweep: rows, values, names, and what is wrong with it; and cell.weave.

#include "document/json_writer.hpp"
#include "fake_plugins.hpp"
#include "tasks/sweep/sweep_section.hpp"
#include "tasks/table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::test {
namespace {

const std::string section =
    R"("sweep": { "vary": [ { "name": "gap", "pointers": ["/solver/clearance", { "pointer": "/seed", "factor": 2, "offset": 1 }], "values": [1, 2] }, { "name": "x", "pointers": ["/cell/place/1/position/0"], "range": { "from": 4, "to": 16, "count": 3, "scale": "log" } } ] })";

std::string text(const std::string& what = section)
{
  return with(valid_text(), "\"name\": \"pair\"", "\"name\": \"pair\", \"task\": \"sweep\", " + what);
}

std::string after(const std::string& from, const std::string& to)
{
  return problems_of(text(with(section, from, to)));
}

VariantReading read_row(const Experiment& e, std::size_t row, Diagnostics& diagnostics)
{
  return read_sweep_row(*e.section<ExperimentSweep>(), row, e.name, fake_lookup, diagnostics);
}

TEST(Sweep, RowsAreAllCombinationsTheLastTheFastest)
{
  const Experiment e = read_ok(text());
  EXPECT_EQ(e.task, "sweep");
  ASSERT_EQ(e.section<ExperimentSweep>()->row_count(), 6U);
  EXPECT_EQ(e.section<ExperimentSweep>()->indices(0), (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(e.section<ExperimentSweep>()->indices(5), (std::vector<std::size_t>{1, 2}));
  const std::vector<Node>& x = e.section<ExperimentSweep>()->axes[1].values;
  EXPECT_EQ(x[0].number, 4.0);
  EXPECT_DOUBLE_EQ(x[1].number, 8.0) << "the geometric mean";
  EXPECT_EQ(x[2].number, 16.0);
  Diagnostics diagnostics;
  const VariantReading row = read_row(e, 4, diagnostics);
  ASSERT_TRUE(row.experiment.has_value()) << row.refusal << diagnostics.text();
  EXPECT_EQ(row.experiment->solver.clearance, 2.0);
  EXPECT_EQ(row.experiment->seed, 5U) << "2 x 2 + 1";
  EXPECT_DOUBLE_EQ(row.experiment->scene.elements[1].rest.position.x(), 8.0);
  EXPECT_EQ(row.experiment->task, "limits");
  EXPECT_EQ(row.experiment->section<ExperimentSweep>(), nullptr);
}

TEST(Sweep, MeasuresAllLimitsUnlessItSaysWhat)
{
  const Experiment e = read_ok(text());
  ASSERT_EQ(e.section<ExperimentSweep>()->measure.size(), 4U);
  EXPECT_EQ(e.section<ExperimentSweep>()->measure[0].name, "stretch 0");
  EXPECT_EQ(e.section<ExperimentSweep>()->measure[3].name, "compress 30");
  EXPECT_EQ(e.section<ExperimentSweep>()->measure[3].pointer, "/limits/3/value");
  const Experiment turned = read_ok(text(with(section, "\"/seed\"", "\"/load_case/directions_deg/0\"")));
  EXPECT_EQ(turned.section<ExperimentSweep>()->measure[0].name, "stretch in direction 1")
      << "0 degrees in no row";
  for (const char* touched : {"/load_case/senses", "/load_case/plugin", "/load_case"}) {
    // Read only: what the rows would be does not matter here.
    const Experiment other =
        read_ok(with(text(with(section, "\"/seed\"", std::string("\"") + touched + "\"")),
                     "\"plugin\": \"plane\"", R"("plugin": "plane", "senses": ["stretch"])"));
    ASSERT_EQ(other.section<ExperimentSweep>()->measure.size(), 2U);
    EXPECT_EQ(other.section<ExperimentSweep>()->measure[1].name, "limit 2")
        << "not the same sense in every row: " << touched;
  }
  const Experiment chosen =
      read_ok(text(with(section, "\"sweep\": {",
                        R"("sweep": { "measure": [{ "name": "eta", "pointer": "/profiles/0/eta" }],)")));
  ASSERT_EQ(chosen.section<ExperimentSweep>()->measure.size(), 1U);
  EXPECT_EQ(chosen.section<ExperimentSweep>()->measure[0].name, "eta");
}

TEST(Sweep, ReportsWhatMakesNoSense)
{
  EXPECT_EQ(problems_of(text("\"description\": \"none\"")),
            "t.json:1: missing key 'sweep': task sweep needs it");
  EXPECT_EQ(
      after("\"values\": [1, 2]", "\"values\": [1], \"range\": { \"from\": 0, \"to\": 1, \"count\": 2 }"),
      "t.json:2: /sweep/vary/0: expected either values or range");
  EXPECT_EQ(after("\"values\": [1, 2]", "\"values\": [1, \"a\"]"),
            "t.json:2: /sweep/vary/0/values/1: a factor or an offset needs numbers, found \"a\"");
  EXPECT_EQ(after("\"from\": 4", "\"from\": 0"),
            "t.json:2: /sweep/vary/1/range: a logarithmic scale needs positive ends, found 0 and 16");
  EXPECT_EQ(after("\"name\": \"x\"", "\"name\": \"gap\""),
            "t.json:2: /sweep/vary/1: the name 'gap' is given twice");
  EXPECT_EQ(after("\"count\": 3", "\"count\": 9000"),
            "t.json:2: /sweep/vary: expected at most 10000 rows, found 18000");
  EXPECT_EQ(
      after("\"/solver/clearance\"", "\"/solver/clearence\""),
      "t.json:2: /sweep/vary/0/pointers/0: there is nothing at \"/solver/clearence\" of this experiment");
  EXPECT_EQ(after("\"/solver/clearance\"", "\"solver\""),
            "t.json:2: /sweep/vary/0/pointers/0: expected a JSON pointer such as /solver/clearance, found "
            "\"solver\"");
  EXPECT_EQ(
      after("\"sweep\": {", R"("sweep": { "measure": [{ "name": "time", "pointer": "/limits/0/seconds" }],)"),
      "t.json:2: /sweep/measure/0: times differ from run to run and are no measure of a row; timings.json "
      "has them");
  for (const char* section_name : {"name", "task", "design", "sweep/vary"}) {
    const std::string pointer = std::string("\"/") + section_name + "\"";
    EXPECT_EQ(after("\"/solver/clearance\"", pointer),
              "t.json:2: /sweep/vary/0/pointers/0: " + pointer +
                  " has no effect: rows are limits experiments; vary something of elements, cell, load_case, "
                  "solver or seed");
  }
}

TEST(Sweep, EveryPlaceIsVariedOnce)
{
  EXPECT_EQ(after("\"/cell/place/1/position/0\"", "\"/seed\""),
            "t.json:2: /sweep/vary/1/pointers/0: \"/seed\" is varied already, by \"/seed\" of 'gap'; remove "
            "one of the two");
  EXPECT_EQ(after("\"/cell/place/1/position/0\"", "\"/solver\""),
            "t.json:2: /sweep/vary/1/pointers/0: \"/solver\" is varied already, by \"/solver/clearance\" of "
            "'gap'; remove one of the two");
  EXPECT_EQ(after("\"/solver/clearance\"", "\"/seed\""),
            "t.json:2: /sweep/vary/0/pointers/1: \"/seed\" is varied already, by \"/seed\" of 'gap'; remove "
            "one of the two");
}

TEST(Sweep, MistakesOfFormAreProblemsAndImpossibleValuesAreRefused)
{
  const Experiment e = read_ok(text(with(section, "\"values\": [1, 2]", "\"values\": [1, -2]")));
  Diagnostics diagnostics;
  EXPECT_FALSE(read_row(e, 3, diagnostics).experiment.has_value());
  EXPECT_EQ(diagnostics.text(),
            ":2: /solver/clearance: row 3: expected a number >= 0, found -2\n"
            ":2: /seed: row 3: expected an integer >= 0, found -3");
}

const std::string weave_file = R"({ "name": "line", "parameters": { "size": { "default": 3 } },
  "lengths": { "double": { "size": 2 } },
  "elements": { "w": { "shape": "rings", "rings": [{ "name": "ring" }], "parameters": { "ring.R": { "size": 1 } } } },
  "cell": { "vectors": [[{ "double": 2, "size": -1 }, 0], [0, 50]],
    "place": [{ "element": "w", "position": [0, { "double": 0.5 }, 0] }] } })";

std::optional<Experiment> read_weave(const std::string& tail, Diagnostics& diagnostics,
                                     const std::string& parameters = R"(, "parameters": { "size": 4 })")
{
  const WeaveLookup weaves = [](const std::string& name, std::string& error) {
    error = "no " + name;
    return name == "line" ? std::optional(weave_file) : std::nullopt;
  };
  return read_experiment({"t.json",
                          R"({ "name": "w", "cell": { "weave": { "name": "line")" + parameters +
                              R"( } },
 "load_case": { "plugin": "plane", "directions_deg": [0] })" +
                              tail + "}",
                          {},
                          weaves,
                          {},
                          task_formats()},
                         fake_lookup, diagnostics);
}

TEST(Weave, LengthsAreSumsOfItsParameters)
{
  Diagnostics diagnostics;
  const std::optional<Experiment> e = read_weave("", diagnostics);
  ASSERT_TRUE(e.has_value()) << diagnostics.text();
  EXPECT_EQ(e->scene.lattice[0], Vec3(12, 0, 0));
  EXPECT_EQ(e->scene.elements[0].rest.position, Vec3(0, 4, 0));
  EXPECT_EQ(e->scene.elements[0].parameters[0], 4.0);
  EXPECT_EQ(write_json(e->resolved).find("weave"), std::string::npos) << "results hold what it stands for";
}

TEST(Weave, SweepsVaryItsParameters)
{
  Diagnostics diagnostics;
  const std::optional<Experiment> e = read_weave(R"(, "task": "sweep", "sweep": { "vary": [{ "name": "size",
    "pointers": ["/cell/weave/parameters/size"], "values": [4, 6] }] })",
                                                 diagnostics);
  ASSERT_TRUE(e.has_value()) << diagnostics.text();
  const VariantReading row = read_row(*e, 1, diagnostics);
  ASSERT_TRUE(row.experiment.has_value()) << diagnostics.text();
  EXPECT_EQ(row.experiment->scene.lattice[0], Vec3(18, 0, 0));
  EXPECT_NE(write_json(e->resolved).find("weave"), std::string::npos) << "what the pointer leads to";
}

TEST(Weave, SweepsVaryParametersThatAreNotWritten)
{
  const auto read = [](const char* parameter, Diagnostics& diagnostics) {
    return read_weave(std::string(R"(, "task": "sweep", "sweep": { "vary": [{ "name": "size",
    "pointers": ["/cell/weave/parameters/)") +
                          parameter + R"("], "values": [6] }] })",
                      diagnostics, "");
  };
  Diagnostics diagnostics;
  const std::optional<Experiment> e = read("size", diagnostics);
  ASSERT_TRUE(e.has_value()) << diagnostics.text();
  const VariantReading row = read_row(*e, 0, diagnostics);
  ASSERT_TRUE(row.experiment.has_value()) << diagnostics.text();
  EXPECT_EQ(row.experiment->scene.lattice[0], Vec3(18, 0, 0));
  const std::optional<Experiment> wrong = read("length", diagnostics);
  ASSERT_TRUE(wrong.has_value()) << diagnostics.text();
  EXPECT_FALSE(read_row(*wrong, 0, diagnostics).experiment.has_value());
  EXPECT_NE(diagnostics.text().find("row 0: the weave has no parameter 'length'"), std::string::npos)
      << diagnostics.text();
}

}  // namespace
}  // namespace hauberk::test
