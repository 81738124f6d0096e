/// `hauberk report` of results that the program computed.

#include "document/json_text.hpp"
#include "program.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <fstream>
#include <sstream>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const fs::path& table)
{
  std::istringstream lines(read_text(table));
  std::vector<std::string> header;
  std::vector<Row> out;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream rest(line + ",");
    for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), header.size()) << line;
    out.emplace_back();
    for (std::size_t k = 0; k < cells.size() && k < header.size(); ++k) out.back()[header[k]] = cells[k];
  }
  return out;
}

std::string published_design_text()
{
  return with(with(design_text(), R"("value": 0.066 })", R"("value": 0.066, "published": 0.06 })"),
              R"("quantity": "stretch",)",
              R"("quantity": "stretch", "published": { "source": "a book", "iterations": 7 },)");
}

/// A design, its designed scene computed apart, and limits: computed once for all tests.
class Report : public ::testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    folder_ = new WorkFolder;
    const std::string design = path("mail"), chain = path("chain");
    ASSERT_EQ(run_program({"run", folder_->write("m.json", published_design_text()), "-o", design}).code, 0);
    ASSERT_EQ(run_program({"run", design + "/designed.json", "-o", design + "/apart", "--set",
                           "/solver/preset=accurate", "--set", "/solver/starts=2"})
                  .code,
              0);
    ASSERT_EQ(run_program({"run", folder_->write("c.json", chain_text()), "-o", chain}).code, 0);
  }
  static void TearDownTestSuite()
  {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string path(const std::string& name) { return *folder_ / name; }

 private:
  static inline WorkFolder* folder_ = nullptr;
};

TEST_F(Report, TableHoldsWhatTheResultsSay)
{
  const std::string out = path("table");
  const Outcome o =
      run_program({"report", path("mail"), path("chain") + "/results.json", "-o", out, "--recheck", "apart"});
  ASSERT_EQ(o.code, 0) << o.err;
  // The page needs a viewer, which may not have been built: then a word says so.
  const bool page_there = std::filesystem::exists(out + "/report.html");
  EXPECT_EQ(o.out, "2 results in " + out + ": report.md, report.csv, report.svg" +
                       (page_there ? ", report.html\n" : "\n"));
  EXPECT_EQ(o.err.find("the viewer of pages was not built") != std::string::npos, !page_there) << o.err;
  const json::value mail = read_results(path("mail")), chain = read_results(path("chain")),
                    apart = read_results(path("mail") + "/apart");
  std::vector<Row> rows = rows_of(out + "/report.csv");
  ASSERT_EQ(rows.size(), 5U) << "a design, its direction, limits, their direction, total";
  const auto expect_same = [](const std::string& cell, const json::value& document, const char* pointer) {
    ASSERT_NE(cell, "") << pointer;
    EXPECT_EQ(std::stod(cell), number_at(document, pointer)) << pointer;
  };
  for (const char* name : {"iterations", "evaluations"})
    expect_same(rows[0][name], mail, (std::string("/design/") + name).c_str());
  const json::value times = read_timings(path("mail"));
  expect_same(rows[0]["seconds"], times, "/seconds/~1design");
  expect_same(rows[0]["peak_memory_bytes"], times, "/peak_memory_bytes");
  for (const char* name : {"target", "initial", "provisional", "recomputed"})
    expect_same(rows[1][name], mail, (std::string("/design/targets/0/") + name).c_str());
  expect_same(rows[1]["published"], mail, "/experiment/design/targets/0/published");
  expect_same(rows[1]["rechecked"], apart, "/limits/0/value");
  expect_same(rows[3]["e_s"], chain, "/limits/0/value");
  EXPECT_EQ(rows[3]["e_c"], "");
  EXPECT_EQ(rows[0]["published_iterations"], "7");
  EXPECT_EQ(rows[4]["targets"] + rows[4]["targets_met"], "11");
  const double value = number_at(mail, "/design/targets/0/recomputed");
  EXPECT_EQ(std::stod(rows[1]["deviation"]), value - 0.066);
  EXPECT_NEAR(std::stod(rows[0]["rms_percent"]), 100.0 * std::abs(value / 0.066 - 1.0), 1e-10);
  // The search's stages are coarse (preset fast), the scene is the same.
  EXPECT_NE(std::stod(rows[1]["recheck_change"]), 0.0);
  EXPECT_NEAR(std::stod(rows[1]["recheck_change"]), 0.0, 1e-3);

  const std::string text = read_text(out + "/report.md"), page = read_text(out + "/report.svg");
  for (const char* part :
       {"\n## mail\n", "\n## chain\n", "Published: a book.", "![Limits against direction](report.svg)"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  for (const char* part : {">mail<", ">chain<", ">targets<", ">published<", ">stretch, initial<", "</svg>\n"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(Report, WithoutRecheckThereIsNone)
{
  ASSERT_EQ(run_program({"report", path("mail"), "-o", path("none")}).code, 0);
  EXPECT_EQ(rows_of(path("none") + "/report.csv")[1]["rechecked"], "");
}

TEST_F(Report, ReplacesReportsOnlyWithForceAndNeverResults)
{
  const std::string out = path("mail");  // beside its own results
  const Contents before = contents(out);
  ASSERT_EQ(run_program({"report", path("mail"), "-o", out}).code, 0);
  Contents both = contents(out);
  EXPECT_EQ(both.size(), before.size() + 3 + both.count("report.html"));
  const Outcome refused = run_program({"report", path("chain"), "-o", out});
  EXPECT_EQ(refused.code, 2);
  // Where the viewer of pages was not built, a warning stands before it.
  EXPECT_TRUE(refused.err.ends_with(
      "hauberk: " + out + ": holds results already (report.md); give another folder with -o, or --force\n"))
      << refused.err;
  EXPECT_EQ(contents(out), both);
  EXPECT_EQ(run_program({"report", path("chain"), "-o", out, "--force"}).code, 0);
  EXPECT_NE(contents(out), both);
  for (const char* file : {"report.md", "report.csv", "report.svg"}) {
    EXPECT_NE(read_text(fs::path(out) / file).find("chain"), std::string::npos);
    fs::remove(fs::path(out) / file);
  }
  fs::remove(fs::path(out) / "report.html");
  EXPECT_EQ(contents(out), before);
}

TEST_F(Report, BadInputLeavesNothing)
{
  const std::string out = path("bad");
  const auto refused = [&out](std::vector<std::string> words, const std::string& message) {
    words.insert(words.begin(), "report");
    words.insert(words.end(), {"-o", out});
    const Outcome o = run_program(words);
    EXPECT_EQ(o.code, 2) << message;
    EXPECT_EQ(o.err.substr(0, o.err.find('\n')), "hauberk: " + message);
    EXPECT_FALSE(fs::exists(out));
  };
  const WorkFolder bad;
  refused({}, "RESULT is missing");
  refused({path("mail"), bad / "none.json"},
          "cannot read '" + (bad / "none.json") +
              "': No such file or directory; give the results.json that `hauberk run` wrote, or its folder");
  refused({path("mail"), bad.path().string()},
          "cannot read '" + (bad / "results.json") +
              "': No such file or directory; give the results.json that `hauberk run` wrote, or its folder");
  const std::string experiment = bad.write("c.json", chain_text());
  refused(
      {experiment},
      experiment + ": these are no results; give the results.json that `hauberk run` wrote, or its folder");
  const std::string text = read_text(path("mail") + "/results.json");
  const std::string cut = bad.write("cut.json", text.substr(0, text.size() / 2));
  const Outcome spoiled = run_program({"report", cut, "-o", out});
  EXPECT_EQ(spoiled.code, 2);
  EXPECT_EQ(spoiled.err.find("hauberk: " + cut + ":"), 0U) << spoiled.err;
  EXPECT_TRUE(spoiled.err.ends_with("; give the results.json that `hauberk run` wrote, or its folder\n"))
      << spoiled.err;
  EXPECT_FALSE(fs::exists(out));
  const std::string map = bad / "map";
  ASSERT_EQ(run_program({"run", bad.write("m.json", map_text()), "-o", map}).code, 0);
  refused({path("mail"), map},
          map +
              "/results.json: a report shows designs and limits, and these are results of task stability; "
              "leave them out: their folder has a table and a picture of their own");
  refused({path("mail"), "--recheck", "elsewhere"},
          "--recheck elsewhere: no design has a folder of that name with results.json beside its results; "
          "run its designed.json into it, or leave the option out");
  const Outcome nowhere = run_program({"report", path("mail")});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_EQ(nowhere.err.find("hauberk: --output: expected a folder\n"), 0U) << nowhere.err;
}

}  // namespace
}  // namespace hauberk::test
