/// `hauberk run` of charts, from the file to points and pictures.

#include "program.hpp"

#include <hauberk/results/json_text.hpp>

#include <gtest/gtest.h>

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

constexpr std::size_t point_count = 14;

const json::value& point(const json::value& results, std::size_t k)
{
  return results.at_pointer("/chart/points").as_array().at(k);
}

std::string text(const json::value& v) { return std::string(v.as_string()); }

/// Is `part` in `whole`?
::testing::AssertionResult holds(const std::string& whole, const std::string& part)
{
  if (whole.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << part << "' is not in\n" << whole;
}

/// Results of one run that tests look at.
class ChartRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    folder_ = std::make_unique<TemporaryFolder>();
    outcome_ = run_program({"run", folder_->write("c.json", chart_text()), "-o", *folder_ / "out"});
    results_ = read_results(*folder_ / "out");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline Outcome outcome_;
  static inline json::value results_;
};

TEST_F(ChartRun, ErrorsAreThoseOfTheFormula)
{
  ASSERT_EQ(outcome_.code, 0) << outcome_.out << outcome_.err;
  ASSERT_EQ(results_.at_pointer("/chart/points").as_array().size(), point_count);
  // 2 (R_A + R_B - r_A - r_B)/period - 1, tubes 0.7 and 0.6; sideways nothing holds the chain.
  const double thin = 17.6 / 12.0 - 1.0;
  EXPECT_NEAR(number_at(results_, "/chart/scenes/1/exact/0"), thin, 1e-9);
  EXPECT_TRUE(results_.at_pointer("/chart/scenes/1/exact/1").is_null());
  EXPECT_LT(number_at(results_, "/chart/scenes/1/floor"), 1e-9);
  for (std::size_t k = 0; k < point_count; ++k) {
    const json::value& p = point(results_, k);
    if (text(p.at("setting")) == "hasty") continue;
    const double exact = number_at(p, "/values/0") - (k < 10 ? 17.2 / 12.0 - 1.0 : thin);
    const double error = std::abs(exact) / (1.0 + (k < 10 ? 17.2 / 12.0 - 1.0 : thin));
    EXPECT_NEAR(number_at(p, "/error"), error, 1e-9 * error + 1e-10) << k;
    const bool coarse = text(p.at("setting")) == "0.01" || text(p.at("setting")) == "coarse";
    EXPECT_LT(error, coarse ? 1e-2 : 1e-6) << k;
    EXPECT_GT(error, coarse ? 1e-6 : 1e-10) << "what was to be set was not: " << k;
    EXPECT_EQ(number_at(p, "/locked"), 1.0);
    EXPECT_EQ(p.at_pointer("/seconds/runs").as_array().size(), 2U);
    EXPECT_LE(number_at(p, "/seconds/min"), number_at(p, "/seconds/median"));
    EXPECT_LE(number_at(p, "/seconds/median"), number_at(p, "/seconds/max"));
    EXPECT_GT(number_at(p, "/evaluations"), 0.0);
    EXPECT_GT(number_at(p, "/iterations"), 0.0);
    const json::value& peak = p.at("peak_memory_bytes");
    EXPECT_TRUE(peak.is_null() || (peak.to_number<double>() >= 0.0 && peak.to_number<double>() < 100e6));
  }
  // Pairs of points differ in threads alone.
  for (std::size_t k = 0; k < point_count; k += 2) {
    EXPECT_EQ(number_at(point(results_, k), "/threads"), 1.0);
    EXPECT_EQ(number_at(point(results_, k + 1), "/threads"), 2.0);
    EXPECT_EQ(point(results_, k).at("values"), point(results_, k + 1).at("values"));
  }
  EXPECT_GE(number_at(results_, "/provenance/machine/processors"), 1.0);
  EXPECT_GT(number_at(results_, "/provenance/peak_memory_bytes"), 4e6) << "forgotten for a point";
}

TEST_F(ChartRun, PointsThatStallAreToldNotLeftOut)
{
  for (const std::size_t k : {8U, 9U}) {
    EXPECT_EQ(text(point(results_, k).at("status")), "failed");
    EXPECT_TRUE(point(results_, k).at("error").is_null());
    EXPECT_EQ(number_at(point(results_, k), "/locked"), 0.0);
    EXPECT_TRUE(
        holds(text(point(results_, k).at("message")), "stretch at 0 degrees stalled: no minimum after"));
  }
  const std::string out = *folder_ / "out";
  for (const std::string& where :
       {outcome_.out, read_text(out + "/chart.svg"), read_text(out + "/chart_work.svg")})
    EXPECT_TRUE(holds(where, "chain, arc, hasty, 2 threads: failed: stretch at 0 degrees stalled"));
  EXPECT_EQ(number_at(results_, "/chart/counts/done"), 12.0);
}

TEST_F(ChartRun, TerminalTableAndProgress)
{
  EXPECT_TRUE(holds(outcome_.out,
                    "scene            method   setting  threads     error  median s  evaluations  "
                    "Newton steps  peak MB\n"));
  EXPECT_TRUE(holds(outcome_.out, "thin, both ways  nearest  1e-06          2  "));
  EXPECT_TRUE(holds(outcome_.out, "all 1 expected results are met\n"));
  EXPECT_TRUE(holds(outcome_.err, "reference: 1/1"));
  EXPECT_TRUE(holds(outcome_.err, "chart: 28/28"));
}

TEST_F(ChartRun, TableIsTheDocument)
{
  std::istringstream table(read_text(*folder_ / "out/chart.csv"));
  std::string line;
  std::getline(table, line);
  for (std::size_t k = 0; k < point_count; ++k) {
    ASSERT_TRUE(std::getline(table, line));
    const json::value& p = point(results_, k);
    const std::string scene = text(p.at("scene"));
    std::string start = scene.find(',') == std::string::npos ? scene : '"' + scene + '"';
    start += ',' + text(p.at("method")) + ',' + text(p.at("setting")) + ',' +
             std::to_string(p.at("threads").to_number<int>()) + ',' + text(p.at("status")) + ',';
    if (!p.at("error").is_null()) start += number_text(number_at(p, "/error"));
    for (const char* key : {"median", "min", "max"})
      start += ',' + number_text(p.at("seconds").at(key).to_number<double>());
    EXPECT_TRUE(line.starts_with(start)) << line << '\n' << start;
  }
  EXPECT_FALSE(std::getline(table, line));
}

TEST_F(ChartRun, ParetoFrontsByAnotherWay)
{
  // Sorted by cost, a point is on the front where it is more exact than all before.
  for (const std::string key : {"pareto", "pareto_work"}) {
    for (const std::size_t first : {0U, 1U, 10U, 11U}) {
      std::vector<std::tuple<double, double, bool>> points;
      for (std::size_t k = first; k < (first < 10 ? 10 : point_count); k += 2) {
        const json::value& p = point(results_, k);
        if (p.at("error").is_null()) continue;
        const double cost = number_at(p, key == "pareto" ? "/seconds/median" : "/evaluations");
        points.emplace_back(cost, number_at(p, "/error"), p.at(key).as_bool());
      }
      std::sort(points.begin(), points.end());
      double best = 1.0;
      for (const auto& [cost, error, front] : points) {
        EXPECT_EQ(front, error < best) << key << ' ' << first;
        best = std::min(best, error);
      }
    }
  }
}

TEST_F(ChartRun, PicturesShowTheFirstNumberOfThreads)
{
  for (const char* name : {"out/chart.svg", "out/chart_work.svg"}) {
    const std::string picture = read_text(*folder_ / name);
    EXPECT_TRUE(picture.ends_with("</svg>\n"));
    for (const char* part : {">chain<", ">thin, both ways<", ">nearest<", ">arc<", ">1e-4<",
                             ">error of 1 + value<", "error estimate of the reference"})
      EXPECT_TRUE(holds(picture, part));
    std::size_t squares = 0;
    for (std::size_t at = 0; (at = picture.find("width=\"7.20\"", at)) != std::string::npos; ++at) ++squares;
    EXPECT_EQ(squares, 3U) << "arc: legend, coarse, fine";
  }
  EXPECT_TRUE(holds(read_text(*folder_ / "out/chart.svg"), ">seconds, median of 2<"));
  EXPECT_EQ(text(results_.at_pointer("/files/work_picture")), "chart_work.svg");
}

TEST_F(ChartRun, SameValuesInAnotherRun)
{
  const std::string out = *folder_ / "again";
  ASSERT_EQ(run_program({"run", *folder_ / "c.json", "-o", out, "--threads", "1"}).code, 0);
  EXPECT_EQ(write_json(timeless(read_results(out))), write_json(timeless(results_)));
}

TEST_F(ChartRun, ResumesRunsThatAreMissing)
{
  const std::string out = *folder_ / "resumed";
  fs::copy(*folder_ / "out", out);
  json::value partial = results_;
  // One has a run, one has none.
  partial.at_pointer("/chart/points/2/status") = "interrupted";
  partial.at_pointer("/chart/points/2/seconds/runs").as_array().pop_back();
  json::object& none = partial.at_pointer("/chart/points/11").as_object();
  none["status"] = "interrupted";
  none["seconds"] = none["error"] = nullptr;
  none["values"] = json::array{};
  // Marks a point that must not be computed again.
  partial.at_pointer("/chart/points/0/seconds/runs/0") = 1e-9;
  partial.at_pointer("/provenance/machine/load_average") = 1e6;
  std::ofstream(out + "/results.json") << write_json(partial);
  const Outcome o = run_program({"run", *folder_ / "c.json", "-o", out, "--resume"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_TRUE(holds(o.err, "resuming: finished runs are kept\n"));
  EXPECT_TRUE(holds(o.err, "chart: 3/3"));
  const json::value resumed = read_results(out);
  EXPECT_EQ(number_at(resumed, "/chart/points/0/seconds/min"), 1e-9);
  EXPECT_EQ(number_at(resumed, "/chart/points/2/seconds/runs/0"),
            number_at(results_, "/chart/points/2/seconds/runs/0"));
  EXPECT_EQ(number_at(resumed, "/provenance/machine/load_average"), 1e6);
  EXPECT_EQ(write_json(timeless(resumed)), write_json(timeless(results_)));
  EXPECT_EQ(run_program({"verify", out}).code, 0);
  EXPECT_EQ(run_program({"run", *folder_ / "c.json", "-o", out, "--resume"}).out,
            out + "/results.json: complete already\nall 1 expected results are met\n");
}

TEST_F(ChartRun, AnInterruptLeavesWhatIsFinished)
{
  // The last point is never done: its round never ends.
  const std::string file = folder_->write(
      "endless.json", with(with(chart_text(), R"("/solver/max_iterations", "values": [500, 500, 1])",
                                R"("/solver/starts", "values": [1, 1, 200000])"),
                           R"("threads": [1, 2])", R"("threads": [1])"));
  const std::string out = *folder_ / "endless";
  const TemporaryFolder streams;
  Process process({"run", file, "-o", out, "--set", "/expect=[]"}, streams);
  for (int wait = 0; wait < 1200 && !fs::exists(out + "/results.json"); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process.signal(SIGINT);
  const Outcome o = process.wait();
  EXPECT_EQ(o.code, 130) << o.err;
  const json::value r = read_results(out);
  EXPECT_EQ(text(r.at_pointer("/chart/scenes/1/reference/status")), "done");
  const json::value& last = point(r, 4);
  EXPECT_EQ(text(last.at("status")), "interrupted");
  EXPECT_TRUE(last.at("seconds").is_null());
  EXPECT_TRUE(last.at("error").is_null());
  EXPECT_TRUE(holds(read_text(out + "/chart.svg"), "chain, arc, hasty: interrupted<"));
  const Outcome verified = run_program({"verify", out});
  EXPECT_EQ(verified.code, 0) << verified.out;
}

TEST_F(ChartRun, TimesOfAnotherMachineAreNotMixedIn)
{
  const std::string out = *folder_ / "moved";
  fs::copy(*folder_ / "out", out);
  json::value elsewhere = results_;
  elsewhere.at_pointer("/provenance/machine/processors") = 4097;
  elsewhere.at_pointer("/chart/points/2/status") = "interrupted";
  std::ofstream(out + "/results.json") << write_json(elsewhere);
  const Outcome o = run_program({"run", *folder_ / "c.json", "-o", out, "--resume"});
  EXPECT_EQ(o.code, 2);
  EXPECT_TRUE(holds(o.err, "cannot be resumed: it was timed on another machine (4097 of '"));
}

TEST_F(ChartRun, IsVerifiedFromTheFile)
{
  const Outcome good = run_program({"verify", *folder_ / "out"});
  EXPECT_EQ(good.code, 0) << good.out;
  EXPECT_TRUE(holds(good.out, "PASS /chart: 14 points, as asked for\n"));
  EXPECT_TRUE(holds(good.out, "PASS /chart/points/0 (chain, nearest, 0.01): error 6."));
  EXPECT_TRUE(holds(good.out, "NONE /chart/points/8 (chain, arc, hasty): failed, no error\n"));
  const auto after = [&](const std::string& pointer, const json::value& value) {
    json::value wrong = results_;
    wrong.at_pointer(pointer) = value;
    const TemporaryFolder folder;
    const Outcome o = run_program({"verify", folder.write("results.json", write_json(wrong))});
    EXPECT_EQ(o.code, 1) << pointer;
    return o.out;
  };
  const auto changed = [&](const std::string& pointer, double factor) {
    return after(pointer, number_at(results_, pointer) * factor);
  };
  const std::string first = "FAIL /chart/points/0 (chain, nearest, 0.01): ";
  EXPECT_TRUE(holds(changed("/chart/points/0/error", 1.0 + 1e-9), first + "error "));
  EXPECT_TRUE(holds(changed("/chart/points/0/values/0", 1.0 + 1e-12), first + "error "));
  EXPECT_TRUE(holds(after("/chart/points/0/error", nullptr), first + "error null reported"));
  EXPECT_TRUE(holds(changed("/chart/points/0/seconds/median", 1.5), first + "seconds/median "));
  EXPECT_TRUE(holds(changed("/chart/points/0/seconds/runs/0", 1e3), first + "seconds/m"));
  EXPECT_TRUE(holds(after("/chart/points/0/seconds/runs", json::array{1.0}), first + "1 runs, 2 expected"));
  EXPECT_TRUE(holds(after("/chart/points/0/pareto_work", false), first + "pareto_work is wrong"));
  EXPECT_TRUE(holds(after("/chart/points/0/pareto", !point(results_, 0).at("pareto").as_bool()),
                    first + "pareto is wrong"));
  EXPECT_TRUE(
      holds(changed("/chart/points/1/evaluations", 1.5), "not what /chart/points/0 gave with 1 threads"));
  EXPECT_TRUE(holds(changed("/chart/scenes/0/exact/0", 1.0 + 1e-9), "/chart/scenes/0/exact: not what"));
  EXPECT_TRUE(holds(changed("/chart/scenes/1/exact/0", 1.0 + 1e-9), "/chart/scenes/1/exact: not what"));
  EXPECT_TRUE(holds(changed("/chart/scenes/1/floor", 2.0), "/chart/scenes/1/floor: "));
  EXPECT_TRUE(holds(after("/chart/points/8/status", "done"), "counts/done: 13 expected, found 12"));
  EXPECT_TRUE(holds(after("/chart/points/8/status", "done"), "done, but without an error"));
  EXPECT_TRUE(holds(after("/chart/points/3/method", "arc"), "points/3: 'chain' by 'nearest' with 2 threads"));
  EXPECT_TRUE(holds(after("/chart/points/2/setting", "0.01"), "points/2: the same as points/0"));
  EXPECT_TRUE(holds(after("/chart/points", json::array{}), "points: 14 expected, found 0"));
  EXPECT_TRUE(holds(after("/chart", json::object{}), "FAIL /chart"));
}

TEST(ChartInput, MistakesOfTheFileAreBadInput)
{
  const TemporaryFolder folder;
  const auto errors = [&](const std::string& from, const std::string& to) {
    const Outcome o = run_program({"check", folder.write("c.json", with(chart_text(), from, to))});
    EXPECT_EQ(o.code, 2) << o.out;
    return o.err;
  };
  EXPECT_TRUE(holds(errors("\"exact\": 0.43333333333333335", "\"exact\": [0.4, 0.4]"),
                    "c.json:16: /chart/scenes/0/exact: expected 1 exact values, one per limit, found 2\n"));
  EXPECT_TRUE(
      holds(errors(R"("/solver/contact": "arc")", R"("/load_case/directions_deg": [30])"),
            "c.json:22: /chart/methods/1: method 'arc' has other limits than scene 'chain': it may set how "
            "they are found, not which they are\n"));
  EXPECT_TRUE(
      holds(errors("\"/elements/link/parameters/ring.r0\": 0.6", "\"/elements/link/parameters/ring.r0\": 6"),
            "c.json:17: /chart/scenes/1: scene 'thin, both ways': /elements/link/parameters"));
  const std::string wrong = errors(R"("/solver/contact": "arc")", R"("/solver/contact": "ark")");
  EXPECT_TRUE(
      holds(wrong, "scene 'chain', method 'arc', setting 'coarse': expected one of auto, nearest, arc"));
  EXPECT_EQ(std::count(wrong.begin(), wrong.end(), '\n'), 1) << "once, not for every setting:\n" << wrong;
  const Outcome good = run_program({"check", folder.write("c.json", chart_text())});
  EXPECT_EQ(good.out, folder / "c.json: no problems; 2 scenes, 2 methods, 14 points of 2 runs\n");
}

TEST(ChartInput, RefusedPointsAndFailedReferencesSaySo)
{
  const TemporaryFolder folder;
  // The reference stalls; a method whose clearance leaves no room at rest is refused.
  const std::string file = folder.write(
      "c.json", with(with(chart_text(), R"("reference": { "set": { "/solver/tolerance": 1e-10 })",
                          R"("reference": { "set": { "/solver/max_iterations": 1 })"),
                     R"("set": { "/solver/contact": "arc" })", R"("set": { "/solver/clearance": 4.5 })"));
  const Outcome o = run_program({"run", file, "-o", folder / "out", "--set", "/expect=[]"});
  EXPECT_EQ(o.code, 1) << "without its reference a scene says nothing";
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(text(r.at_pointer("/chart/scenes/1/reference/status")), "failed");
  EXPECT_TRUE(r.at_pointer("/chart/scenes/1/exact").is_null());
  EXPECT_TRUE(holds(text(point(r, 10).at("message")),
                    "nothing to compare with: the reference failed: stretch at 0 degrees stalled"));
  EXPECT_TRUE(point(r, 10).at("seconds").is_null()) << "not solved in vain";
  EXPECT_EQ(text(point(r, 4).at("status")), "refused");
  EXPECT_TRUE(point(r, 4).at("seconds").is_null());
  EXPECT_EQ(number_at(r, "/chart/counts/refused"), 6.0);
  const Outcome verified = run_program({"verify", folder / "out"});
  EXPECT_EQ(verified.code, 0) << verified.out;
  EXPECT_EQ(run_program({"run", file, "-o", folder / "out", "--set", "/expect=[]", "--resume"}).code, 1);
}

}  // namespace
}  // namespace hauberk::test
