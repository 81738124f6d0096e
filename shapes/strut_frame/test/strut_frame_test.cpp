/// Cages of struts: the graphs of polyhedra, capsules against samples, and what is refused.

#include "../strut_frame.hpp"
#include "../capsule.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <unistd.h>
#include <cmath>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <random>

namespace hauberk {
namespace {

TEST(Polyhedra, HaveTheirNodesAndStruts)
{
  const std::map<std::string, std::array<int, 3>> expected{{"square", {4, 4, 2}},
                                                           {"tetrahedron", {4, 6, 3}},
                                                           {"cube", {8, 12, 3}},
                                                           {"octahedron", {6, 12, 4}},
                                                           {"truncated_tetrahedron", {12, 18, 3}},
                                                           {"cuboctahedron", {12, 24, 4}}};
  ASSERT_EQ(polyhedra().size(), expected.size());
  for (const Polyhedron& p : polyhedra()) {
    const Graph g = p.graph();
    const auto [nodes, struts, degree] = expected.at(p.name);
    EXPECT_EQ(g.nodes.size(), static_cast<std::size_t>(nodes)) << p.name;
    EXPECT_EQ(g.struts.size(), static_cast<std::size_t>(struts)) << p.name;
    std::vector<int> meet(g.nodes.size(), 0);
    Vec3 sum = Vec3::Zero();
    for (const auto& [a, b] : g.struts) {
      EXPECT_NEAR((g.nodes[a] - g.nodes[b]).norm(), 1.0, 1e-14) << p.name;
      ++meet[a];
      ++meet[b];
    }
    for (std::size_t k = 0; k < g.nodes.size(); ++k) {
      EXPECT_EQ(meet[k], degree) << p.name;
      EXPECT_NEAR(g.nodes[k].norm(), g.nodes[0].norm(), 1e-14) << p.name;
      sum += g.nodes[k];
    }
    EXPECT_LT(sum.norm(), 1e-14) << p.name;
  }
}

TEST(Capsule, IsTheNearestOfManyPointsOfItsSegment)
{
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  const Capsule capsule(1.1, 0.3);
  constexpr int n = 20000;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 x(uniform(rng), uniform(rng), uniform(rng));
    double nearest = 1e300;
    for (int k = 0; k <= n; ++k)
      nearest = std::min(nearest, (x - Vec3(0.0, 0.0, 1.1 * (2.0 * k / n - 1.0))).norm());
    EXPECT_NEAR(capsule.distance(x).distance, nearest - 0.3, 1e-7);
  }
}

TEST(Capsule, ItsSurfaceIsWhereTheDistanceIsZeroAndReachesEverywhere)
{
  const Capsule capsule(1.1, 0.3);
  constexpr int n = 400;
  double lowest = 0.0, highest = 0.0, widest = 0.0, longest = 0.0;
  const auto at = [&](int i, int j) {
    const double u = 2.0 * std::numbers::pi * i / n, v = 2.0 * std::numbers::pi * j / n;
    return capsule.surface_point({std::cos(u), std::sin(u), std::cos(v), std::sin(v)});
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 x = at(i, j);
      EXPECT_NEAR(capsule.distance(x).distance, 0.0, 1e-12);
      lowest = std::min(lowest, x.z());
      highest = std::max(highest, x.z());
      widest = std::max(widest, x.x());
      longest = std::max({longest, (at(i + 1, j) - x).norm(), (at(i, j + 1) - x).norm()});
    }
  EXPECT_NEAR(lowest, -1.4, 1e-12);
  EXPECT_NEAR(highest, 1.4, 1e-12);
  EXPECT_NEAR(widest, 0.3, 1e-12);
  EXPECT_LT(longest, 0.05) << "the chart tears";
}

std::string refusal(const std::function<void()>& act)
{
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StrutFrame, RefusesWhatIsNoCage)
{
  EXPECT_EQ(refusal([] {
              StrutFrame({{{0, 0, 0}, {1, 0, 0}}, {{0, 2}}});
            }),
            "strut 0 joins node 2, and there are 2 nodes, counted from 0");
  EXPECT_EQ(refusal([] {
              StrutFrame({{{0, 0, 0}, {0, 0, 0}}, {{0, 1}}});
            }),
            "strut 0 has no length: nodes 0 and 1 are at one place");
  EXPECT_EQ(refusal([] {
              StrutFrame({{{0, 0, 0}, {1, 0, 0}}, {{0, 1}, {1, 0}}});
            }),
            "strut 1 joins nodes 1 and 0, as another one does");
  const StrutFrame square(polyhedra()[0].graph());
  EXPECT_EQ(refusal([&] {
              square.primitives(std::vector<double>{2.0, 1.0});
            }),
            "r = 1 is not below half the length of the shortest strut, 2: a cage has windows");
}

class ObjLines : public ::testing::Test {
 protected:
  Graph read(const std::string& text)
  {
    std::ofstream(path_) << text;
    return read_obj_lines(path_.string());
  }
  std::string refused(const std::string& text)
  {
    const std::string message = refusal([&] { read(text); });
    return message.substr(std::min(message.size(), path_.string().size()));
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("strut_frame_" + std::to_string(::getpid()) + ".obj");
};

TEST_F(ObjLines, LinesAndFacesAreStrutsOnce)
{
  const Graph g = read("# a comment\nv 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 -1\nf 1/1 2/1 3/1\nvn 0 0 1\n");
  ASSERT_EQ(g.nodes.size(), 3U);
  EXPECT_EQ(g.nodes[2], Vec3(1, 1, 0));
  const std::vector<std::array<int, 2>> expected{{0, 1}, {1, 2}, {0, 2}};
  EXPECT_EQ(g.struts, expected);
}

TEST_F(ObjLines, WhatIsWrongIsSaidWithItsLine)
{
  EXPECT_EQ(refused("v 0 0\n"), ":1: expected three numbers after 'v'");
  EXPECT_EQ(refused("v 0 0 nan\n"), ":1: expected a finite number, found 'nan'");
  EXPECT_EQ(refused("v 0 0 0\nl 1 2\n"), ":2: the line has point 2, and there are 1");
  EXPECT_EQ(refused("v 0 0 0\nl 1 x\n"),
            ":2: expected the number of a point, counted from 1 or from -1 backwards, found 'x'");
  EXPECT_EQ(refused("v 0 0 0\nl 1\n"), ":2: expected at least two points, found 1");
  EXPECT_EQ(refused("v 0 0 0\n"), ": has no struts; expected lines 'v x y z' and 'l 1 2'");
  EXPECT_EQ(
      refusal([] { read_obj_lines("/nowhere.obj"); }),
      "/nowhere.obj: cannot be read: there is no such file; paths are relative to the experiment's folder");
}

}  // namespace
}  // namespace hauberk
