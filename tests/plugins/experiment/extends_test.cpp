/// Experiments that are others but for what they say themselves.

#include "document/json_writer.hpp"
#include "fake_plugins.hpp"
#include "tasks/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace hauberk::test {
namespace {

class Extends : public ::testing::Test {
 protected:
  void SetUp() override
  {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("extends_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "deeper");
    write("base.json", valid_text());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::optional<Experiment> read(const std::string& text, const std::vector<std::string>& overrides = {})
  {
    diagnostics_ = {};
    const std::string file = (folder_ / "own.json").string();
    std::optional<Experiment> e =
        read_experiment({file, text, overrides, {}, {}, task_formats()}, fake_lookup, diagnostics_);
    problems_ = diagnostics_.text();
    for (std::size_t at; (at = problems_.find(folder_.string() + "/")) != std::string::npos;)
      problems_.erase(at, folder_.string().size() + 1);
    return e;
  }

  std::filesystem::path folder_;
  Diagnostics diagnostics_;
  std::string problems_;  ///< of what was read last
};

TEST_F(Extends, IsTheOtherButForWhatItSays)
{
  const std::optional<Experiment> e = read(R"({
    "extends": "base.json", "name": "wider",
    "elements": { "link": { "parameters": { "ring.R": 5.5 } } },
    "load_case": { "directions_deg": [30] }
  })");
  ASSERT_TRUE(e) << problems_;
  const Experiment same = read_ok(valid_text(), {"/name=wider", "/elements/link/parameters/ring.R=5.5",
                                                 "/load_case/directions_deg=[30]"});
  EXPECT_EQ(e->resolved.find("extends"), nullptr);
  EXPECT_EQ(write_json(e->resolved), write_json(same.resolved));
}

TEST_F(Extends, ChainsOfFilesAreSeenFromWhereEachIs)
{
  write("deeper/middle.json", R"({ "extends": "../base.json", "name": "m", "seed": 7, "solver": null })");
  const std::optional<Experiment> e =
      read(R"({ "extends": "deeper/middle.json", "name": "n" })", {"/seed=8"});
  ASSERT_TRUE(e) << problems_;
  EXPECT_EQ(e->name, "n");
  EXPECT_EQ(e->seed, 8U);
  EXPECT_FALSE(e->solver.tolerance);  // taken away
}

TEST_F(Extends, ProblemsNameTheFileThatTheyAreIn)
{
  write("base.json", with(valid_text(), "\"pair\",", "\"pair\", \"seed\": -1,"));
  const std::string at = "base.json:2: ";
  EXPECT_FALSE(read("{ \"extends\": \"base.json\",\n \"name\": 5 }"));
  EXPECT_EQ(problems_, "own.json:2: /name: expected a string, found 5\n" + at +
                           "/seed: expected an integer >= 0, found -1");
  const std::vector<Problem> of_file = diagnostics_.of_file();
  const auto seed =
      std::find_if(of_file.begin(), of_file.end(), [](const Problem& p) { return p.pointer == "/seed"; });
  ASSERT_NE(seed, of_file.end());
  EXPECT_EQ(seed->line, 0);
  EXPECT_NE(seed->message.find(at + "expected an integer"), std::string::npos) << seed->message;
  // What replaces a place is no longer the other's.
  EXPECT_FALSE(read("{ \"extends\": \"base.json\", \"name\": \"n\",\n \"seed\": -2 }"));
  EXPECT_EQ(problems_, "own.json:2: /seed: expected an integer >= 0, found -2");
  EXPECT_FALSE(read("{ \"extends\": \"base.json\", \"name\": \"n\" }", {"/seed=-3"}));
  EXPECT_EQ(problems_, "command line: /seed: expected an integer >= 0, found -3");
}

/// Objects that several files have parts of, and what a weave makes of a place of another file.
TEST_F(Extends, EveryPlaceKnowsItsFile)
{
  write("base.json", with(valid_text(), "1e-3", "-1e-3"));
  write("middle.json", "{ \"extends\": \"base.json\",\n \"solver\": { \"contact\": \"none\" } }");
  EXPECT_FALSE(read("{ \"extends\": \"middle.json\", \"name\": \"n\",\n\n \"solver\": { \"preset\": 5 } }"));
  EXPECT_EQ(problems_.find("own.json:3: /solver/preset: "), 0U) << problems_;
  EXPECT_NE(problems_.find("\nmiddle.json:2: /solver/contact: "), std::string::npos) << problems_;
  EXPECT_NE(problems_.find("\nbase.json:14: /solver/tolerance: "), std::string::npos) << problems_;
}

TEST_F(Extends, NullTakesAwayAlsoWhatIsNotThere)
{
  const std::optional<Experiment> e =
      read(R"({ "extends": "base.json", "name": "n", "seed": null, "solver": { "starts": null } })");
  ASSERT_TRUE(e) << problems_;
  EXPECT_EQ(e->seed, 1U);
  EXPECT_EQ(e->solver.tolerance, 1e-3);
}

/// The system's "..", not that of the letters: behind a link to a folder it leads elsewhere.
TEST_F(Extends, PathsAreWalked)
{
  std::filesystem::create_directories(folder_ / "real/deep");
  write("real/base.json", with(valid_text(), "\"ring.R\": 5.0", "\"ring.R\": 5.25"));
  write("real/deep/middle.json", R"({ "extends": "../base.json" })");
  std::filesystem::create_directory_symlink(folder_ / "real/deep", folder_ / "link");
  const std::optional<Experiment> e = read(R"({ "extends": "link/middle.json", "name": "n" })");
  ASSERT_TRUE(e) << problems_;
  EXPECT_EQ(e->scene.elements[0].parameters[0], 5.25);
}

TEST_F(Extends, RefusesWhatIsNoOtherExperiment)
{
  const auto problem = [&](const std::string& of) {
    EXPECT_FALSE(read("{ \"extends\": " + of + ", \"name\": \"n\" }"));
    return problems_;
  };
  EXPECT_EQ(problem("5"), "own.json:1: /extends: expected the path of a file");
  EXPECT_NE(problem("\"none.json\"").find("own.json:1: /extends: cannot read 'none.json'"), std::string::npos)
      << problems_;
  EXPECT_NE(problem("\"/dev/zero\"").find("/extends: cannot read '/dev/zero'"), std::string::npos)
      << problems_;
  write("list.json", "[]");
  EXPECT_EQ(problem("\"list.json\""), "own.json:1: /extends: list.json: expected an object");
  write("broken.json", "{\n\"name\": }");
  EXPECT_EQ(problem("\"broken.json\"").find("own.json:1: /extends: broken.json:2: "), 0U) << problems_;
  EXPECT_EQ(problem("\"a\\u0000b\""),
            "own.json:1: /extends: expected the path of a file, found a character that no path has");
  EXPECT_FALSE(read(valid_text(), {"/extends=base.json"}));
  EXPECT_EQ(problems_, "command line: /extends: cannot be set: a file says itself which one it extends");
  write("circle.json", R"({ "extends": "circle.json", "name": "c" })");
  EXPECT_EQ(problem("\"circle.json\""),
            "own.json:1: /extends: circle.json:1: 6 files extend each other in a row: is there a circle?");
}

}  // namespace
}  // namespace hauberk::test
