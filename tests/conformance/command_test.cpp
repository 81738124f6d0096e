/// `hauberk plugins conform` and `hauberk plugins new` through the program.

#include "../experiments/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

const std::string plugins = HAUBERK_BINARY_DIR "/lib/hauberk/plugins/";
const std::string mutants = HAUBERK_BINARY_DIR "/tests/mutants/";

TEST(Conform, SaysWhatPassedAndHowToRepeatWhatFailed)
{
  const Outcome good = run_program({"plugins", "conform", plugins + "torus_union.so", "--filter", "shape"});
  EXPECT_EQ(good.code, 0);
  EXPECT_EQ(good.err, "");
  EXPECT_NE(good.out.find("plugin torus_union 0.1.0, a shape: " + plugins +
                          "torus_union.so\nseed 1\n\n"
                          "passed   shape.parameters\n"),
            std::string::npos)
      << good.out;
  EXPECT_NE(good.out.find("\n\n11 checks: 10 passed, 0 failed, 1 skipped\n"), std::string::npos) << good.out;

  const std::string file = mutants + "mutant_shape.so", section = R"({"defect": "hang"})";
  const Outcome bad = run_program({"plugins", "conform", file, "--filter", "shape.(primitives|parameters)",
                                   "--section", section, "--seconds", "1", "--seed", "7"});
  EXPECT_EQ(bad.code, 1);
  EXPECT_NE(bad.out.find("seed 7\n\npassed   shape.parameters\n"
                         "SLOW     shape.primitives: did not return within 1 s of processor time\n\n"
                         "2 checks: 1 passed, 0 failed, 0 skipped, 1 slow\n"),
            std::string::npos)
      << bad.out;
  EXPECT_NE(bad.out.find("\n    again: hauberk plugins conform '" + file + "' --seed 7 --section '" +
                         section + "' --filter '^shape.primitives$'\n"),
            std::string::npos)
      << bad.out;
}

/// One cause is told once, with the seed that it was met with; what else it broke refers to it.
TEST(Conform, SaysOnceWhatHasOneCause)
{
  const Outcome o =
      run_program({"plugins", "conform", mutants + "mutant_shape.so", "--filter", "shape.(prim|jac|rot)",
                   "--section", R"({"defect": "throws"})", "--seeds", "3"});
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(
      o.out.find("seeds 1 to 3\n\n"
                 "FAILED   shape.primitives: plugin 'mutant_shape': primitives failed: no primitives today"),
      std::string::npos)
      << o.out;
  EXPECT_NE(o.out.find("\nFAILED   shape.jacobians: as shape.primitives\n"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("\nFAILED   shape.rotations: as shape.primitives\n"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("    again: "), o.out.rfind("    again: ")) << o.out;
}

/// A section that is refused is one cause, in other processes, too.
TEST(Conform, SaysOnceThatTheSectionIsRefused)
{
  const Outcome o = run_program(
      {"plugins", "conform", plugins + "spline_tube.so", "--filter", "bad_values|processes|shape"});
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.out.find("\nFAILED   processes: as bad_values\n"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("    again: "), o.out.rfind("    again: ")) << o.out;
}

TEST(Conform, TellsTheTimeOfACall)
{
  const Outcome o = run_program({"plugins", "conform", plugins + "torus_union.so", "--filter", "speed"});
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.out.find("\na call takes: primitives "), std::string::npos) << o.out;
  const Outcome slow = run_program({"plugins", "conform", mutants + "mutant_shape.so", "--filter", "speed",
                                    "--section", R"({"defect": "slow"})"});
  EXPECT_EQ(slow.code, 1);
  EXPECT_NE(slow.out.find("SLOW     speed: 'primitives' takes 0.15"), std::string::npos) << slow.out;
  EXPECT_NE(slow.out.find("0 failed, 0 skipped, 1 slow"), std::string::npos) << slow.out;
}

/// The child processes change nothing but what a crash does, and times.
TEST(Conform, TheSameInProcess)
{
  const std::vector<std::string> words{"plugins", "conform", plugins + "paraboloid_bending.so"};
  std::vector<std::string> in_process = words;
  in_process.emplace_back("--in-process");
  const auto timeless = [](const std::string& text) { return text.substr(0, text.find("\na call takes: ")); };
  EXPECT_EQ(timeless(run_program(words).out), timeless(run_program(in_process).out));
}

TEST(Conform, AsJson)
{
  const WorkFolder folder;
  const Outcome o = run_program({"plugins", "conform", mutants + "mutant_load_case.so", "--json", "--section",
                                 R"({"defect": "no_measure"})"});
  EXPECT_EQ(o.code, 1);
  folder.write("results.json", o.out);
  const boost::json::value report = read_results(folder.path());
  EXPECT_EQ(report.at_pointer("/format").as_string(), "hauberk-conformance/1");
  EXPECT_FALSE(report.at_pointer("/passed").as_bool());
  EXPECT_EQ(report.at_pointer("/plugin/id").as_string(), "mutant_load_case");
  int failed = 0;
  for (const boost::json::value& check : report.at_pointer("/checks").as_array()) {
    if (check.at("status").as_string() != "failed") continue;
    ++failed;
    EXPECT_EQ(check.at("name").as_string(), "load_case.unknowns");
    EXPECT_EQ(check.at("text").as_string(), "its measure has no name");
  }
  EXPECT_EQ(failed, 1);
}

TEST(Conform, ParametersOfTheSectionAreLookedAt)
{
  const auto said = [](const std::string& parameters) {
    return run_program({"plugins", "conform", mutants + "mutant_shape.so", "--filter", "shape.primitives",
                        "--section", R"({"parameters": )" + parameters + "}"})
        .out;
  };
  const auto expect_said = [&](const std::string& parameters, const std::string& text) {
    EXPECT_NE(said(parameters).find(text), std::string::npos) << said(parameters);
  };
  expect_said(R"({"R": 5, "r": 0.5, "waist": 1.2})", "passed   shape.primitives");
  expect_said(R"({"nonsense": 1})", "the shape has no parameter 'nonsense'");
  expect_said("[1]", "expected an object of numbers");
  expect_said(R"({"waist": "wide"})", "'waist': expected a number in [1, 2]");
  expect_said(R"({"waist": 2.5})", "'waist': expected a number in [1, 2]");
  expect_said(R"({"R": 1, "r": 2})", "the shape refuses the parameters of the section: parameter 'r' = 2");
}

/// Of a library with several plugins all are checked, or the one that is named; each says how to repeat what
/// failed of it.
TEST(Conform, EachPluginOfALibrary)
{
  const std::string file = HAUBERK_BINARY_DIR "/tests/bad_plugins/several.so";
  const Outcome all =
      run_program({"plugins", "conform", file, "--filter", "^descriptor$|^shape.primitives$"});
  EXPECT_EQ(all.code, 0) << all.out;
  EXPECT_NE(all.out.find("plugin several_ring 1.0, a shape: " + file + "\n"), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("2 checks: 2 passed, 0 failed, 0 skipped\n"), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("plugin several_search 2.0, an optimizer: " + file + "\n"), std::string::npos);

  // The filter matches no check of the optimizer.
  const Outcome shape = run_program({"plugins", "conform", file, "--filter", "^shape.primitives$"});
  EXPECT_EQ(shape.code, 0);
  EXPECT_EQ(shape.out.find("several_search"), std::string::npos) << shape.out;
  EXPECT_EQ(run_program({"plugins", "conform", file, "--filter", "nonsense"}).code, 2);

  const Outcome one = run_program({"plugins", "conform", file, "--plugin", "several_search", "--filter",
                                   "^descriptor$|start_at_optimum"});
  EXPECT_EQ(one.code, 1);
  EXPECT_EQ(one.out.find("several_ring"), std::string::npos) << one.out;
  EXPECT_NE(one.out.find("again: hauberk plugins conform '" + file + "' --seed 1 --plugin 'several_search'"),
            std::string::npos)
      << one.out;
  const Outcome none = run_program({"plugins", "conform", file, "--plugin", "several"});
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.out.find("FAILED   load: it has no plugin 'several', but several_ring, several_search\n"),
            std::string::npos)
      << none.out;
}

/// What is told beside a failure is where it was found, not where the check began.
TEST(Conform, TellsTheParametersThatWereRefused)
{
  const Outcome o = run_program({"plugins", "conform", mutants + "mutant_shape.so", "--filter",
                                 "shape.refusals", "--section", R"({"defect": "unnamed_refusal"})"});
  EXPECT_NE(o.out.find("(parameters: R = 1e-12, "), std::string::npos) << o.out;
}

/// Steps of differences and of searches fail beside the parameters that they begin from.
TEST(Conform, TellsTheParametersThatFailed)
{
  for (const std::string check : {"shape.jacobians", "shape.smooth"}) {
    const Outcome o = run_program({"plugins", "conform", mutants + "mutant_shape.so", "--filter", check,
                                   "--section", R"({"defect": "throws_far_away"})"});
    EXPECT_EQ(o.code, 1);
    EXPECT_NE(o.out.find("primitives failed: not as far as that"), std::string::npos) << o.out;
    const std::size_t at = o.out.find("waist = ");
    ASSERT_NE(at, std::string::npos) << o.out;
    EXPECT_GT(std::stod(o.out.substr(at + 8)), 1.7) << o.out;
  }
}

TEST(Conform, WhatIsNoPlugin)
{
  const Outcome none = run_program({"plugins", "conform", "/nowhere.so"});
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.out.find("FAILED   load: plugin '/nowhere.so' does not exist\n"), std::string::npos)
      << none.out;
  const Outcome filter = run_program({"plugins", "conform", plugins + "sqp.so", "--filter", "jacobian"});
  EXPECT_EQ(filter.code, 2);
  EXPECT_EQ(filter.err.find("hauberk: --filter: no check matches 'jacobian'; there are descriptor, "), 0U)
      << filter.err;
  EXPECT_EQ(filter.out, "");
  EXPECT_EQ(run_program({"plugins", "conform", plugins + "sqp.so", "--seconds", "0"}).code, 2);
}

void expect_refused(const std::vector<std::string>& words, const std::string& message)
{
  std::vector<std::string> all{"plugins", "new"};
  all.insert(all.end(), words.begin(), words.end());
  const Outcome o = run_program(all);
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err.substr(0, o.err.find('\n')), "hauberk: " + message);
  EXPECT_EQ(o.out, "");
}

TEST(New, RefusesWhatMakesNoSense)
{
  const WorkFolder folder;
  const std::string to = folder / "project";
  expect_refused({"--kind", "shape", "oval"}, "expected NAME and DIR");
  expect_refused({"oval", to}, "--kind is missing");
  expect_refused({"--kind", "shapes", "oval", to},
                 "--kind: expected shape, solid, load_case, patch or optimizer, found 'shapes'");
  for (const std::string name :
       {"Oval", "2d", "oval-link", "oval link", "_oval", "oval_", "o__v", "../oval", "öval"}) {
    expect_refused(
        {"--kind", "shape", name, to},
        "'" + name +
            "' is no name for a plugin; expected small letters, digits and single '_', such as oval_link");
  }
  for (const std::string name : {"install", "optimizer", "my_plugin_name", "plugin_template"}) {
    expect_refused(
        {"--kind", "optimizer", name, to},
        "'" + name + "' is no name for a plugin: it means something else to CMake, or to Hauberk's headers");
  }
  expect_refused({"--kind", "shape", "sqp", to},
                 "there is a plugin 'sqp' already (" + plugins + "sqp.so); choose another name");
  EXPECT_FALSE(fs::exists(to));
}

std::vector<std::string> names_in(const fs::path& folder)
{
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(New, WritesAllFilesOrNone)
{
  const WorkFolder folder;
  const Outcome o = run_program({"plugins", "new", "--kind", "load_case", "oval_link", folder / "a/b"});
  EXPECT_EQ(o.code, 0) << o.err;
  const std::vector<std::string> expected{"CMakeLists.txt", "README.md", "experiment.json", "oval_link.cpp",
                                          "oval_link_test.cpp"};
  EXPECT_EQ(names_in(folder / "a/b"), expected);
  EXPECT_NE(read_text(folder / "a/b/oval_link.cpp").find("class OvalLink final : public LoadCase"),
            std::string::npos);
  EXPECT_NE(read_text(folder / "a/b/CMakeLists.txt").find("hauberk_add_plugin(oval_link KIND load_case"),
            std::string::npos);
  // A file that is there, whoever wrote it, stays, and nothing is written beside it.
  fs::create_directory(folder / "c");
  folder.write("c/README.md", "mine");
  expect_refused({"--kind", "shape", "oval_link", folder / "c"},
                 (folder / "c/README.md") + ": exists already; give a folder without it");
  EXPECT_EQ(names_in(folder / "c"), std::vector<std::string>{"README.md"});
  EXPECT_EQ(read_text(folder / "c/README.md"), "mine");
  // Other files do not matter.
  fs::create_directory(folder / "d");
  folder.write("d/notes.txt", "mine");
  EXPECT_EQ(run_program({"plugins", "new", "--kind", "shape", "oval_link", folder / "d"}).code, 0);
  EXPECT_EQ(names_in(folder / "d").size(), 6U);
  // A folder that cannot be made.
  EXPECT_EQ(run_program({"plugins", "new", "--kind", "shape", "oval_link", folder / "d/notes.txt/x"}).code,
            2);
}

}  // namespace
}  // namespace hauberk::test
