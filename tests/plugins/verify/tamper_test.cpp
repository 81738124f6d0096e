#include "chain_document.hpp"

#include <hauberk/verify/verify.hpp>

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>

namespace hauberk {
namespace {

namespace json = boost::json;
using test::Chain;
using test::chain_document;
using test::limit_line;

/// Adds to a number of the document.
void add(json::value& document, const std::string& pointer, double change)
{
  json::value& v = document.at_pointer(pointer);
  v = v.to_number<double>() + change;
}

void expect_caught(const json::value& document, const std::string& message)
{
  const VerifyReport report = verify(document);
  EXPECT_FALSE(report.ok);
  EXPECT_NE(report.text().find(message), std::string::npos) << "missing: " << message << '\n'
                                                            << report.text();
}

TEST(Tamper, PoseShiftedByAThousandth)
{
  for (const char* element : {"0", "1"})
    for (const char* axis : {"0", "1", "2"}) {
      json::value document = chain_document();
      add(document, std::string("/limits/0/poses/") + element + "/position/" + axis, 1e-3);
      expect_caught(document, "the mean translation moved by 0.0005");
      // Hidden from the mean by moving both: still caught by the contacts.
      add(document, std::string("/limits/0/poses/") + (*element == '0' ? "1" : "0") + "/position/" + axis,
          -1e-3);
      expect_caught(document, "contact 0: ");
    }
}

TEST(Tamper, PoseShiftedAlongTheChain)
{
  json::value document = chain_document();
  add(document, "/limits/0/poses/1/position/0", 1e-3);
  expect_caught(document, "surfaces are 0.001 closer than the clearance");
  expect_caught(document, "min_gap 1e-11 reported, -0.001 found");
}

TEST(Tamper, PoseTurned)
{
  json::value document = chain_document();
  const double half = 0.5e-3;
  document.at_pointer("/limits/0/poses/0/quaternion") = {std::cos(half), 0.0, std::sin(half), 0.0};
  expect_caught(document, "contact 0: the normal is 0.00714 off that of surface 0");
}

TEST(Tamper, ForceChangedByOnePercent)
{
  for (const char* contact : {"0", "1"})
    for (const double share : {-0.01, 0.01}) {
      json::value document = chain_document();
      add(document, std::string("/limits/0/contacts/") + contact + "/force", share / test::rest_period);
      expect_caught(document, "forces miss the load by 0.005");
      expect_caught(document, "force_balance 0 reported, 0.005 found");
    }
}

TEST(Tamper, ForceOfASpreadContactIsComparedWithTheReportedBalance)
{
  json::value document = chain_document(Chain{.gap = 1e-3});
  document.at_pointer("/limits/0/contact") = "arc";
  EXPECT_TRUE(verify(document).ok) << verify(document).text();
  add(document, "/limits/0/contacts/0/force", 0.01 / test::rest_period);
  expect_caught(document, "force_balance 0 reported, 0.005 found");
}

TEST(Tamper, LinkUndone)
{
  // B moved out of A, past its right side: nothing intersects, but two links are lost.
  json::value document = chain_document();
  document.at_pointer("/limits/0/poses/1/position/1") = 40.0;
  expect_caught(document, "linking number of elements 0 and 1, primitives 0 and 0, image (-1, 0) is ");
  expect_caught(document, " at rest and 0 at the limit");
  document.at_pointer("/limits/0/links_kept") = false;
  document.at_pointer("/limits/0/status") = "stalled";
  EXPECT_EQ(limit_line(document).find("linking number"), std::string::npos) << "honest about the links";
  json::value claimed = chain_document();
  claimed.at_pointer("/limits/0/links_kept") = false;
  expect_caught(claimed, "links_kept is false, but all links are kept");
}

TEST(Tamper, RingTurnedOverChangesTheSignOfALink)
{
  json::value document = chain_document();
  document.at_pointer("/limits/0/poses/1/quaternion") = {std::sqrt(0.5), -std::sqrt(0.5), 0.0, 0.0};
  expect_caught(document, "linking number");
}

TEST(Tamper, ValuesThatDoNotFollowFromMacro)
{
  json::value document = chain_document();
  add(document, "/limits/0/value", 1e-8);
  expect_caught(document, "value 0.4333333433 reported, 0.4333333333 from macro");
  expect_caught(document, "/profiles/0/e_s: 0.4333333333 reported, 0.4333333433 from the limits");
  document = chain_document();
  add(document, "/limits/0/macro/exx", 1e-8);
  expect_caught(document, "line_stretch");
  expect_caught(document, "min_gap");
  document = chain_document();
  add(document, "/limits/0/starts/0/macro/exx", 1e-8);
  expect_caught(document, "starts/0: value");
  document = chain_document();
  document.at_pointer("/limits/0/sense") = "compress";
  expect_caught(document, "is on the wrong side of zero for compress");
  expect_caught(document, "forces miss the load by 2");
  document = chain_document();
  document.at_pointer("/limits/0/macro/eyy") = -1.5;
  expect_caught(document, "F is not positive definite");
}

TEST(Tamper, ContactsThatDoNotBelongToTheState)
{
  json::value document = chain_document();
  add(document, "/limits/0/contacts/0/gap", 1e-7);
  expect_caught(document, "contact 0: gap 1.0001e-07 listed, 1e-11 between its points");
  document = chain_document();
  add(document, "/limits/0/contacts/1/points/0/2", 1e-3);
  expect_caught(document, "contact 1: point 0 is 7.14e-07 off its surface");
  document = chain_document();
  document.at_pointer("/limits/0/contacts/0/normal") = {1.0, 0.0, 0.0};
  expect_caught(document, "contact 0: the normal is 2 off that of surface 0");
  document = chain_document();
  document.at_pointer("/limits/0/contacts/0/normal/0") = -1.001;
  expect_caught(document, "contact 0: the normal's length is 1.001");
  document = chain_document();
  document.at_pointer("/limits/0/contacts/0/elements") = {0, 5};
  expect_caught(document, "contact 0: no such elements or primitives");
  document = chain_document();
  document.at_pointer("/limits/0/contacts/0/force") = -1.0;
  expect_caught(document, "contact 0: pulls with -1");
  document = chain_document();
  document.at_pointer("/experiment/solver/clearance") = 0.01;
  expect_caught(document, "surfaces are 0.01 closer than the clearance");
}

TEST(Tamper, HeightsBeyondWhatIsAllowed)
{
  json::value document = chain_document();
  document.at_pointer("/experiment/load_case/out_of_plane") = 1e-4;
  add(document, "/limits/0/poses/0/position/2", 1e-3);
  add(document, "/limits/0/poses/1/position/2", -1e-3);
  expect_caught(document, "an element is 0.001 above or below its place, 0.0001 allowed");
}

TEST(Malformed, EverythingMissingIsAFailingLine)
{
  expect_caught(json::value(nullptr), "/format: missing");
  expect_caught(json::value{{"format", "other"}}, "/format: hauberk-results/2 expected, found other");
  for (const char* key : {"experiment", "scene", "limits", "profiles", "design"}) {
    json::value document = chain_document();
    document.as_object().erase(key);
    expect_caught(document, std::string("/") + key + ": missing");
  }
  json::value document = chain_document();
  document.at_pointer("/limits/0/poses/0/quaternion") = {1.0, 0.1, 0.0, 0.0};
  expect_caught(document, "/limits/0/poses/0/quaternion: not a unit quaternion with w >= 0");
  document = chain_document();
  document.at_pointer("/limits/0/measure") = "area";
  expect_caught(document, "the measure \"area\" is not known to this check");
  document = chain_document();
  document.at_pointer("/scene/length") = 50.0;
  expect_caught(document, "/scene/length: not the median ring radius of the initial scene");
  document = chain_document();
  document.at_pointer("/scene/elements/0/primitives/0/kind") = "sphere";
  expect_caught(document,
                "circle_tube, revolved_ellipse, curve_tube, triangle_mesh or solid expected, found sphere");
}

}  // namespace
}  // namespace hauberk
