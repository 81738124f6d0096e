/// `hauberk run` of a small stability experiment, from the file to counts.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <fstream>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

std::string outcome_at(const json::value& results, int k)
{
  return std::string(results.at_pointer("/stability/cases/" + std::to_string(k) + "/outcome").as_string());
}

TEST(StabilityRun, ClassifiesEveryCase)
{
  const WorkFolder folder;
  const Outcome o = run_program({"run", folder.write("map.json", map_text()), "-o", folder / "out"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  const json::value r = read_results(folder / "out");
  ASSERT_EQ(r.at_pointer("/stability/cases").as_array().size(), 10U);
  for (const int method : {0, 1}) {
    EXPECT_EQ(outcome_at(r, method), "verified");
    EXPECT_EQ(outcome_at(r, 2 + method), "silent_wrong") << "further than what is said to be exact";
    EXPECT_EQ(outcome_at(r, 4 + method), "local") << "short of what is said to be exact";
    EXPECT_EQ(outcome_at(r, 6 + method), "honest_failure");
    EXPECT_EQ(outcome_at(r, 8 + method), "verified") << "unbounded, and rightly";
  }
  EXPECT_EQ(r.at_pointer("/stability/cases/6/status").as_string(), "refused");
  EXPECT_NE(r.at_pointer("/stability/cases/6/reason").as_string().find("overlap at rest"), std::string::npos);
  EXPECT_EQ(r.at_pointer("/stability/families/0/methods/1/counts/local").as_int64(), 1);
  EXPECT_EQ(r.at_pointer("/files/picture").as_string(), "stability.svg");
  for (const char* file : {"stability.csv", "stability.svg"})
    EXPECT_GT(fs::file_size(folder.path() / "out" / file), 0U);
  EXPECT_NE(o.out.find("thickness  wide             1      1        1       1\n"), std::string::npos)
      << o.out;
  EXPECT_NE(o.out.find("all 1 expected results are met\n"), std::string::npos) << o.out;
  EXPECT_NE(o.err.find("stability: 10/10"), std::string::npos) << o.err;
}

TEST(StabilityRun, SameResultsForAnyNumberOfThreads)
{
  const WorkFolder folder;
  const std::string file = folder.write("map.json", map_text());
  std::vector<std::string> texts;
  for (const char* n : {"1", "2", "5"}) {
    const std::string out = folder / (std::string("out") + n);
    ASSERT_EQ(run_program({"run", file, "-o", out, "--threads", n}).code, 0);
    texts.push_back(write_json(timeless(read_results(out))) + read_text(out + "/stability.svg"));
  }
  EXPECT_EQ(texts[0], texts[1]);
  EXPECT_EQ(texts[0], texts[2]);
}

TEST(StabilityRun, ResumesWhatIsMissing)
{
  const WorkFolder folder;
  const std::string file = folder.write("map.json", map_text()), out = folder / "out";
  ASSERT_EQ(run_program({"run", file, "-o", out}).code, 0);
  const json::value whole = read_results(out);
  json::value partial = whole;
  for (const char* k : {"/stability/cases/1", "/stability/cases/7"})
    partial.at_pointer(std::string(k) + "/outcome") = "interrupted";
  // Marks a case that must not be computed again.
  partial.at_pointer("/stability/cases/0/message") = "kept";
  write_partial_results(out, partial);
  const Outcome o = run_program({"run", file, "-o", out, "--resume"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_NE(o.err.find("resuming: finished cases are kept\n"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("stability: 2/2"), std::string::npos) << o.err;
  json::value resumed = read_results(out);
  EXPECT_EQ(resumed.at_pointer("/stability/cases/0/message").as_string(), "kept");
  resumed.at_pointer("/stability/cases/0/message") = whole.at_pointer("/stability/cases/0/message");
  EXPECT_EQ(write_json(timeless(resumed)), write_json(timeless(whole)));
  EXPECT_EQ(run_program({"run", file, "-o", out, "--resume"}).out, out +
                                                                       "/results.json: complete already\n"
                                                                       "all 1 expected results are met\n");
}

TEST(StabilityRun, MistakesOfFormAreBadInput)
{
  const WorkFolder folder;
  const std::string text =
      with(map_text(), R"("/solver/contact": "nearest")", R"("/solver/contact": "nearst")");
  const Outcome o = run_program({"run", folder.write("map.json", text), "-o", folder / "out"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("family 'thickness', member '0.7', method 'wide': expected one of auto, nearest, arc, "
                       "published, mesh, constrained, found \"nearst\"; did you mean 'nearest'?"),
            std::string::npos)
      << o.err;
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace hauberk::test
