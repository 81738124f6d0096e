/// Contacts keep their number along a path.

#include "tasks/transition/tracks.hpp"

#include <gtest/gtest.h>

namespace hauberk {
namespace {

TransitionMinimum at(double x, double distance)
{
  TransitionMinimum m;
  m.on_fixed = m.on_moving = {x, 0, 0};
  m.distance = distance;
  return m;
}

TEST(Tracks, FollowPointsAndNotTheOrder)
{
  std::vector<TransitionSample> samples(4);
  samples[0].minima = {at(0.0, 1.0)};
  samples[1].minima = {at(0.1, 1.0), at(2.0, 1.1)};  // a second one appears
  samples[2].minima = {at(2.1, 0.9), at(0.2, 1.0)};  // and becomes the nearest
  samples[3].minima = {at(2.2, 0.8)};                // the first one vanishes
  number_contacts(samples, 0.5);
  EXPECT_EQ(samples[0].minima[0].contact, 0);
  EXPECT_EQ(samples[1].minima[0].contact, 0);
  EXPECT_EQ(samples[1].minima[1].contact, 1);
  EXPECT_EQ(samples[2].minima[0].contact, 1);
  EXPECT_EQ(samples[2].minima[1].contact, 0);
  EXPECT_EQ(samples[3].minima[0].contact, 1);
}

TEST(Tracks, FarPointsAndOtherPrimitivesAreNew)
{
  std::vector<TransitionSample> samples(2);
  samples[0].minima = {at(0.0, 1.0), at(1.0, 1.1)};
  samples[1].minima = {at(0.6, 1.0), at(1.0, 1.1)};
  samples[1].minima[1].primitives = {0, 1};
  number_contacts(samples, 0.3);
  EXPECT_EQ(samples[1].minima[0].contact, 2);
  EXPECT_EQ(samples[1].minima[1].contact, 3);
}

}  // namespace
}  // namespace hauberk
