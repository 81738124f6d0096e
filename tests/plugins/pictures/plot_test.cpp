#include "document/json_text.hpp"
#include "occurrences.hpp"
#include "pictures/polar_svg.hpp"
#include "pictures/strokes.hpp"
#include "sample_run.hpp"
#include "tasks/sweep/sweep_results.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <tuple>

namespace hauberk {
namespace {

using test::occurrences;

TEST(Strokes, NoTwoAreAlike)
{
  std::set<std::tuple<std::string, std::string, double>> seen;
  for (std::size_t k = 0; k < 300; ++k) {
    const detail::Stroke stroke = detail::distinct_stroke(k);
    EXPECT_TRUE(seen.emplace(stroke.colour, stroke.dash, stroke.width).second) << k;
  }
}

TEST(PolarPlot, DesignShowsBeforeAfterAndTargets)
{
  const std::string svg = polar_svg(test::sample_design(), {"chain <1>", "tensor & clearance 0"});
  EXPECT_EQ(occurrences(svg, "<path "), 6) << "eta, stretch, compression; before and after";
  EXPECT_EQ(occurrences(svg, R"(r="5.00" fill="#c00000")"), 13) << "six targets twice, and the legend";
  EXPECT_EQ(occurrences(svg, "chain &lt;1&gt;"), 1);
  EXPECT_EQ(occurrences(svg, "tensor &amp; clearance 0"), 1);
  EXPECT_EQ(occurrences(svg, "<svg "), 1);
  EXPECT_EQ(occurrences(svg, "</svg>"), 1);
}

/// Distances from the diagram's centre of the corners of a bound's arrowhead, the tip last.
std::array<double, 3> corner_distances(const std::string& svg, std::size_t number)
{
  std::size_t at = 0;
  for (std::size_t k = 0; k <= number; ++k) at = svg.find("<polygon points=\"", at) + 17;
  std::array<double, 6> c{};
  EXPECT_EQ(
      std::sscanf(svg.c_str() + at, "%lf,%lf %lf,%lf %lf,%lf", &c[0], &c[1], &c[2], &c[3], &c[4], &c[5]), 6);
  // The outermost ring is around the centre.
  double x = 0.0, y = 0.0;
  EXPECT_EQ(std::sscanf(svg.c_str() + svg.find("<circle"), "<circle cx=\"%lf\" cy=\"%lf\"", &x, &y), 2);
  std::array<double, 3> out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = std::hypot(c[2 * k] - x, c[2 * k + 1] - y);
  return out;
}

TEST(PolarPlot, BoundsPointToWhatIsAllowed)
{
  RunResult run = test::sample_design();
  std::vector<DesignTargetResult>& targets = run.design->targets;
  const double value = targets[0].target;
  for (DesignTargetResult& target : targets) target.target = value;
  const std::string plain = polar_svg(run, {});
  EXPECT_EQ(occurrences(plain, "<polygon"), 0);
  targets[1].aim = Aim::no_further;
  targets[4].aim = Aim::no_nearer;
  const std::string svg = polar_svg(run, {});
  EXPECT_EQ(occurrences(svg, R"(r="5.00" fill="#c00000")"), 9) << "four targets twice, and the legend";
  EXPECT_EQ(occurrences(svg, "<polygon"), 6) << "two bounds twice, and the legend";
  EXPECT_EQ(occurrences(svg, "bounds: no further"), 1);
  EXPECT_EQ(occurrences(svg, "bounds: no nearer"), 1);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [base, other, tip] = corner_distances(svg, k);
    EXPECT_NEAR(base, other, 0.02) << k;
    EXPECT_NEAR(std::abs(tip - base), 11.0, 0.3) << k;
    EXPECT_EQ(tip > base, k >= 2) << k;
  }
}

TEST(PolarPlot, ClosedCurvesOnlyWithoutHoles)
{
  RunResult run = test::sample_run();
  EXPECT_EQ(occurrences(polar_svg(run, {}), " Z\""), 3);
  run.profiles[4].eta.reset();
  const std::string holed = polar_svg(run, {});
  EXPECT_EQ(occurrences(holed, " Z\""), 2);
  EXPECT_EQ(occurrences(holed, "<path "), 4) << "eta in two halves";
}

TEST(PolarPlot, SingleDirectionIsDotsAndEmptyResultsSaySo)
{
  RunResult run = test::sample_run();
  run.profiles = {{0.0, 0.43, std::nullopt, std::nullopt}};
  const std::string svg = polar_svg(run, {});
  EXPECT_EQ(occurrences(svg, "<path "), 0);
  EXPECT_EQ(occurrences(svg, R"(r="2.40")"), 3) << "0 and 180 degrees, and the legend";
  run.profiles = {{0.0, std::nullopt, std::nullopt, std::nullopt}};
  EXPECT_EQ(occurrences(polar_svg(run, {}), "No direction has a limit to show."), 1);
}

TEST(PolarPlot, UnboundedDirectionsAreMarked)
{
  RunResult run = test::sample_run();
  PlotLabels labels;
  labels.positive = "stretch";
  labels.negative = "compress";
  EXPECT_EQ(occurrences(polar_svg(run, labels), "\u221e"), 0);
  run.limits[0].sense = "stretch";
  run.limits[0].direction = Direction::at_degrees(200.0);  // the same as 20
  run.limits[0].status = LimitStatus::unbounded;
  const std::string svg = polar_svg(run, labels);
  EXPECT_EQ(occurrences(svg, "fill=\"#1f4e79\">\u221e</text>"), 2) << "stretch, at 20 and 200 degrees";
  EXPECT_EQ(occurrences(svg, "fill=\"#111\">\u221e</text>"), 2) << "eta";
  EXPECT_EQ(occurrences(svg, "(\u221e: no limit)"), 2) << "both legends";
}

TEST(SweepPlot, RowsThatFailedAreGaps)
{
  SweepTable table;
  table.axes.push_back({"R", {}, false});
  table.measures.push_back({"stretch 0", "/limits/0/value"});
  for (const double x : {1.0, 2.0, 3.0, 4.0})
    table.rows.push_back({{x}, RowStatus::done, "", {0.1 * x}, nullptr});
  const std::string all = sweep_svg(table, "t", "s");
  table.rows[1].status = RowStatus::failed;
  table.rows[1].measured = {7.0};
  const std::string failed = sweep_svg(table, "t", "s");
  EXPECT_NE(failed, all);
  table.rows[1].measured = {std::nullopt};
  EXPECT_EQ(failed, sweep_svg(table, "t", "s")) << "neither a point nor a scale follows from it";
}

/// No axis has ticks between neighbouring numbers: their places would never be reached.
TEST(SweepPlot, ValuesThatDifferByRoundingAreOneLine)
{
  SweepTable table;
  table.axes.push_back({"z", {}, false});
  table.measures.push_back({"compress 45", "/limits/0/value"});
  for (const double d : {0.0, 1.0, 2.0}) {
    const double y = -0.6590 + d * 1.1e-16, x = 1e9 + d * 1.2e-7;
    table.rows.push_back({{x}, RowStatus::done, "", {y}, nullptr});
  }
  EXPECT_LT(sweep_svg(table, "t", "s").size(), 20000U);
}

}  // namespace
}  // namespace hauberk
