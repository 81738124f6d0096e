/// `hauberk run` of a small transition experiment.

#include "document/json_text.hpp"
#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

TEST(TransitionRun, ComputesAndWritesEverything)
{
  const WorkFolder folder;
  const std::string file = folder.write("turn.json", transition_text()), out = folder / "out";
  EXPECT_EQ(run_program({"check", file, "--thorough"}).out,
            file + ": no problems; 1 paths, 2 formulations\n");
  const Outcome o = run_program({"run", file, "-o", out});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  for (const char* name : {"transition.csv", "minima.csv", "transition.svg"})
    EXPECT_GT(fs::file_size(folder.path() / "out" / name), 0U);
  const json::value r = read_results(out);
  EXPECT_EQ(r.at_pointer("/files/picture").as_string(), "transition.svg");
  EXPECT_EQ(r.at_pointer("/transition/paths/0/samples").as_array().size(), 11U);
  EXPECT_EQ(r.at_pointer("/transition/paths/0/most_minima").to_number<int>(), 2);
  EXPECT_NE(o.out.find("pitchfork  nearest"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("all 2 expected results are met\n"), std::string::npos) << o.out;
  EXPECT_NE(o.err.find("transition: 3/3"), std::string::npos) << o.err;
  EXPECT_EQ(run_program({"verify", out + "/results.json"}).code, 0);
  EXPECT_EQ(run_program({"run", file, "-o", out, "--resume"}).out,
            out + "/results.json: complete already\nall 2 expected results are met\n");
}

TEST(TransitionRun, OverlappingPathsAreBadInput)
{
  const WorkFolder folder;
  const std::string file = folder.write("turn.json", with(transition_text(), "[4, -1.5]", "[4, -4]"));
  const Outcome o = run_program({"run", file, "-o", folder / "out"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("/transition/paths/0: path 'pitchfork': the surfaces touch or overlap at step"),
            std::string::npos)
      << o.err;
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace hauberk::test
