/// Pairs of a strip that a step may bring together, against a look at all of them along the whole step.

#include "loadcases/strip_roll/strip_roll.hpp"
#include "motion/track.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace hauberk::test {
namespace {

/// Equal rings in a strip; their reach is 1.1.
SceneSpec rings_at(const std::vector<Vec3>& places, double period)
{
  SceneSpec scene;
  scene.types.push_back({"ring", std::make_shared<Rings>()});
  scene.lattice = {period * Vec3::UnitX()};
  for (const Vec3& place : places) {
    PlacedElement e;
    e.parameters = {1.0, 0.1, 0.1};
    e.rest.position = place;
    scene.elements.push_back(std::move(e));
  }
  return scene;
}
constexpr double clearance = 0.01, touching = 2.21;

/// Rings in rows of a strip, whose vector is as short as a ring is wide.
SceneSpec strip()
{
  std::vector<Vec3> places;
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int row = 0; row < 6; ++row) places.emplace_back(u(rng), 2.0 * row - 5.0, 0.2 * u(rng));
  return rings_at(places, 2.5);
}

using Pair = std::tuple<int, int, Image>;

/// Pairs whose spheres come within the clearance of each other at one of many places of the step.
std::set<Pair> that_meet(const Model& m, const State& from, const Vector& dy)
{
  constexpr int places = 20, images = 8;
  std::set<Pair> out;
  for (int s = 0; s <= places; ++s) {
    const State there = advanced(m, from, dy, static_cast<double>(s) / places);
    for (int i = 0; i < m.element_count(); ++i) {
      const Vec3 x = image_pose(m, there, i, {}).position;
      for (int j = i; j < m.element_count(); ++j) {
        for (int n = i == j ? 1 : -images; n <= images; ++n) {
          const Vec3 y = image_pose(m, there, j, {n, 0}).position;
          if ((x - y).norm() < m.reach[i] + m.reach[j] + m.clearance) out.insert({i, j, Image{n, 0}});
        }
      }
    }
  }
  return out;
}

TEST(StripPairs, NoneIsMissed)
{
  const StripRoll load(false, true);
  const Model m = make_model(strip(), load, clearance);
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  State from = rest_state(m);
  std::size_t met = 0, met_by_short = 0, found_by_short = 0;
  for (int repeat = 0; repeat < 90; ++repeat) {
    from.macro << 0.5 * u(rng), 0.4 * u(rng);
    for (Eigen::Index k = 0; k < from.e.size(); ++k) from.e[k] = 2.0 * u(rng);
    const std::array sizes{0.02, 0.2, 2.0};
    const bool is_short = repeat % 3 == 0;
    Vector dy(m.dofs());
    for (Eigen::Index k = 0; k < dy.size(); ++k) dy[k] = sizes[static_cast<std::size_t>(repeat % 3)] * u(rng);
    dy.head<2>() *= 0.3;
    // Some steps strain by so much that the lattice's change bounds nothing.
    if (repeat % 5 == 1) dy[0] = 1.5;
    std::set<Pair> found;
    for (const CandidatePair& pair : candidate_pairs(m, from, dy))
      found.insert({pair.ti.element, pair.tj.element, pair.tj.image});
    const std::set<Pair> meet = that_meet(m, from, dy);
    for (const auto& [i, j, image] : meet)
      EXPECT_TRUE(found.contains({i, j, image}))
          << repeat << ": " << i << ", " << j << " [" << image[0] << ']';
    met += meet.size();
    if (is_short && repeat % 5 != 1) met_by_short += meet.size(), found_by_short += found.size();
  }
  EXPECT_GT(met, 500U);
  EXPECT_LT(found_by_short, 1.5 * static_cast<double>(met_by_short)) << "of " << met_by_short;
}

/// Steps of two rings or a ring and its image that come to touch at their very end, by nothing but what the
/// case names: the bound is what they need, and no more.
struct Meeting {
  const char* name;
  std::vector<Vec3> places;
  double period;
  std::vector<double> step;  ///< exx, k; then u of each ring
  Pair pair;
};

std::ostream& operator<<(std::ostream& out, const Meeting& meeting) { return out << meeting.name; }

class LastMoment : public ::testing::TestWithParam<Meeting> {};

TEST_P(LastMoment, IsFound)
{
  const Meeting& meeting = GetParam();
  const StripRoll load(false, true);
  const SceneSpec scene = rings_at(meeting.places, meeting.period);
  const Model m = make_model(scene, load, clearance);
  const State from = rest_state(m);
  Vector dy = Vector::Zero(m.dofs());
  for (int k = 0; k < 2; ++k) dy[k] = meeting.step[k] * (k == 1 ? m.length : 1.0);
  for (int i = 0; i < m.element_count(); ++i)
    for (int c = 0; c < 3; ++c)
      dy[m.offset(i) + c] = meeting.step[static_cast<std::size_t>(2 + 3 * i + c)] / m.length;
  const auto finds = [&](double part) {
    for (const CandidatePair& found : candidate_pairs(m, from, Vector(part * dy)))
      if (Pair{found.ti.element, found.tj.element, found.tj.image} == meeting.pair) return true;
    return false;
  };
  EXPECT_TRUE(finds(1.0 + 1e-6));
  EXPECT_FALSE(finds(0.9)) << "nothing is near that soon";
}

/// sin(k s)/k = d/2 for s = 2 and d = 2.21, so that the ends of the arc are d apart.
double closing()
{
  double low = 0.1, high = 1.5;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (std::sin(2.0 * middle) / middle > 0.5 * touching ? low : high) = middle;
  }
  return high;
}

INSTANTIATE_TEST_SUITE_P(
    Of, LastMoment,
    ::testing::Values(
        Meeting{"Rows", {{0, -2, 0}, {0, 2, 0}}, 50.0, {0, 0, 0, 0.895, 0, 0, -0.895, 0}, {0, 1, {}}},
        Meeting{"Images", {{0, 0, 0}, {46, 0, 0}}, 50.0, {0, 0, -0.895, 0, 0, 0.895, 0, 0}, {0, 1, {-1}}},
        Meeting{"Strain", {{0, 0, 0}}, 3.0, {touching / 3.0 - 1.0, 0, 0, 0, 0}, {0, 0, {1}}},
        Meeting{"Curvature", {{0, -2, 0}, {0, 2, 0}}, 50.0, {0, closing(), 0, 0, 0, 0, 0, 0}, {0, 1, {}}}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace hauberk::test
