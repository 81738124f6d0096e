/// Families of curves against their formulas, Jacobians against differences, and what is refused.

#include "../closed_tube.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace hauberk::test {
namespace {

Node number(double value)
{
  Node n;
  n.type = Node::Type::number;
  n.number = value;
  return n;
}

/// The section of an experiment as it is handed to the plugin.
Node section(const std::string& curve, const char* field = nullptr, std::vector<double> values = {})
{
  Node node;
  node.type = Node::Type::object;
  Node name;
  name.type = Node::Type::string;
  name.string = curve;
  node.members.emplace_back("curve", name);
  if (field == nullptr) return node;
  Node value = number(values.front());
  if (values.size() > 1) {
    value = Node();
    value.type = Node::Type::array;
    for (const double x : values) value.items.push_back(number(x));
  }
  value.pointer = std::string("/elements/link/") + field;
  node.members.emplace_back(field, value);
  return node;
}

std::unique_ptr<Shape> made(const Node& node)
{
  Problems problems;
  std::unique_ptr<Shape> shape = make_closed_tube(node, problems);
  EXPECT_TRUE(problems.empty());
  return shape;
}

Vec3 point(const Primitive& tube, double u)
{
  Vec3 x = Vec3::Zero();
  for (std::size_t k = 0; k < tube.curve.size(); ++k) {
    const double ku = static_cast<double>(k + 1) * u;
    x += std::cos(ku) * tube.curve[k].c + std::sin(ku) * tube.curve[k].s;
  }
  return x;
}

void expect_curve(const Shape& shape, const std::vector<double>& p,
                  const std::function<Vec3(double)>& formula)
{
  const std::vector<Primitive> tubes = shape.primitives(p);
  ASSERT_EQ(tubes.size(), 1U);
  EXPECT_EQ(tubes[0].kind, PrimitiveKind::curve_tube);
  EXPECT_EQ(tubes[0].r0(), p.back());
  for (int i = 0; i < 50; ++i) EXPECT_LT((point(tubes[0], 0.13 * i) - formula(0.13 * i)).norm(), 1e-14) << i;
}

TEST(ClosedTube, FamiliesAreTheirFormulas)
{
  using std::cos, std::sin;
  expect_curve(*made(section("oval")), {3.0, 2.0, 0.3},
               [](double u) { return Vec3(3.0 * cos(u), 2.0 * sin(u), 0.0); });
  expect_curve(*made(section("racetrack")), {3.0, 2.0, 0.3},
               [](double u) { return Vec3(3.0 * cos(u), 2.0 * (9.0 * sin(u) + sin(3.0 * u)) / 8.0, 0.0); });
  expect_curve(*made(section("polygon", "corners", {4.0})), {3.0, 0.3, 0.2}, [](double u) {
    return Vec3(3.0 * cos(u) + 0.3 * cos(3.0 * u), 3.0 * sin(u) - 0.3 * sin(3.0 * u), 0.0);
  });
  for (const auto& [p, q] : {std::pair{2.0, 3.0}, std::pair{3.0, 2.0}, std::pair{1.0, 4.0}}) {
    expect_curve(*made(section("knot", "turns", {p, q})), {3.0, 1.0, 0.8, 0.1}, [p = p, q = q](double u) {
      const double rho = 3.0 + cos(q * u);
      return Vec3(rho * cos(p * u), rho * sin(p * u), 0.8 * sin(q * u));
    });
  }
  const auto free = made(section("fourier", "harmonics", {2.0}));
  ASSERT_EQ(free->parameters().size(), 13U);
  EXPECT_EQ(free->parameters()[4].name, "s1.y");
  std::vector<double> p(13, 0.0);
  p[0] = 2.0;   // c1.x
  p[4] = 1.5;   // s1.y
  p[11] = 0.2;  // s2.z
  p[12] = 0.1;  // r
  expect_curve(*free, p, [](double u) { return Vec3(2.0 * cos(u), 1.5 * sin(u), 0.2 * sin(2.0 * u)); });
}

TEST(ClosedTube, TheRacetracksSidesAreStraightAndItsEndsAsBluntAsStated)
{
  const Primitive tube = made(section("racetrack"))->primitives(std::vector<double>{3.0, 2.0, 0.3})[0];
  const double h = 1e-3, quarter = 0.5 * std::numbers::pi;
  const auto second = [&](double u) -> Vec3 {
    return (point(tube, u + h) - 2.0 * point(tube, u) + point(tube, u - h)) / (h * h);
  };
  EXPECT_NEAR(second(quarter).y(), 0.0, 1e-5);
  const double speed = (point(tube, h) - point(tube, -h)).norm() / (2.0 * h);
  EXPECT_NEAR(speed * speed / std::abs(second(0.0).x()), 9.0 * 2.0 * 2.0 / (4.0 * 3.0), 1e-4);
}

TEST(ClosedTube, JacobiansAreConstantAndThoseOfTheCurve)
{
  for (const char* family : {"oval", "racetrack", "polygon", "knot"}) {
    const auto shape = made(section(family));
    std::vector<double> p{3.0, 1.5, 0.2};
    if (std::string(family) == "polygon") p[1] = 0.3;
    if (std::string(family) == "knot") p = {3.0, 1.0, 0.8, 0.1};
    const std::size_t n = p.size();
    const PrimitiveJacobian jacobian = shape->jacobians(p)[0];
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> q = p;
      q[k] += 0.0625;
      const Primitive from = shape->primitives(p)[0], to = shape->primitives(q)[0];
      for (std::size_t i = 1; i < 3; ++i)
        EXPECT_NEAR(jacobian[(3 + i) * n + k], (to.size[i] - from.size[i]) / 0.0625, 1e-13);
      for (std::size_t row = 6; row < 6 + 6 * from.curve.size(); ++row) {
        const auto value = [&](const Primitive& tube) {
          const Harmonic& h = tube.curve[(row - 6) / 6];
          return ((row - 6) % 6 < 3 ? h.c : h.s)[static_cast<Eigen::Index>((row - 6) % 3)];
        };
        EXPECT_NEAR(jacobian[row * n + k], (value(to) - value(from)) / 0.0625, 1e-13) << family << row << k;
      }
    }
  }
}

std::string refusal(const Shape& shape, const std::vector<double>& p)
{
  try {
    shape.primitives(p);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(ClosedTube, TubesThatDoNotFitTheirCurveAreRefused)
{
  const auto oval = made(section("oval"));
  EXPECT_EQ(refusal(*oval, {2.0, 1.0, 0.49}), "");
  EXPECT_EQ(refusal(*oval, {2.0, 1.0, 0.51}),
            "parameter 'r' = 0.51 is too thick: the curve bends with a radius of 0.5");
  // A trefoil's strands pass each other at about 2 sqrt(a^2 + b^2 ...) apart, long before it bends too much.
  const auto knot = made(section("knot"));
  EXPECT_EQ(refusal(*knot, {3.0, 1.0, 1.0, 0.6}), "");
  EXPECT_NE(refusal(*knot, {3.0, 1.0, 1.0, 1.0}).find("comes back to itself"), std::string::npos);
  // A line there and back, and a point.
  const auto free = made(section("fourier", "harmonics", {1.0}));
  EXPECT_EQ(refusal(*free, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.7}),
            "parameter 'r' = 0.7 is too thick: the curve bends with a radius of 0");
  EXPECT_EQ(refusal(*free, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.7}),
            "parameter 'r' = 0.7 is too thick: the curve bends with a radius of 0");
  EXPECT_NE(refusal(*oval, {-1.0, 1.0, 0.1}).find("half_length"), std::string::npos);
}

TEST(ClosedTube, FieldsOfOtherFamiliesAndBadTurnsAreRefused)
{
  const auto problem = [](const Node& node) {
    Problems problems;
    EXPECT_EQ(make_closed_tube(node, problems), nullptr);
    return problems.list().empty() ? "" : problems.list()[0].message;
  };
  EXPECT_EQ(problem(section("oval", "corners", {4.0})),
            "belongs to curve 'polygon'; remove it or choose that curve");
  for (const auto& turns : {std::vector{2.0, 4.0}, std::vector{1.0, 1.0}, std::vector{2.5, 3.0}})
    EXPECT_NE(problem(section("knot", "turns", turns)).find("without common divisor"), std::string::npos);
}

}  // namespace
}  // namespace hauberk::test
