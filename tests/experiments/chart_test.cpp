/// `hauberk run` of charts, from the file to points and pictures.

#include "chart_fixture.hpp"
#include "document/json_text.hpp"

#include <boost/json/array.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hauberk::test {
namespace {

namespace json = boost::json;

class ChartRun : public ChartFixture {};

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
    // The error is against the reference, which is off by its own.
    const double floor = k < 10 ? 0.0 : number_at(results_, "/chart/scenes/1/floor");
    EXPECT_NEAR(number_at(p, "/error"), error, 1e-9 * error + 1e-10 + floor) << k;
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
  EXPECT_GT(number_at(read_timings(*folder_ / "out"), "/peak_memory_bytes"), 4e6) << "forgotten for a point";
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

}  // namespace
}  // namespace hauberk::test
