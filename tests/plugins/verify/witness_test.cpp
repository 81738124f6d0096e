/// Witnesses of limits that nothing sets, and the loops that several primitives form together.

#include "witness.hpp"

#include "chain_document.hpp"
#include "links.hpp"
#include "together.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

namespace hauberk::test {
namespace {

using namespace hauberk::verification;
using verification::Primitive;
namespace json = boost::json;

Primitive torus(double R, double r, const Vec3& centre, const Vec3& axis = Vec3::UnitZ())
{
  return {
      "ring", {centre, Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix()}, R, r, r};
}

std::vector<Primitive> square(double side)
{
  std::vector<Primitive> out;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    out.push_back(torus(1.0, 0.1, 0.5 * side * Vec3(x, y, 0.0)));
  return out;
}

TEST(Together, AsManyLoopsAsTheSolidHasBesideItsTori)
{
  const std::vector<Primitive> cage{torus(1.0, 0.1, Vec3::Zero(), Vec3::UnitX()),
                                    torus(1.0, 0.1, Vec3::Zero(), Vec3::UnitY()),
                                    torus(1.0, 0.1, Vec3::Zero())};
  EXPECT_EQ(overlaps(cage[0], cage[1]).size(), 2U);
  EXPECT_EQ(loops_together(cage).size(), 4U);
  EXPECT_EQ(loops_together(square(2.1)).size(), 1U);
  EXPECT_EQ(loops_together(square(2.3)).size(), 0U) << "apart";
  EXPECT_EQ(loops_together(square(1.7)).size(), 5U);
  EXPECT_EQ(overlaps(torus(1.0, 0.1, Vec3::Zero()), torus(1.0, 0.1, {2.2, 0.0, 0.0})).size(), 1U)
      << "touching";
  EXPECT_EQ(overlaps(torus(1.0, 0.1, Vec3::Zero()), torus(1.0, 0.1, Vec3::Zero())).size(), 1U);
}

TEST(Together, ARingThroughTheLoopOfFourToriIsALink)
{
  Scene scene;
  scene.length = 1.0;
  scene.elements.resize(2);
  scene.elements[0].tori = square(2.1);
  scene.elements[0].reach = 3.0;
  scene.elements[1].tori = {torus(1.5, 0.1, Vec3::Zero(), Vec3::UnitX())};
  scene.elements[1].reach = 1.6;
  find_loops(scene);
  const auto found = [&](const Vec3& at) {
    std::vector<Place> places(2);
    places[1].position = at;
    return links(scene, places, Mat3::Identity());
  };
  const std::vector<Link> linked = found({0.0, 1.5, 0.0});
  ASSERT_EQ(linked.size(), 1U);
  EXPECT_EQ(linked[0].primitives[0], 4) << "the loop, not one of the four";
  EXPECT_EQ(std::abs(linked[0].number), 1);
  EXPECT_TRUE(found({0.0, 1.5, 2.0}).empty());
  EXPECT_FALSE(difference(linked, found({0.0, 1.5, 2.0})).empty());
}

json::object at_strain(const json::value& document, double exx, double eyy, double apart)
{
  json::array poses;
  for (const json::value& e : document.at_pointer("/scene/elements").as_array())
    poses.push_back(e.at("rest"));
  json::object& second = poses[1].as_object();
  json::array& x = second.at("position").as_array();
  x[0] = x[0].to_number<double>() * (1.0 + exx);
  x[1] = x[1].to_number<double>() + apart;
  return {{"macro", {{"exx", exx}, {"eyy", eyy}, {"exy", 0.0}}}, {"poses", poses}};
}

/// A chain pulled along `degrees`, said to be unbounded.
json::value unbounded(double degrees, const std::function<json::array(const json::value&)>& witness)
{
  json::value document = chain_document();
  document.at_pointer("/profiles") = json::array();
  json::object& limit = document.at_pointer("/limits/0").as_object();
  limit["status"] = "unbounded";
  limit["direction_deg"] = degrees;
  limit["value"] = limit["macro"] = limit["line_stretch"] = limit["min_gap"] = limit["force_balance"] =
      nullptr;
  limit["poses"] = limit["contacts"] = limit["starts"] = json::array();
  limit["witness"] = witness(document);
  return document;
}

TEST(Witness, RowsThatPart)
{
  const json::value document = unbounded(90.0, [](const json::value& d) {
    return json::array{at_strain(d, 0.0, 0.0, 0.0), at_strain(d, 0.0, 1500.0, 0.0)};
  });
  EXPECT_EQ(limit_line(document),
            "PASS /limits/0 (90 deg, stretch): unbounded: a motion of 1 pieces past every bound, free of "
            "intersection");
}

TEST(Witness, ForgedOnesFail)
{
  const auto line = [](double degrees, std::vector<std::array<double, 3>> states) {
    return limit_line(unbounded(degrees, [&](const json::value& d) {
      json::array out;
      for (const auto& [exx, eyy, apart] : states) out.push_back(at_strain(d, exx, eyy, apart));
      return out;
    }));
  };
  const auto fails = [](const std::string& text, const std::string& why) {
    EXPECT_EQ(text.substr(0, 4), "FAIL") << text;
    EXPECT_NE(text.find(why), std::string::npos) << text;
  };
  fails(line(90.0, {}), "no witness is given");
  fails(line(90.0, {{0.0, 0.0, 0.0}, {0.0, 500.0, 0.0}}), "within 1000");
  fails(line(90.0, {{0.0, 0.1, 0.0}, {0.0, 1500.0, 0.0}}), "does not begin at rest");
  fails(line(0.0, {{0.0, 0.0, 0.0}, {0.0, 1500.0, 0.0}}), "which is not unbounded");
  fails(line(0.0, {{0.0, 0.0, 0.0}, {1500.0, 0.0, 0.0}}), "linking number");
  fails(line(0.0, {{0.0, 0.0, 0.0}, {1500.0, 0.0, 0.0}}), "surfaces intersect");
  fails(line(90.0, {{0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}, {0.0, 1500.0, 0.0}}), "surfaces intersect");
  fails(line(90.0, {{0.0, 0.0, 0.0}, {0.0, 0.0, 11.0}, {0.0, 1500.0, 0.0}}), "linking number");
}

TEST(Witness, LongSlidesAtATinyGapAreNotChecked)
{
  // Ring A spins about its own axis, `gap` from ring B all the while; then the rows part.
  const auto outcomes = [](double gap) {
    Chain near;
    near.gap = gap;
    const double locked = chain_document(near).at_pointer("/limits/0/value").to_number<double>();
    const json::value document = unbounded(90.0, [&](const json::value& d) {
      json::object spun = at_strain(d, locked, 0.0, 0.0);
      spun.at("poses").as_array()[0].as_object()["quaternion"] =
          json::array{std::cos(0.5), 0.0, 0.0, std::sin(0.5)};
      return json::array{at_strain(d, 0.0, 0.0, 0.0), at_strain(d, locked, 0.0, 0.0), spun,
                         at_strain(d, locked, 1500.0, 0.0)};
    });
    std::map<std::string, VerifyOutcome> out;
    for (const VerifyField& f : verify(document).fields) out[f.pointer] = f.outcome;
    return out;
  };
  const std::string status = "/limits/0/status", before = "/limits/0/witness/1/macro/exx",
                    after = "/limits/0/witness/2/macro/exx";
  const auto wide = outcomes(0.5), tiny = outcomes(1e-9), through = outcomes(-1e-3);
  for (const std::string& field : {status, before, after})
    EXPECT_EQ(wide.at(field), VerifyOutcome::passed) << field;
  EXPECT_EQ(tiny.at(before), VerifyOutcome::passed);
  EXPECT_EQ(tiny.at(after), VerifyOutcome::not_checked);
  EXPECT_EQ(tiny.at(status), VerifyOutcome::not_checked);
  EXPECT_EQ(through.at(status), VerifyOutcome::failed);
}

TEST(Witness, MotionsThroughEachOtherAreSeenBetweenStates)
{
  // Ring B hops from one link to the next of a ladder: both ends are links of the same kind.
  Scene scene;
  scene.length = 1.0;
  scene.elements.resize(2);
  scene.elements[0].tori = {torus(1.0, 0.1, Vec3::Zero())};
  scene.elements[1].tori = {torus(1.0, 0.1, Vec3::Zero(), Vec3::UnitY())};
  for (Element& e : scene.elements) e.reach = 1.1;
  scene.cell = {Vec3(100.0, 0.0, 0.0), Vec3(0.0, 100.0, 0.0)};
  const auto at = [&](double x) {
    MovedState s;
    s.places.resize(2);
    s.places[1].position = Vec3(x, 0.0, 0.0);
    return s;
  };
  EXPECT_EQ(motion(scene, at(0.9), at(1.1)), Motion::free);
  EXPECT_EQ(motion(scene, at(0.9), at(-0.9)), Motion::meets) << "through the tube on the other side";
  EXPECT_EQ(motion(scene, at(2.5), at(1e4)), Motion::meets) << "into the next image";
  EXPECT_EQ(motion(scene, at(2.5), at(50.0)), Motion::free);
}

}  // namespace
}  // namespace hauberk::test
