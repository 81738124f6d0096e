/// Limits that hold components of the macroscopic unknowns, or the places of elements.

#include "chain_document.hpp"

#include <hauberk/verify/verify.hpp>

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <numbers>

namespace hauberk {
namespace {

namespace json = boost::json;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test::chain_document;
using test::limit_line;

constexpr double R = 5.0, r = 0.7, gap = 1e-11, load_deg = 20.0;
/// Centre to centre of two rings of a taut chain.
constexpr double taut = 2.0 * (R - r) - gap;

/// A chain along x, pulled along `load_deg` with shear and lateral strain held, or set to small values. By
/// |F e| = 2 taut / period with F = I + a n n^T + h (n m^T + m n^T) + b m m^T.
struct HeldChain {
  Vector2d n{std::cos(load_deg * std::numbers::pi / 180.0), std::sin(load_deg* std::numbers::pi / 180.0)};
  Vector2d m{-n.y(), n.x()};

  Vector2d direction(double a, double h, double b) const
  {
    const double c = n.x(), s = n.y();
    return Vector2d::UnitX() + (a * c - h * s) * n + (h * c - b * s) * m;
  }
  /// The largest a, by bisection: the length grows with it.
  double value(double h, double b) const
  {
    double low = 0.0, high = 5.0;
    for (int k = 0; k < 200; ++k) {
      const double middle = 0.5 * (low + high);
      (direction(middle, h, b).norm() < 2.0 * taut / test::rest_period ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
};

json::array vector(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

/// Turned about the z axis.
json::array turned(const json::value& v, double angle)
{
  const Vector3d x(v.at(0).to_number<double>(), v.at(1).to_number<double>(), v.at(2).to_number<double>());
  return vector(Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * x);
}

json::value held_document()
{
  const HeldChain chain;
  const double a = chain.value(0.0, 0.0), c = chain.n.x(), s = chain.n.y();
  const Vector2d d = chain.direction(a, 0.0, 0.0).normalized();
  const double angle = std::atan2(d.y(), d.x());
  // t - f period (d_x, 0, d_y) = r_1 d(shear) + r_2 d(lateral) over (exx, eyy, exy).
  Eigen::Matrix3d system;
  system.col(0) = test::rest_period * Vector3d(d.x(), 0.0, d.y());
  system.col(1) = Vector3d(-c * s, c * s, c * c - s * s);
  system.col(2) = Vector3d(s * s, c * c, -2.0 * c * s);
  const Vector3d solved = system.fullPivLu().solve(Vector3d(c * c, s * s, 2.0 * c * s));

  json::value document = chain_document();
  json::object& limit = document.at_pointer("/limits/0").as_object();
  const json::object macro{{"exx", a * c * c}, {"eyy", a * s * s}, {"exy", a * c * s}};
  limit["direction_deg"] = load_deg;
  limit["value"] = a;
  limit["line_stretch"] = a;
  limit["macro"] = macro;
  limit["hold"] = {"shear", "lateral"};
  limit["reactions"] = {{{"name", "shear"}, {"value", solved[1]}},
                        {{"name", "lateral"}, {"value", solved[2]}}};
  limit["starts"].as_array()[0] = {{"value", a}, {"macro", macro}, {"z_range", 0}, {"seed", 1}, {"count", 1}};
  limit["sensitivity"].at("clearance") = -2.0 * solved[0];
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
  for (json::value& pose : limit["poses"].as_array()) {
    const json::value q = pose.at("quaternion");
    const Eigen::Quaterniond now =
        turn * Eigen::Quaterniond(q.at(0).to_number<double>(), q.at(1).to_number<double>(),
                                  q.at(2).to_number<double>(), q.at(3).to_number<double>());
    pose.at("quaternion") = {now.w(), now.x(), now.y(), now.z()};
    pose.at("position") = turned(pose.at("position"), angle);
  }
  for (json::value& contact : limit["contacts"].as_array()) {
    contact.at("normal") = turned(contact.at("normal"), angle);
    for (json::value& point : contact.at("points").as_array()) point = turned(point, angle);
    contact.at("force") = solved[0];
  }
  document.at_pointer("/profiles/0/direction_deg") = load_deg;
  document.at_pointer("/profiles/0/e_s") = a;
  document.at_pointer("/experiment/load_case/directions_deg") = json::array{load_deg};
  document.at_pointer("/experiment/load_case").as_object()["hold"] = {"shear", "lateral"};
  return document;
}

TEST(Held, ReactionsOfATrueStatePass)
{
  const VerifyReport report = verify(held_document());
  EXPECT_TRUE(report.ok) << report.text();
}

TEST(Held, ReactionsAreWhatTheValueGainsByTheHeldComponent)
{
  const HeldChain chain;
  const json::value document = held_document();
  constexpr double h = 1e-5;
  const double shear = (chain.value(h, 0.0) - chain.value(-h, 0.0)) / (2.0 * h),
               lateral = (chain.value(0.0, h) - chain.value(0.0, -h)) / (2.0 * h);
  EXPECT_NEAR(document.at_pointer("/limits/0/reactions/0/value").as_double(), shear, 1e-8);
  EXPECT_NEAR(document.at_pointer("/limits/0/reactions/1/value").as_double(), lateral, 1e-8);
  EXPECT_GT(std::abs(shear), 0.1);
  EXPECT_GT(std::abs(lateral), 0.05);
}

TEST(Held, WhatIsChangedIsCaught)
{
  const auto line = [](const char* pointer, const json::value& v) {
    json::value document = held_document();
    document.at_pointer(pointer) = v;
    return limit_line(document);
  };
  const json::value whole = held_document();
  const double shear = whole.at_pointer("/limits/0/reactions/0/value").as_double();
  EXPECT_NE(line("/limits/0/reactions/0/value", shear * 1.001).find("reaction of shear"), std::string::npos);
  EXPECT_NE(line("/limits/0/reactions/0/name", "lateral").find("reactions of [shear, lateral] expected"),
            std::string::npos);
  EXPECT_NE(line("/limits/0/hold", json::array{"shear"}).find("forces miss the load by"), std::string::npos);
  EXPECT_NE(line("/limits/0/hold", json::array()).find("forces miss the load by"), std::string::npos);
  const double eyy = whole.at_pointer("/limits/0/macro/eyy").as_double();
  EXPECT_NE(line("/limits/0/macro/eyy", eyy + 1e-6).find("shear is held, and is"), std::string::npos);
  json::value document = held_document();
  document.at_pointer("/experiment/load_case/hold") = json::array{"shear"};
  EXPECT_NE(verify(document).text().find("hold [shear] expected, found [shear, lateral]"), std::string::npos);
}

TEST(Held, NamesOfOthersAreNotChecked)
{
  json::value document = held_document();
  document.at_pointer("/limits/0/hold") = {"shear", "area"};
  document.at_pointer("/experiment/load_case/hold") = {"shear", "area"};
  const VerifyReport report = verify(document);
  EXPECT_TRUE(report.ok) << report.text();
  EXPECT_EQ(limit_line(document),
            "NONE /limits/0 (20 deg, stretch): hold \"area\" is not known to this check");
}

json::object place(const Vector3d& x, const Eigen::Quaterniond& q)
{
  return {{"position", vector(x)}, {"quaternion", {q.w(), q.x(), q.y(), q.z()}}};
}

/// Three rings in a row at x = -p, 0, p, each at right angles to the next, bent with their places held until
/// they are taut: p^2 + (A p^2)^2 = taut^2. The load 2 A is balanced by two forces f along the lines of
/// centres, which rise by the angle phi: 2 = 2 f p^2 sin phi / L.
json::value places_document()
{
  constexpr double p = 8.0;
  const double rise = std::sqrt(taut * taut - p * p), A = rise / (p * p), phi = std::atan2(rise, p);
  const double f = R / (p * p * std::sin(phi));
  const Eigen::Quaterniond upright(Eigen::AngleAxisd(std::numbers::pi / 2.0, Vector3d::UnitX()));
  const json::object element{
      {"type", "a"},
      {"parameters", {{"ring.R", R}}},
      {"primitives", json::array{json::object{{"name", "ring"},
                                              {"kind", "circle_tube"},
                                              {"parameters", {{"R", R}, {"r0", r}, {"r1", r}}},
                                              {"position", {0, 0, 0}},
                                              {"quaternion", {1, 0, 0, 0}}}}}};
  json::array elements, poses, places, contacts;
  for (int k = -1; k <= 1; ++k) {
    const Vector3d X(k * p, 0.0, 0.0);
    const json::object rest = place(X, k == 0 ? upright : Eigen::Quaterniond::Identity());
    json::object placed = element;
    placed["rest"] = rest;
    elements.push_back(placed);
    places.push_back(test::placed_element("a", rest));
    poses.push_back(
        place(X + k * k * rise * Vector3d::UnitZ(),
              k == 0 ? upright : Eigen::Quaterniond(Eigen::AngleAxisd(-k * phi, Vector3d::UnitY()))));
    if (k == 0) continue;
    const Vector3d d(k * std::cos(phi), 0.0, std::sin(phi));
    contacts.push_back(json::object{{"elements", {1, k + 1}},
                                    {"primitives", {0, 0}},
                                    {"image", {0, 0}},
                                    {"points", {vector((R - r) * d), vector((R - r - gap) * d)}},
                                    {"normal", vector(-d)},
                                    {"gap", gap},
                                    {"force", f}});
  }
  const json::object macro{{"A", A}, {"B", 0.0}, {"C", 0.0}};
  const json::object limit{
      {"load_case", "paraboloid_bending"},
      {"direction_deg", 0},
      {"sense", "up"},
      {"measure", "normal_curvature"},
      {"value", 2.0 * A},
      {"macro", macro},
      {"status", "locked"},
      {"min_gap", gap},
      {"links_kept", true},
      {"z_range", rise},
      {"contact", "nearest"},
      {"hold", {"places"}},
      {"reactions", json::array()},
      {"starts", json::array{json::object{{"value", 2.0 * A}, {"macro", macro}}}},
      {"sensitivity", {{"clearance", -2.0 * f / R}, {"parameters", {{"1/ring.R", 2.0 * f / R}}}}},
      {"poses", poses},
      {"contacts", contacts},
      {"force_balance", 0.0}};
  return {{"format", "hauberk-results/2"},
          {"experiment",
           {{"elements", {{"a", test::torus_element(R, r, r)}}},
            {"cell",
             {{"patch", {{"vectors", {{1, 0}, {0, 1}}}, {"outline", {{"rectangle", {1, 1}}}}}},
              {"place", places}}},
            {"solver", {{"clearance", 0}}},
            {"load_case",
             {{"plugin", "paraboloid_bending"},
              {"directions_deg", json::array{0}},
              {"senses", json::array{"up"}},
              {"hold", {"places"}}}}}},
          {"scene", {{"cell_vectors", json::array()}, {"length", R}, {"elements", elements}}},
          {"limits", json::array{limit}},
          {"profiles", json::array{json::object{
                           {"direction_deg", 0}, {"e_s", 2.0 * A}, {"e_c", nullptr}, {"eta", nullptr}}}},
          {"design", nullptr}};
}

TEST(Held, PlacesOfAPatchPass)
{
  const VerifyReport report = verify(places_document());
  EXPECT_TRUE(report.ok) << report.text();
  EXPECT_NE(report.text().find("2 links kept"), std::string::npos) << report.text();
}

TEST(Held, PlacesThatAreLeftAreCaught)
{
  json::value document = places_document();
  document.at_pointer("/limits/0/poses/1/position/1") = 1e-3;
  EXPECT_NE(limit_line(document).find("element 1 is 0.001 from its place"), std::string::npos)
      << limit_line(document);
  // A force along the surface is no equilibrium where elements may move, and one where their places are held.
  document = places_document();
  document.at_pointer("/limits/0/hold") = json::array();
  document.at_pointer("/experiment/load_case/hold") = json::array();
  EXPECT_NE(limit_line(document).find("forces miss the load by"), std::string::npos) << limit_line(document);
}

}  // namespace
}  // namespace hauberk
