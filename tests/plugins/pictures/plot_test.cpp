#include "document/json_text.hpp"
#include "pictures/polar_svg.hpp"
#include "sample_run.hpp"
#include "tasks/sweep/sweep_results.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace hauberk {
namespace {

std::size_t count(const std::string& text, const std::string& what)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

TEST(PolarPlot, DesignShowsBeforeAfterAndTargets)
{
  const std::string svg = polar_svg(test::sample_design(), {"chain <1>", "tensor & clearance 0"});
  EXPECT_EQ(count(svg, "<path "), 6u) << "eta, stretch, compression; before and after";
  EXPECT_EQ(count(svg, R"(r="5.00" fill="#c00000")"), 13u) << "six targets twice, and the legend";
  EXPECT_EQ(count(svg, "chain &lt;1&gt;"), 1u);
  EXPECT_EQ(count(svg, "tensor &amp; clearance 0"), 1u);
  EXPECT_EQ(count(svg, "<svg "), 1u);
  EXPECT_EQ(count(svg, "</svg>"), 1u);
}

TEST(PolarPlot, ClosedCurvesOnlyWithoutHoles)
{
  RunResult run = test::sample_run();
  EXPECT_EQ(count(polar_svg(run, {}), " Z\""), 3u);
  run.profiles[4].eta.reset();
  const std::string holed = polar_svg(run, {});
  EXPECT_EQ(count(holed, " Z\""), 2u);
  EXPECT_EQ(count(holed, "<path "), 4u) << "eta in two halves";
}

TEST(PolarPlot, SingleDirectionIsDotsAndEmptyResultsSaySo)
{
  RunResult run = test::sample_run();
  run.profiles = {{0.0, 0.43, std::nullopt, std::nullopt}};
  const std::string svg = polar_svg(run, {});
  EXPECT_EQ(count(svg, "<path "), 0u);
  EXPECT_EQ(count(svg, R"(r="2.40")"), 3u) << "0 and 180 degrees, and the legend";
  run.profiles = {{0.0, std::nullopt, std::nullopt, std::nullopt}};
  EXPECT_EQ(count(polar_svg(run, {}), "No direction has a limit to show."), 1u);
}

TEST(PolarPlot, UnboundedDirectionsAreMarked)
{
  RunResult run = test::sample_run();
  PlotLabels labels;
  labels.positive = "stretch";
  labels.negative = "compress";
  EXPECT_EQ(count(polar_svg(run, labels), "\u221e"), 0u);
  run.limits[0].sense = "stretch";
  run.limits[0].direction = Direction::at_degrees(200.0);  // the same as 20
  run.limits[0].status = LimitStatus::unbounded;
  const std::string svg = polar_svg(run, labels);
  EXPECT_EQ(count(svg, "fill=\"#1f4e79\">\u221e</text>"), 2u) << "stretch, at 20 and 200 degrees";
  EXPECT_EQ(count(svg, "fill=\"#111\">\u221e</text>"), 2u) << "eta";
  EXPECT_EQ(count(svg, "(\u221e: no limit)"), 2u) << "both legends";
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
