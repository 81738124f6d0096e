/// The second-order check: stationary states that are no maxima are found out, those that are pass.

#include "chain_document.hpp"
#include "column_document.hpp"
#include "surface.hpp"
#include "touching.hpp"

#include <hauberk/verify/verify.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <numbers>

namespace hauberk {
namespace {

namespace json = boost::json;
using namespace verification;
using test::Chain;
using test::chain_document;
using test::column_document;
using test::limit_line;
using verification::Primitive;

TEST(Saddle, AColumnThatWouldBuckleIsNotLocked)
{
  const std::string line = limit_line(column_document());
  EXPECT_TRUE(line.starts_with("FAIL ")) << line;
  EXPECT_NE(line.find("a saddle, not a locked state: moved by 0.003 it goes further by "), std::string::npos)
      << line;
  // Nothing else is wrong with it.
  EXPECT_EQ(line.find(';'), std::string::npos) << line;
}

TEST(Saddle, OnlyClaimsAreJudged)
{
  json::value document = column_document();
  document.at_pointer("/limits/0/status") = "stalled";
  document.at_pointer("/profiles/0/e_c") = nullptr;
  EXPECT_TRUE(limit_line(document).starts_with("PASS ")) << limit_line(document);
}

/// Maxima in one direction and indifferent in others: rings roll, and may turn about their axes.
TEST(Saddle, TautChainsPass)
{
  for (const Chain& chain :
       {Chain{}, Chain{.R_a = 3.0, .r_a = 0.9, .R_b = 6.0, .r_b = 0.4}, Chain{.axial = 1.2},
        Chain{.gap = 1e-4}, Chain{.clearance = 0.1}, Chain{.turned_deg = 37.0}}) {
    EXPECT_TRUE(limit_line(chain_document(chain)).starts_with("PASS ")) << limit_line(chain_document(chain));
  }
}

/// Beyond r1^2 / r0 = R - r0 the contact on the axis is no minimum of the distance: surfaces intersect beside
/// it.
TEST(Saddle, FlatTubesIntersectBesideTheAxis)
{
  const std::string line = limit_line(chain_document(Chain{.axial = 2.0}));
  EXPECT_NE(line.find("closer than the clearance"), std::string::npos) << line;
}

Primitive ring(double R, double r0, double r1, const Vec3& x, const Vec3& axis)
{
  Primitive out;
  out.R = R;
  out.r0 = r0;
  out.r1 = r1;
  out.place.position = x;
  out.place.rotation = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
  return out;
}

TEST(Touching, PerpendicularLinkedRingsTouchOnTheirAxisOfSymmetry)
{
  // A flat about the origin, B upright about (8, 0, 0): inner sides at x = 4.3 and 3.7 + distance.
  for (const double axial : {0.7, 0.9}) {
    const Primitive a = ring(5.0, 0.7, axial, {0, 0, 0}, {0, 0, 1}),
                    b = ring(5.0, 0.7, axial, {8.4, 0, 0}, {0, 1, 0});
    const Touching t = touching_near(a, b, {4.2, 0.1, 0.05});
    EXPECT_NEAR(t.distance, (5.0 - 0.7) - (8.4 - 4.3), 1e-12);
    EXPECT_LT((t.normal - Vec3(-1, 0, 0)).norm(), 1e-7);
    EXPECT_LT((t.on_a - Vec3(4.3, 0, 0)).norm(), 1e-6);
    EXPECT_LT((t.on_b - Vec3(4.1, 0, 0)).norm(), 1e-6);
    const std::vector<Touching> all = touchings(a, b, 0.5);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_NEAR(all[0].distance, t.distance, 1e-12);
  }
}

TEST(Touching, MixedSectionsAgreeEitherWayRound)
{
  const Primitive tube = ring(5.0, 0.7, 0.7, {0, 0, 0}, {0.1, 0.2, 1}),
                  oval = ring(4.0, 0.5, 0.9, {6, 0.3, 0.2}, {0, 1, 0.3});
  const std::vector<Touching> one = touchings(tube, oval, 3.0), other = touchings(oval, tube, 3.0);
  ASSERT_FALSE(one.empty());
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].distance, other[k].distance);
    EXPECT_EQ(one[k].normal, Vec3(-other[k].normal));
    EXPECT_NEAR(signed_distance(tube, one[k].on_a), 0.0, 1e-10);
    EXPECT_NEAR(signed_distance(oval, one[k].on_b), 0.0, 1e-10);
  }
}

}  // namespace
}  // namespace hauberk
