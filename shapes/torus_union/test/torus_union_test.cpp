#include "../torus_union.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>

namespace hauberk {
namespace {

Node number(double value)
{
  Node node;
  node.type = Node::Type::number;
  node.number = value;
  return node;
}

Node text(const std::string& value)
{
  Node node;
  node.type = Node::Type::string;
  node.string = value;
  return node;
}

Node array(std::vector<Node> items)
{
  Node node;
  node.type = Node::Type::array;
  node.items = std::move(items);
  return node;
}

Node object(std::vector<std::pair<std::string, Node>> members)
{
  Node node;
  node.type = Node::Type::object;
  node.members = std::move(members);
  return node;
}

Node vector(double x, double y, double z) { return array({number(x), number(y), number(z)}); }

Node polar(double direction_deg, std::vector<Node> distance)
{
  return object({{"direction_deg", number(direction_deg)}, {"distance", array(std::move(distance))}});
}

Node torus(const std::string& name, Node position, Node axis)
{
  return object({{"name", text(name)}, {"position", std::move(position)}, {"axis", std::move(axis)}});
}

Node grouped(const std::string& name, const std::string& group, Node position, Node axis)
{
  Node node = torus(name, std::move(position), std::move(axis));
  node.members.emplace_back("group", text(group));
  return node;
}

Node section(std::vector<Node> tori)
{
  Node node = object({{"tori", array(std::move(tori))}});
  // Places as the reader of a file would give them, so that problems can be told apart.
  int line = 1;
  for (std::size_t i = 0; i < node.members[0].second.items.size(); ++i) {
    for (auto& [key, member] : node.members[0].second.items[i].members) {
      member.pointer = "/tori/" + std::to_string(i) + "/" + key;
      member.line = line++;
    }
  }
  return node;
}

std::unique_ptr<Shape> make(const Node& node)
{
  Problems problems;
  auto shape = make_torus_union(node, problems);
  for (const Problem& problem : problems.list()) ADD_FAILURE() << problem.pointer << ": " << problem.message;
  return shape;
}

/// What is wrong with a section that has one thing wrong.
Problem only_problem(const Node& node)
{
  Problems problems;
  EXPECT_EQ(make_torus_union(node, problems), nullptr);
  EXPECT_EQ(problems.list().size(), 1U);
  return problems.empty() ? Problem{} : problems.list().front();
}

/// The paper's threefold element: a centre and three sides that share their radii.
Node threefold()
{
  std::vector<Node> tori = {torus("centre", vector(0, 0, 0), vector(0, 0, 1))};
  const double azimuth[] = {-90.0, 30.0, 150.0};
  for (int k = 0; k < 3; ++k) {
    tori.push_back(grouped("side" + std::to_string(k), "side",
                           polar(azimuth[k], {text("centre.R"), text("side.R"), number(0.25)}),
                           text("tangential")));
  }
  return section(std::move(tori));
}

TEST(TorusUnion, DeclaresThreeLengthsPerGroup)
{
  const auto shape = make(threefold());
  ASSERT_TRUE(shape);
  std::vector<std::string> names;
  for (const ParameterInfo& info : shape->parameters()) {
    names.push_back(info.name);
    EXPECT_EQ(info.unit, "length");
    EXPECT_TRUE(info.smooth);
    EXPECT_LT(0.0, info.lower);
    EXPECT_LT(info.lower, info.upper);
    EXPECT_TRUE(std::isnan(info.default_value)) << "a forgotten radius must be an error";
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"centre.R", "centre.r0", "centre.r1", "side.R", "side.r0", "side.r1"}));
}

TEST(TorusUnion, PlacesTheThreefoldElement)
{
  const auto shape = make(threefold());
  const std::vector<double> p = {4.25, 0.95, 1.50, 2.575, 0.95, 0.95};
  const auto tori = shape->primitives(p);
  ASSERT_EQ(tori.size(), 4U);
  EXPECT_EQ(tori[0].name, "centre");
  EXPECT_EQ(tori[0].kind, PrimitiveKind::revolved_ellipse);
  EXPECT_EQ(tori[0].size, (std::array<double, 3>{4.25, 0.95, 1.50}));
  EXPECT_EQ(tori[1].kind, PrimitiveKind::circle_tube);
  EXPECT_EQ(tori[3].size, (std::array<double, 3>{2.575, 0.95, 0.95}));
  const double distance = 4.25 + 2.575 + 0.25;
  EXPECT_NEAR((tori[1].position - Vec3(0, -distance, 0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((tori[2].position - distance * Vec3(std::sqrt(0.75), 0.5, 0)).norm(), 0.0, 1e-14);
  // Tangential: z x direction, so the side ring's plane holds the radial direction and z.
  EXPECT_NEAR((tori[1].rotation.col(2) - Vec3(1, 0, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((tori[2].rotation.col(2) - Vec3(-0.5, std::sqrt(0.75), 0)).norm(), 0.0, 1e-15);
}

TEST(TorusUnion, AxisIsNormalisedAndReachedByTheShortestRotation)
{
  const auto shape = make(section({torus("a", vector(1, 2, 3), vector(0, 0, 1e-200)),
                                   torus("b", vector(0, 0, 0), vector(0, 0, -7)),
                                   torus("c", vector(0, 0, 0), vector(3, -2, -6))}));
  const std::vector<double> p = {5, 1, 1, 5, 1, 1, 5, 1, 1};
  const auto tori = shape->primitives(p);
  EXPECT_EQ(tori[0].rotation, Mat3(Mat3::Identity()));
  EXPECT_EQ(tori[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(tori[1].rotation, Mat3(Vec3(1, -1, -1).asDiagonal()));
  const Vec3 axis = Vec3(3, -2, -6) / 7.0;
  const Mat3 expected = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
  EXPECT_NEAR((tori[2].rotation - expected).norm(), 0.0, 1e-14);
}

TEST(TorusUnion, JacobianMatchesDifferencesExactly)
{
  // Positions and sizes are affine in p, so a difference over any step is exact up to rounding.
  const auto shape = make(threefold());
  const std::vector<double> p = {4.25, 0.95, 1.50, 2.575, 0.95, 1.40};
  const auto base = shape->primitives(p);
  const auto jacobians = shape->jacobians(p);
  ASSERT_EQ(jacobians.size(), base.size());
  for (std::size_t k = 0; k < p.size(); ++k) {
    std::vector<double> q = p;
    q[k] += 0.125;
    const auto moved = shape->primitives(q);
    for (std::size_t i = 0; i < base.size(); ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        const auto index = static_cast<Eigen::Index>(j);
        const double difference = j < 3 ? moved[i].position[index] - base[i].position[index]
                                        : moved[i].size[j - 3] - base[i].size[j - 3];
        EXPECT_NEAR(jacobians[i][j * p.size() + k], difference / 0.125, 1e-13) << k << i << j;
      }
    }
  }
  EXPECT_NEAR(jacobians[1][1 * p.size() + 0], -1.0, 1e-15);  // dy/d centre.R of the ring at -90 degrees
  EXPECT_NEAR(jacobians[1][1 * p.size() + 3], -1.0, 1e-15);
  EXPECT_EQ(jacobians[0][0], 0.0);
}

TEST(TorusUnion, ParameterNamedTwiceCountsTwice)
{
  const auto shape =
      make(section({torus("a", polar(0, {text("a.R"), text("a.R"), number(-1)}), text("tangential"))}));
  const std::vector<double> p = {5, 1, 1};
  EXPECT_EQ(shape->primitives(p)[0].position, Vec3(9, 0, 0));
  EXPECT_EQ(shape->jacobians(p)[0][0], 2.0);
}

TEST(TorusUnion, ClosedHoleNamesTheParameter)
{
  const auto shape = make(threefold());
  const std::vector<double> p = {4.25, 0.95, 1.50, 2.5, 2.5, 1.4};
  try {
    shape->primitives(p);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "parameter 'side.r0' = 2.5 must be smaller than 'side.R' = 2.5: it closes the hole "
                 "of torus 'side0'");
  }
}

TEST(TorusUnion, OutOfRangeNamesTheParameter)
{
  const auto shape = make(section({torus("ring", vector(0, 0, 0), vector(0, 0, 1))}));
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const std::vector<double> p = {5.0, 1.0, bad};
    try {
      shape->primitives(p);
      FAIL() << bad;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).find("parameter 'ring.r1' = "), 0U) << e.what();
    }
    EXPECT_THROW(shape->jacobians(p), InputError);
  }
  EXPECT_THROW(shape->primitives(std::vector<double>{5.0, 1.0}), PluginError);
}

TEST(TorusUnion, UnknownParameterNamesTheNearest)
{
  const Problem problem = only_problem(
      section({torus("centre", vector(0, 0, 0), vector(0, 0, 1)),
               torus("side", polar(0, {text("center.R"), text("side.R")}), text("tangential"))}));
  EXPECT_EQ(problem.message, "unknown parameter 'center.R'; did you mean 'centre.R'?");
}

TEST(TorusUnion, ReportsEveryProblemAtItsPlace)
{
  Problems problems;
  EXPECT_EQ(make_torus_union(section({torus("a", vector(0, 0, 0), vector(0, 0, 0)),
                                      torus("a", vector(0, 0, 0), text("tangential")),
                                      grouped("b/c", "a", vector(0, 0, 0), vector(0, 0, 1))}),
                             problems),
            nullptr);
  std::vector<std::string> found;
  for (const Problem& p : problems.list()) {
    found.push_back(std::to_string(p.line) + " " + p.pointer + " " + p.message);
  }
  EXPECT_EQ(found,
            (std::vector<std::string>{
                "4 /tori/1/name there are two tori named 'a'; give each its own name",
                "7 /tori/2/name expected a name of letters, digits, '_' and '-', found 'b/c'",
                "10 /tori/2/group 'a' is both a group and a torus without a group; rename one of them",
                "3 /tori/0/axis expected an axis that is not zero, found [0, 0, 0]",
                "6 /tori/1/axis a tangential axis needs a position given by direction_deg and distance"}));
}

TEST(TorusUnion, FieldsDeclareTheContract)
{
  std::vector<Field> fields;
  torus_union_fields(fields);
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_EQ(fields[0].name, "tori");
  EXPECT_TRUE(fields[0].required);
  std::vector<std::string> names;
  for (const Field& field : fields[0].children[0].children) names.push_back(field.name);
  EXPECT_EQ(names, (std::vector<std::string>{"name", "group", "position", "axis"}));
}

}  // namespace
}  // namespace hauberk
