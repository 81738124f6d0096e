/// Errors, Pareto fronts, table and pictures of a chart.

#include "document/json_text.hpp"
#include "occurrences.hpp"
#include "tasks/chart/chart_results.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>

#include <algorithm>
#include <limits>
#include <sstream>

namespace hauberk {
namespace {

using test::occurrences;

constexpr double inf = std::numeric_limits<double>::infinity();

PrecisionRun run_of(double value, std::int64_t evaluations, double seconds)
{
  PrecisionRun run;
  run.status = RowStatus::done;
  run.values = {value};
  run.estimates = {std::nullopt};
  run.locked = 1;
  run.iterations = 7;
  run.evaluations = evaluations;
  run.seconds = seconds;
  return run;
}

PrecisionRun failed_run(const std::string& message)
{
  PrecisionRun run;
  run.status = RowStatus::failed;
  run.message = message;
  run.values = {std::nullopt};
  run.estimates = {std::nullopt};
  run.seconds = 0.5;
  return run;
}

/// One scene, whose limit is exactly 1; a method with four settings and one with one; two runs each.
PrecisionChart sample(const std::vector<int>& threads = {1})
{
  PrecisionChart chart;
  chart.repeats = 2;
  chart.threads = threads;
  chart.scenes = {{"ring <a>", {{Direction::at_degrees(0), "stretch"}}, {1.0}, false, std::nullopt}};
  chart.methods = {{"slow, but", {"1", "2", "3", "4"}}, {"quick", {""}}};
  for (const auto& [method, setting] :
       std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 0}}) {
    for (const int n : threads) {
      PrecisionPoint& p = chart.points.emplace_back();
      p.method = method;
      p.setting = setting;
      p.threads = n;
    }
  }
  return chart;
}

/// All runs made: errors 1e-2, 1e-4, 0, none, 1e-3; seconds 4, 2, 8, -, 1.
PrecisionChart complete()
{
  PrecisionChart chart = sample();
  for (int k = 0; k < 2; ++k) {
    const double later = k == 0 ? 0.5 : 1.5;
    enter_run(chart, 0, run_of(1.02, 100, 4.0 * later));
    enter_run(chart, 1, run_of(0.9998, 300, 2.0 * later));
    enter_run(chart, 2, run_of(1.0, 900, 8.0 * later));
    enter_run(chart, 4, run_of(1.002, 400, 1.0 * later));
  }
  enter_run(chart, 3, failed_run("lost its way, \"there\""));
  return chart;
}

TEST(PrecisionChart, ErrorsAndMedians)
{
  const PrecisionChart chart = complete();
  EXPECT_NEAR(chart.points[0].error.value(), 1e-2, 1e-12) << "|1.02 - 1|/(1 + 1)";
  EXPECT_NEAR(chart.points[1].error.value(), 1e-4, 1e-12);
  EXPECT_EQ(chart.points[2].error, 0.0);
  EXPECT_EQ(chart.points[0].median_seconds(), 4.0);
  EXPECT_EQ(chart.points[0].status, RowStatus::done);
  EXPECT_EQ(chart.points[3].status, RowStatus::failed);
  EXPECT_FALSE(chart.points[3].error);
  PrecisionPoint odd;
  odd.seconds = {3.0, 1.0, 2.0};
  EXPECT_EQ(odd.median_seconds(), 2.0);
}

TEST(PrecisionChart, TheWorstOfSeveralLimitsCountsAndThoseNotKnownDoNot)
{
  PrecisionChart chart = sample();
  chart.scenes[0].limits.resize(3, chart.scenes[0].limits[0]);
  chart.scenes[0].exact = {1.0, std::nullopt, -0.5};
  PrecisionRun run = run_of(1.02, 1, 1.0);
  run.values = {1.02, 77.0, -0.53};
  enter_run(chart, 0, run);
  EXPECT_NEAR(chart.points[0].error.value(), 0.02, 1e-15) << "0.03/1.5";
  run.values = {1.02, std::nullopt, std::nullopt};
  enter_run(chart, 1, run);
  EXPECT_EQ(chart.points[1].status, RowStatus::failed);
  EXPECT_EQ(chart.points[1].message, "stretch at 0 degrees has no value, known is -0.5");
}

TEST(PrecisionChart, ParetoFrontsOfTimeAndWork)
{
  const PrecisionChart chart = complete();
  std::vector<bool> time, work;
  for (const PrecisionPoint& p : chart.points) {
    time.push_back(p.pareto);
    work.push_back(p.pareto_work);
  }
  // By time the quick method beats the first setting; by work, where it costs more than the second one, not.
  EXPECT_EQ(time, (std::vector<bool>{false, true, true, false, true}));
  EXPECT_EQ(work, (std::vector<bool>{true, true, true, false, false}));
  // Equal points are both on the front, and errors below the least one are equal.
  PrecisionChart equal = sample();
  enter_run(equal, 0, run_of(1.0, 10, 1.0));
  enter_run(equal, 1, run_of(std::nextafter(1.0, inf), 10, 1.0));
  EXPECT_GT(equal.points[1].error, 0.0);
  EXPECT_TRUE(equal.points[0].pareto);
  EXPECT_FALSE(equal.points[1].pareto) << "1.1e-16 is larger";
  enter_run(equal, 2, run_of(1.0, 10, 1.0));
  EXPECT_TRUE(equal.points[0].pareto && equal.points[2].pareto);
}

TEST(PrecisionChart, RunsThatDifferFail)
{
  PrecisionChart chart = sample({1, 2});
  enter_run(chart, 0, run_of(0.25, 10, 1.0));
  enter_run(chart, 0, run_of(0.25, 10, 2.0));
  EXPECT_EQ(chart.points[0].status, RowStatus::done);
  // Another number of threads: by the last bit.
  enter_run(chart, 1, run_of(std::nextafter(0.25, inf), 10, 1.0));
  EXPECT_EQ(chart.points[1].status, RowStatus::failed);
  EXPECT_FALSE(chart.points[1].reproducible);
  EXPECT_FALSE(chart.points[1].error);
  EXPECT_EQ(chart.points[1].message,
            "run 1 differs from that with threads 1: limit 0: 0.25000000000000006 instead of 0.25");
  // Another run: in its work.
  enter_run(chart, 2, run_of(0.5, 10, 1.0));
  enter_run(chart, 2, run_of(0.5, 11, 1.0));
  EXPECT_EQ(chart.points[2].message,
            "run 2 differs from the first one: 7 Newton steps and 11 evaluations instead of 7 and 10");
  // And one that fails after another has not.
  enter_run(chart, 4, run_of(0.5, 10, 1.0));
  enter_run(chart, 4, failed_run("no"));
  EXPECT_FALSE(chart.points[4].reproducible);
}

TEST(PrecisionChart, ReferenceGivesExactValuesOrNone)
{
  PrecisionChart chart = sample();
  chart.scenes[0].exact.clear();
  chart.scenes[0].has_reference = true;
  enter_run(chart, 0, run_of(1.02, 1, 1.0));
  EXPECT_FALSE(chart.points[0].error) << "not known yet";
  PrecisionRun reference = run_of(1.0, 1, 1.0);
  reference.estimates = {4e-6};
  PrecisionChart known = chart;
  enter_reference(known, 0, reference);
  enter_run(known, 0, run_of(1.02, 1, 1.0));
  EXPECT_NEAR(known.points[0].error.value(), 1e-2, 1e-12);
  EXPECT_EQ(known.scenes[0].floor(), 2e-6);
  EXPECT_NE(chart_svg(known, PrecisionCost::seconds, "x").find("error estimate of the reference, 2.0e-06"),
            std::string::npos);
  enter_reference(chart, 0, failed_run("stuck"));
  EXPECT_EQ(chart.points[4].status, RowStatus::failed);
  EXPECT_EQ(chart.points[4].message, "nothing to compare with: the reference failed: stuck");
}

TEST(PrecisionChart, GoesOnFromWhatWasWritten)
{
  PrecisionChart half = sample({1, 2});
  enter_run(half, 0, run_of(1.02, 100, 4.0));
  half.points[0].peak_memory_bytes = 12345;
  enter_run(half, 2, failed_run("lost"));
  enter_run(half, 4, run_of(1.0 / 3.0, 100, 4.0));
  enter_run(half, 4, run_of(1.0 / 3.0, 100, 5.0));
  PrecisionChart again = sample({1, 2});
  ASSERT_TRUE(take_chart(parse_json(write_json(chart_json(half)), "chart"), again));
  EXPECT_EQ(write_json(chart_json(again)), write_json(chart_json(half)));
  EXPECT_EQ(again.points[0].status, RowStatus::interrupted);
  // Both go on to the same: by the second run of a point and by other threads of one that is done or failed.
  for (PrecisionChart* chart : {&half, &again}) {
    enter_run(*chart, 0, run_of(1.02, 100, 2.0));
    enter_run(*chart, 3, failed_run("lost"));
    enter_run(*chart, 5, run_of(1.0 / 3.0, 101, 5.0));
  }
  EXPECT_EQ(write_json(chart_json(again)), write_json(chart_json(half)));
  EXPECT_EQ(again.points[0].status, RowStatus::done);
  EXPECT_TRUE(again.points[3].reproducible);
  EXPECT_FALSE(again.points[5].reproducible);
  PrecisionChart other = sample({1});
  EXPECT_FALSE(take_chart(chart_json(half), other));
}

TEST(PrecisionChart, TableIsWhatTheDocumentSays)
{
  const PrecisionChart chart = complete();
  const boost::json::value document = chart_json(chart);
  std::istringstream table(chart_csv(chart));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(
      line,
      "scene,method,setting,threads,status,error,seconds_median,seconds_min,seconds_max,runs,evaluations,"
      "iterations,peak_memory_bytes,locked,limits,pareto,pareto_work,reproducible,message");
  std::getline(table, line);
  EXPECT_EQ(line, "ring <a>,\"slow, but\",1,1,done," +
                      number_text(document.at_pointer("/points/0/error").to_number<double>()) +
                      ",4,2,6,2,100,7,,1,1,false,true,true,");
  for (int k = 0; k < 3; ++k) std::getline(table, line);
  EXPECT_EQ(line,
            "ring <a>,\"slow, but\",4,1,failed,,0.5,0.5,0.5,1,0,0,,0,1,false,false,true,\"lost its way, "
            "\"\"there\"\"\"");
  EXPECT_EQ(document.at_pointer("/points/1/seconds/runs").as_array(), (boost::json::array{1.0, 3.0}));
  EXPECT_EQ(document.at_pointer("/counts/done").as_int64(), 4);
  EXPECT_EQ(document.at_pointer("/counts/failed").as_int64(), 1);
}

TEST(PrecisionChart, PictureShowsLinesMarkersFrontAndWhatFailed)
{
  const PrecisionChart chart = complete();
  const std::string text = chart_svg(chart, PrecisionCost::seconds, "a & b");
  EXPECT_NE(text.find("a &amp; b"), std::string::npos);
  EXPECT_NE(text.find("ring &lt;a&gt;"), std::string::npos);
  EXPECT_NE(text.find(">slow, but<"), std::string::npos);
  // In the legend and at the points: circles of the first method, squares of the second.
  EXPECT_EQ(occurrences(text, "r=\"4.00\""), 1 + 3);
  EXPECT_EQ(occurrences(text, "width=\"7.20\" height=\"7.20\""), 1 + 1);
  EXPECT_EQ(occurrences(text, "stroke-width=\"2.20\""), 1 + 3) << "rings";
  EXPECT_EQ(occurrences(text, "stroke-dasharray=\"8,4\""), 1) << "a line of one point is none";
  // From the point with most error to the one with none, which stands at the bottom: 1e-16 to 1e-2.
  for (const char* tick : {">1e-16<", ">1e-2<", ">1e0<", ">1e1<"})
    EXPECT_NE(text.find(tick), std::string::npos) << tick;
  EXPECT_EQ(occurrences(text, ">1e-17<") + occurrences(text, ">1e-1<"), 0);
  EXPECT_EQ(occurrences(text, "ring &lt;a&gt;, slow, but, 4: failed: lost its way, &quot;there&quot;<"), 1);
  // In the order of time: 2, 4 and 8 seconds on an axis from 1 to 10, of which 380 units are a decade.
  EXPECT_NE(text.find("<path d=\"M170.39,"), std::string::npos) << text;
  const std::string work = chart_svg(chart, PrecisionCost::evaluations, "a & b");
  EXPECT_EQ(occurrences(work, "stroke-width=\"2.20\""), 1 + 3);
  EXPECT_NE(work.find(">evaluations of closest points<"), std::string::npos);
  EXPECT_NE(work.find(">1e2<"), std::string::npos);
  EXPECT_NE(work, text);
  EXPECT_EQ(chart_svg(chart, PrecisionCost::seconds, "a & b"), text);
}

TEST(PrecisionChart, PictureOfNothingIsWhole)
{
  const std::string text = chart_svg(sample(), PrecisionCost::seconds, "none");
  EXPECT_TRUE(text.ends_with("</svg>\n"));
  EXPECT_EQ(occurrences(text, ": interrupted<"), 5);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace hauberk
