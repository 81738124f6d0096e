/// Unions of shapes: names, places and derivatives of what their parts give.

#include "differences.hpp"
#include "tasks/table.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/experiment.hpp>
#include <hauberk/experiment/union_shape.hpp>
#include <hauberk/host/registry.hpp>
#include <hauberk/solid.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>

namespace hauberk::test {
namespace {

/// A ring of radius a^2 with its centre at (a cos b, sin b, a b), turned by exp(b skew(1, 2, -1)).
class Curved final : public Shape {
 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    if (p[0] < 0.5) throw InputError("parameter 'a' is small");
    Primitive ring;
    ring.name = "ring";
    ring.position = Vec3(p[0] * std::cos(p[1]), std::sin(p[1]), p[0] * p[1]);
    ring.rotation = rotation_exp(p[1] * axis);
    ring.size = {p[0] * p[0], 0.1, 0.1};
    out = {ring};
  }
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override
  {
    out = {{std::cos(p[1]), -p[0] * std::sin(p[1]), 0.0, std::cos(p[1]), p[1], p[0],  //
            2.0 * p[0], 0.0, 0.0, 0.0, 0.0, 0.0,                                      //
            0.0, axis[0], 0.0, axis[1], 0.0, axis[2]}};
  }

 private:
  const Vec3 axis{1.0, 2.0, -1.0};
  std::vector<ParameterInfo> parameters_{{"a", "length", 1.3, 0.0, 9.0, "", true},
                                         {"b", "1", 0.4, -9.0, 9.0, "", false}};
};

/// Two rings without parameters.
class Fixed final : public Shape {
 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return none_; }
  void do_primitives(std::span<const double>, std::vector<Primitive>& out) const override
  {
    out.resize(2);
    out[0].name = "near";
    out[1].name = "far";
    out[1].position = Vec3(1, 2, 3);
    for (Primitive& ring : out) ring.size = {1.0, 0.1, 0.1};
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    out.resize(2);
  }

 private:
  std::vector<ParameterInfo> none_;
};

Mat3 turn(double angle, const Vec3& axis)
{
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// Shapes of this tree of every kind of tube, turned and moved.
std::shared_ptr<const Shape> of_plugins()
{
  static const Registry registry({HAUBERK_BINARY_DIR "/lib/hauberk/plugins"});
  const PluginLookup lookup = [](PluginKind kind, const std::string& id, std::string&) {
    return &registry.find(kind, id);
  };
  const char* text = R"({ "name": "u", "elements": { "link": { "shape": "union", "parts": [
    { "name": "rings", "shape": "torus_union", "rotation": { "axis": [1, 2, 3], "degrees": 40 }, "position": [1, 2, 3],
      "tori": [ { "name": "one" }, { "name": "two", "axis": "tangential",
                  "position": { "direction_deg": 20, "distance": ["one.R", "two.R"] } } ] },
    { "name": "frame", "shape": "strut_frame", "polyhedron": "tetrahedron",
      "rotation": { "quaternion": [1, 2, -1, 3] } },
    { "name": "tube", "shape": "closed_tube", "curve": "knot", "rotation": { "axis": [0, 1, 0], "degrees": 70 } } ],
    "parameters": { "rings.one.R": 3, "rings.one.r0": 0.4, "rings.one.r1": 0.5,
                    "rings.two.R": 2, "rings.two.r0": 0.3, "rings.two.r1": 0.3,
                    "frame.size": 4, "frame.r": 0.3, "frame.z": -2.5,
                    "tube.R": 5, "tube.a": 2, "tube.b": 1, "tube.r": 0.2 } } },
    "cell": { "vectors": [[90, 0], [0, 90]], "place": [ { "element": "link", "position": [0, 0, 0] } ] },
    "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0] } })";
  Diagnostics diagnostics;
  const auto experiment = read_experiment({"u.json", text, {}, {}, {}, task_formats()}, lookup, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  return experiment ? experiment->scene.types[0].shape : nullptr;
}

/// All geometric quantities of a primitive, and the nine entries of its rotation.
std::vector<double> geometry(const Primitive& p)
{
  std::vector<double> out{p.position[0], p.position[1], p.position[2]};
  out.insert(out.end(), p.size.begin(), p.size.end());
  for (const Harmonic& h : p.curve)
    for (const Vec3& v : {h.c, h.s}) out.insert(out.end(), v.data(), v.data() + 3);
  if (p.solid)
    for (const double size : p.solid->sizes()) out.push_back(size);
  out.insert(out.end(), p.rotation.data(), p.rotation.data() + p.rotation.size());
  return out;
}

/// What a Jacobian says of how they change with parameter k of n: dQ = skew(omega) Q.
std::vector<double> claimed_changes(const Primitive& p, const PrimitiveJacobian& J, std::size_t k,
                                    std::size_t n)
{
  const std::size_t rows = geometric_dofs(p);
  std::vector<double> out;
  for (std::size_t row = 0; row < rows; ++row) out.push_back(J.at(row * n + k));
  const Vec3 omega(J.at(rows * n + k), J.at((rows + 1) * n + k), J.at((rows + 2) * n + k));
  const Mat3 change = skew(omega) * p.rotation;
  out.insert(out.end(), change.data(), change.data() + change.size());
  return out;
}

/// True of rows that the kernel sets itself.
bool unused(const Primitive& p, std::size_t row)
{
  return (p.kind == PrimitiveKind::curve_tube && row == quantity_R) ||
         (p.solid && row >= quantity_R && row <= quantity_r1);
}

/// Of all primitives, one after another.
std::vector<double> geometry_at(const Shape& shape, std::vector<double> p, std::size_t k, double by)
{
  p[k] += by;
  std::vector<double> out;
  for (const Primitive& primitive : shape.primitives(p)) {
    const std::vector<double> own = geometry(primitive);
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

/// Differences over falling steps approach every entry of every Jacobian.
void expect_derivatives(const Shape& shape, const std::vector<double>& at)
{
  const std::vector<PrimitiveJacobian> claimed = shape.jacobians(at);
  const std::vector<Primitive> here = shape.primitives(at);
  for (std::size_t k = 0; k < at.size(); ++k) {
    std::array<std::vector<double>, 3> slopes;
    for (std::size_t s = 0; s < slopes.size(); ++s) {
      const double h = 0.02 * std::ldexp(1.0, -static_cast<int>(s));
      slopes[s] = geometry_at(shape, at, k, h);
      const std::vector<double> low = geometry_at(shape, at, k, -h);
      for (std::size_t i = 0; i < low.size(); ++i) slopes[s][i] = (slopes[s][i] - low[i]) / (2.0 * h);
    }
    std::size_t entry = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      ASSERT_EQ(claimed[i].size(), (geometric_dofs(here[i]) + rotation_dofs) * at.size());
      const std::vector<double> changes = claimed_changes(here[i], claimed[i], k, at.size());
      for (std::size_t row = 0; row < changes.size(); ++row, ++entry) {
        if (unused(here[i], row)) continue;
        std::array<double, 3> error{};
        for (std::size_t s = 0; s < error.size(); ++s) error[s] = std::abs(slopes[s][entry] - changes[row]);
        expect_second_order(error, 1.0, 1e-10, (here[i].name + " " + shape.parameters()[k].name).c_str());
      }
    }
  }
}

std::vector<double> defaults(const Shape& shape)
{
  std::vector<double> p;
  for (const ParameterInfo& info : shape.parameters()) p.push_back(info.default_value);
  return p;
}

UnionShape curved_and_fixed()
{
  return UnionShape({{"c", std::make_shared<Curved>(), turn(0.7, {1, -2, 0.5}), {1, 2, 3}},
                     {"f", std::make_shared<Fixed>(), turn(std::acos(0.0), {0, 0, 1}), {10, 0, 0}}});
}

TEST(UnionShape, NamesArePrefixedAndPlacesAreParameters)
{
  const UnionShape shape = curved_and_fixed();
  std::vector<std::string> names;
  for (const ParameterInfo& info : shape.parameters()) names.push_back(info.name);
  EXPECT_EQ(names, (std::vector<std::string>{"c.a", "c.b", "c.x", "c.y", "c.z", "c.rx", "c.ry", "c.rz", "f.x",
                                             "f.y", "f.z", "f.rx", "f.ry", "f.rz"}));
  EXPECT_EQ(defaults(shape), (std::vector<double>{1.3, 0.4, 1, 2, 3, 0, 0, 0, 10, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(shape.parameters()[1].smooth);
  EXPECT_EQ(shape.parameters()[1].unit, "1");
  EXPECT_EQ(shape.parameters()[2].unit, "length");
  EXPECT_LT(shape.parameters()[2].lower, -1e6);
  EXPECT_GT(shape.parameters()[2].upper, 1e6);
  EXPECT_EQ(shape.parameters()[5].unit, "degree");
  EXPECT_EQ(shape.parameters()[5].lower, -180.0);
  EXPECT_EQ(shape.parameters()[5].upper, 180.0);
}

TEST(UnionShape, PartsAreTurnedThenMoved)
{
  const UnionShape shape = curved_and_fixed();
  const std::vector<Primitive> found = shape.primitives(defaults(shape));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].name, "c.ring");
  EXPECT_EQ(found[1].name, "f.near");
  EXPECT_EQ(found[2].name, "f.far");
  // (1, 2, 3) by a quarter about z is (-2, 1, 3).
  EXPECT_LT((found[1].position - Vec3(10, 0, 0)).norm(), 1e-15);
  EXPECT_LT((found[2].position - Vec3(8, 1, 3)).norm(), 1e-15);
  EXPECT_LT((found[2].rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  // Distances from the part's origin, and the angle of the ring's axis to the turn's, are kept.
  EXPECT_NEAR((found[0].position - Vec3(1, 2, 3)).norm(),
              Vec3(1.3 * std::cos(0.4), std::sin(0.4), 0.52).norm(), 1e-15);
  const Vec3 axis = Vec3(1, -2, 0.5).normalized();
  EXPECT_NEAR(found[0].rotation.col(2).dot(axis), (rotation_exp({0.4, 0.8, -0.4}).col(2)).dot(axis), 1e-15);
}

TEST(UnionShape, RotationVectorsTurnPartsInTheElementFrame)
{
  const UnionShape shape = curved_and_fixed();
  std::vector<double> p = defaults(shape);
  const std::vector<Primitive> before = shape.primitives(p);
  p[8 + 3] = 90.0;  // f.rx
  const std::vector<Primitive> after = shape.primitives(p);
  // (1, 2, 3) by a quarter about z is (-2, 1, 3), and that by one about x is (-2, -3, 1).
  EXPECT_LT((after[2].position - Vec3(8, -3, 1)).norm(), 1e-14);
  EXPECT_LT((after[2].rotation * Vec3::UnitX() - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_EQ(after[0].position, before[0].position);
  EXPECT_EQ(after[0].rotation, before[0].rotation);
  p[8 + 3] = 180.5;
  EXPECT_THROW(shape.primitives(p), InputError);
}

TEST(UnionShape, DerivativesAreThoseOfItsPrimitives)
{
  const UnionShape shape = curved_and_fixed();
  std::vector<double> p = defaults(shape);
  expect_derivatives(shape, p);
  for (const double turn : {40.0, 170.0}) {
    p[5] = p[12] = turn;
    p[6] = -0.5 * turn;
    p[13] = turn - 60.0;
    expect_derivatives(shape, p);
  }
}

TEST(UnionShape, DerivativesOfEveryKindOfTube)
{
  const std::shared_ptr<const Shape> shape = of_plugins();
  ASSERT_TRUE(shape);
  std::vector<double> p = defaults(*shape);
  const std::map<std::string, double> given{{"rings.one.R", 3}, {"rings.one.r0", 0.4}, {"rings.one.r1", 0.5},
                                            {"rings.two.R", 2}, {"rings.two.r0", 0.3}, {"rings.two.r1", 0.3},
                                            {"frame.size", 4},  {"frame.r", 0.3},      {"tube.R", 5},
                                            {"tube.a", 2},      {"tube.b", 1},         {"tube.r", 0.2},
                                            {"rings.rx", 25},   {"frame.rz", -70},     {"tube.ry", 110}};
  for (std::size_t k = 0; k < p.size(); ++k)
    if (const auto value = given.find(shape->parameters()[k].name); value != given.end())
      p[k] = value->second;
  EXPECT_EQ(shape->primitives(p).size(), 9U);  // two tori, six struts, one tube
  expect_derivatives(*shape, p);
}

TEST(UnionShape, WhatAPartThrowsNamesIt)
{
  const UnionShape shape = curved_and_fixed();
  std::vector<double> p = defaults(shape);
  p[0] = 0.1;
  try {
    shape.primitives(p);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "part 'c': parameter 'a' is small");
  }
}

}  // namespace
}  // namespace hauberk::test
