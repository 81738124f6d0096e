/// Bad input through the program: the exact words, exit code 2, and nothing written.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

/// Runs an experiment that must be refused with `problems`, each a line after "FILE:".
void expect_refused(const std::string& text, const std::vector<std::string>& problems)
{
  const WorkFolder folder;
  const std::string file = folder.write("bad.json", text);
  std::string expected;
  for (const std::string& p : problems) expected.append(file).append(":").append(p).append("\n");
  const Outcome o = run_program({"run", file, "-o", folder / "out"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err, expected);
  EXPECT_EQ(o.out, "");
  EXPECT_FALSE(fs::exists(folder / "out"));
  // `check` says the same.
  const Outcome check = run_program({"check", file, "--thorough"});
  EXPECT_EQ(check.code, 2);
  EXPECT_EQ(check.err, expected);
}

void expect_refused(const std::string& from, const std::string& to, const std::string& problem)
{
  expect_refused(with(chain_text(), from, to), {problem});
}

const std::string way_out = "; move them apart, lower the clearance, or set cell.relax to true";

TEST(BadInput, EveryProblemAtOnce)
{
  expect_refused(with(with(with(chain_text(), R"("preset")", R"("prest")"), R"("stretch")", R"("strech")"),
                      R"("ring.R": 5.0)", R"("ring.R": "5")"),
                 {"5: /elements/link/parameters/ring.R: expected a number, found \"5\"",
                  "11: /load_case/senses/0: expected one of stretch, compress, found \"strech\"; did you "
                  "mean 'stretch'?",
                  "12: /solver/prest: unknown key 'prest'; did you mean 'preset'?"});
}

TEST(BadInput, Syntax)
{
  expect_refused(R"("solver": {)", R"("solver": )",
                 "12: syntax error at column 22: expected ',' or '}', found ':'");
  expect_refused(R"("name": "chain",)", R"("name": "chain", "name": "again",)",
                 "2: /name: duplicate key 'name': first given on line 2");
}

/// Slips of a unit: looking at all images would take forever.
TEST(BadInput, LengthsThatDoNotGoTogether)
{
  const std::string problem =
      ": more than 10000 images of the cell are within their reach: its vectors are far shorter than the "
      "elements, or an element is far away from the cell; correct cell.vectors, positions, radii or "
      "solver.clearance";
  expect_refused("[[12, 0], [0, 100]]", "[[12e-6, 0], [0, 1e-4]]", "6: /cell: elements 0 and 0" + problem);
  expect_refused("[6, 0, 0]", "[6e15, 0, 0]", "6: /cell: elements 0 and 1" + problem);
  expect_refused("[6, 0, 0]", "[1e308, 0, 0]", "6: /cell: elements 0 and 1" + problem);
  expect_refused(R"("preset": "accurate")", R"("clearance": 1e9)", "6: /cell: elements 0 and 0" + problem);
}

TEST(BadInput, SettingsThatAMethodHasNot)
{
  expect_refused("\"preset\": \"accurate\"",
                 "\"preset\": \"accurate\", \"contact\": \"constrained\", \"ccd\": \"certified\"",
                 "12: /solver/ccd: contact 'constrained' checks no steps for collisions; remove this");
}

TEST(BadInput, Numbers)
{
  expect_refused(
      R"("ring.r0": 0.7)", R"("ring.r0": 1e999)",
      "5: /elements/link/parameters/ring.r0: expected a finite number, found 1e999, which is beyond the "
      "largest double (about 1.8e308)");
  expect_refused(
      R"("ring.R": 5.0)", R"("ring.R": -5.0)",
      "5: /elements/link/parameters/ring.R: expected a number in [1e-12, 1000000000000], found -5");
  expect_refused(R"("ring.r0": 0.7)", R"("ring.r0": 6)",
                 "5: /elements/link/parameters: parameter 'ring.r0' = 6 must be smaller than 'ring.R' = 5: "
                 "it closes the hole of torus 'ring'");
}

/// Text that was meant as a formula is no number and no reason to suspect anything else.
TEST(BadInput, FormulasWithoutASign)
{
  expect_refused(
      "[6, 0, 0]", R"(["-$pitch", 0, 0])",
      "10: /cell/place/1/position/0: expected a number, found \"-$pitch\"; an expression begins with = or $: "
      "\"=-$pitch\"");
}

TEST(BadInput, OverlapAtRest)
{
  expect_refused(
      "[6, 0, 0]", "[9.2, 0, 0]",
      "6: /cell: element 0 (ring of link) and element 1 (ring of link) overlap at rest by 0.6 mm; move "
      "them apart, make them thinner, or set cell.relax to true");
}

TEST(BadInput, CoresThatCrossExactly)
{
  expect_refused(
      "[12, 0]", "[16, 0]",
      "6: /cell: element 0 (ring of link) and element 1 (ring of link) of image [-1, 0] overlap at "
      "rest by 1.4 mm; move them apart, make them thinner, or set cell.relax to true");
}

TEST(BadInput, GapBelowTheClearance)
{
  const std::string less = " apart at rest, less than solver.clearance 2.7 mm" + way_out;
  expect_refused(
      with(with(chain_text(), R"("preset": "accurate")", R"("clearance": 2.7)"), "[12, 0]", "[13, 0]"),
      {"6: /cell: element 0 (ring of link) and element 0 (ring of link) of image [1, 0] are 1.6 mm" + less,
       "6: /cell: element 0 (ring of link) and element 1 (ring of link) of image [-1, 0] are 1.6 mm" + less,
       "6: /cell: element 0 (ring of link) and element 1 (ring of link) are 2.6 mm" + less,
       "6: /cell: element 1 (ring of link) and element 1 (ring of link) of image [1, 0] are 1.6 mm" + less});
}

TEST(BadInput, NothingLinked)
{
  expect_refused(
      "[6, 0, 0]", "[6, 0, 50]",
      "6: /cell: nothing is linked: no ring passes through another, so no direction has a limit; check "
      "positions, rotations and the cell's vectors");
}

TEST(BadInput, Plugins)
{
  expect_refused(R"("torus_union")", R"("torus_unoin")",
                 "4: /elements/link/shape: no shape 'torus_unoin' found; did you mean 'torus_union'? "
                 "(searched: " HAUBERK_BINARY_DIR
                 "/lib/hauberk/plugins; other folders with --plugin-path or HAUBERK_PLUGIN_PATH)");
  expect_refused(R"("in_plane_periodic")", R"("torus_union")",
                 "11: /load_case/plugin: 'torus_union' is a shape, not a load case");
}

TEST(BadInput, DesignsThatCannotWork)
{
  const std::string design = R"("task": "design", "design": { "quantity": "stretch",
    "variables": [ { "parameters": "ring.R", "lower": 4.5, "upper": 5.4 } ],
    "targets": [ { "direction_deg": 90, "value": 0.1 } ] }, "expect")";
  expect_refused(
      R"("expect")", design,
      "15: /design/targets/0: stretch at 90 degrees is unbounded: links set no limit that a design could "
      "change");
}

TEST(BadInput, FilesThatCannotBeRead)
{
  const WorkFolder folder;
  const std::string file = folder / "none.json";
  const Outcome o = run_program({"run", file, "-o", folder / "out"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err, "hauberk: cannot read '" + file + "': No such file or directory\n");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(BadInput, ValuesOfTheCommandLineAreNamedAsSuch)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  const Outcome o = run_program({"run", file, "-o", folder / "out", "--set", "/solver/preset=papr"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err,
            "command line: /solver/preset: expected one of accurate, paper, found \"papr\"; did you "
            "mean 'paper'?\n");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(BadInput, PluginFoldersThatDoNotExist)
{
  const WorkFolder folder;
  const Outcome o =
      run_program({"run", folder.write("c.json", chain_text()), "--plugin-path", folder / "none"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err, "hauberk: --plugin-path: '" + (folder / "none") + "' is not a folder\n");
}

/// Problems of a file are told at once, whatever its rest state takes.
TEST(Check, SaysWhatItLeftOut)
{
  const WorkFolder folder;
  const std::string large =
      folder.write("l.json", with(chainmail_text(), R"("repeat": [2, 1],)", R"("repeat": [300, 250],)"));
  const Outcome o = run_program({"check", large});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.out.find(large + ": no problems in the file itself; the rest state, "), 0U) << o.out;
  const boost::json::value told = parse_json(run_program({"check", large, "--json"}).out, "check");
  EXPECT_TRUE(told.at("ok").as_bool());
  EXPECT_TRUE(told.at("summary").is_null());
  EXPECT_NE(told.at("left_out").as_string().find("--thorough"), std::string::npos);
  const Outcome bad = run_program({"check", large, "--set", "/solver/startz=1"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("/solver/startz: unknown key"), std::string::npos) << bad.err;
}

/// What is beyond the budget is refused before anything is computed or written.
TEST(Budget, WorkIsCountedFirst)
{
  const WorkFolder folder;
  const std::string chain = folder.write("c.json", chain_text()), out = folder / "out";
  const auto refused = [&](const std::vector<std::string>& more, const char* why) {
    std::vector<std::string> words{"run", chain, "-o", out};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome o = run_program(words);
    EXPECT_EQ(o.code, 2) << o.out << o.err;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
    EXPECT_FALSE(fs::exists(out)) << why;
  };
  refused({"--set", "/solver/starts=2000000000"}, "the run would take 2e+09 searches, at least ");
  refused({"--set", "/solver/starts=2000000000", "--budget", "1e18"}, "go on with --yes");  // memory
  refused({"--budget", "1"}, "the budget is 1 evaluations");
  refused({"--budget-bytes", "100"}, "the budget is 1e+10 evaluations and 0.0001 MB");
  refused({"--budget", "0"}, "expected a number above 0");
  EXPECT_EQ(run_program({"run", chain, "-o", out, "--budget", "1", "--yes"}).code, 0);
  // The other tasks count what they repeat.
  for (const TaskCase& task : task_cases()) {
    const std::string file = folder.write("t.json", task.text());
    const Outcome o = run_program({"run", file, "-o", folder / "t", "--budget", "1"});
    EXPECT_EQ(o.code, 2) << task.name;
    EXPECT_NE(o.err.find(" searches, at least "), std::string::npos) << task.name << o.err;
  }
  const Outcome plan = run_program({"plan", folder.write("s.json", sweep_text())});
  EXPECT_NE(plan.out.find("\nWork, without what limits learn from each other\n  7 searches, at least "),
            std::string::npos)
      << plan.out;
}

/// The count is a lower bound of what is then evaluated.
TEST(Budget, CountsNoMoreThanIsDone)
{
  const WorkFolder folder;
  // Results do not say what limits took that are not reported: neither beside these nor of scenes with more
  // held.
  const std::string alone = with(chainmail_text(), R"("starts": 2)", R"("starts": 2, "neighbours": 0)");
  const std::string text =
      with(alone, R"("directions_deg")", R"("hold": ["shear", "lateral"], "directions_deg")");
  const std::string file = folder.write("m.json", text), out = folder / "out";
  const Outcome plan = run_program({"plan", file});
  const std::size_t at = plan.out.find(" searches, at least ");
  ASSERT_NE(at, std::string::npos);
  const double searches = std::stod(plan.out.substr(plan.out.rfind("  ", at)));
  const double least = std::stod(plan.out.substr(at + std::string(" searches, at least ").size()));
  ASSERT_EQ(run_program({"run", file, "-o", out}).code, 0);
  double evaluations = 0.0, done = 0.0;
  const boost::json::value results = read_results(out);
  for (const boost::json::value& limit : results.at("limits").as_array()) {
    evaluations += number_at(limit, "/evaluations");
    done += number_at(limit, "/confidence/searches");
  }
  EXPECT_GT(least, 1.0);
  EXPECT_LE(least, evaluations);
  EXPECT_LE(searches, done);
  EXPECT_GE(least, 5e-4 * evaluations) << "it says something";
}

}  // namespace
}  // namespace hauberk::test
