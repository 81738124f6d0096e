// The kernel's list of local minima against brute force, and against the roots of a polynomial for circles.

#include "circle_roots.hpp"
#include "counts.hpp"
#include "random_pairs.hpp"
#include "statistics.hpp"

#include <hauberk/contact/formulation.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::brute {
namespace {

constexpr double merge_depth = 1e-9;  ///< shallower minima are one with their neighbour
constexpr double same_place = 1e-5;   ///< L
constexpr double at_threshold = 1e-9;

struct Tally {
  long pairs = 0, minima = 0, merged = 0, level = 0, on_axis = 0;
  long missed = 0, spurious = 0, twice = 0, wrong_distance = 0;
  std::size_t most = 0;  // reported for one pair
  Sample evaluations;
  void print(const char* what)
  {
    fmt::print(
        "{}: {} pairs, {} isolated minima; missed {}, spurious {}, twice {}, wrong distance {}\n"
        "    left out: {} merging with a neighbour, {} in level families, {} on the other's axis\n"
        "    most reported for a pair {}; evaluations {}\n",
        what, pairs, minima, missed, spurious, twice, wrong_distance, merged, level, on_axis, most,
        evaluations.summary());
  }
  void expect_perfect() const
  {
    EXPECT_EQ(missed, 0);
    expect_sound();
  }
  /// What holds for every kind of pair.
  void expect_sound() const
  {
    EXPECT_EQ(spurious, 0);
    EXPECT_EQ(twice, 0);
    EXPECT_EQ(wrong_distance, 0);
  }
};

Vec3 place(const Torus& P, double u, double v) { return P.round() ? P.core(u) : P.surface(u, v); }

double axis_distance(const Torus& F, const Vec3& x)
{
  const Vec3 y = F.axes.transpose() * (x - F.center);
  return std::hypot(y.x(), y.y());
}

std::vector<Minimum> kernel_minima(const Torus& P, const Torus& F, double threshold, int& evaluations)
{
  const Body p = kernel_body(P), f = kernel_body(F);
  const PairFrame frame(p, kernel_pose(P), f, kernel_pose(F));
  return P.round() ? local_minima<1>(frame, threshold, evaluations)
                   : local_minima<2>(frame, threshold, evaluations);
}

void compare(const Torus& P, const Torus& F, const std::vector<BruteMinimum>& brute,
             const std::vector<Minimum>& found, double threshold, const std::string& what, Tally& tally)
{
  const Field field{P, F};
  const auto near = [&](double u, double v, double a, double b) {
    return (place(P, u, v) - place(P, a, b)).norm() < same_place * std::max(1.0, P.R);
  };
  for (const BruteMinimum& b : brute) {
    if (b.distance > threshold - at_threshold) continue;
    bool hit = false, merged = false;
    for (const Minimum& m : found) {
      if (near(b.u, b.v, m.u, m.v)) {
        hit = true;
        if (std::abs(m.distance - b.distance) > 1e-10) {
          ++tally.wrong_distance;
          ADD_FAILURE() << what << ": distance " << m.distance << " should be " << b.distance;
        }
      }
    }
    for (std::size_t k = 0; !hit && !merged && k < found.size(); ++k) {
      merged = climb(field, b, found[k].u, found[k].v) < merge_depth;
    }
    for (std::size_t k = 0; !hit && !merged && k < brute.size(); ++k) {
      // Two of brute force's own that merge: either may be reported, or none when a whole family lies level.
      if (!near(b.u, b.v, brute[k].u, brute[k].v))
        merged = climb(field, b, brute[k].u, brute[k].v) < merge_depth;
    }
    if (merged) {
      ++tally.merged;
    } else if (!hit && rise_along_valley(field, b, 0.3) < merge_depth) {
      ++tally.level;
    } else if (!hit && axis_distance(F, place(P, b.u, b.v)) < 1e-6) {
      ++tally.on_axis;  // all of F's inner circle is equally close: no isolated minimum
    } else {
      ++tally.minima;
      if (hit) continue;
      ++tally.missed;
      fmt::print("{}: missed u {:.9f} v {:.9f} distance {:.12g} (threshold {:.3g}), curvature {:.3g}\n", what,
                 b.u, b.v, b.distance, threshold, lowest_curvature(field, b.u, b.v));
    }
  }
  tally.most = std::max(tally.most, found.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Minimum& m = found[k];
    double gu, gv;
    const double d = field.value(m.u, m.v, gu, gv);
    const double slope = std::hypot(gu / (P.R + P.r0), gv / std::max(P.r0, P.r1));
    const double low = lowest_curvature(field, m.u, m.v);
    if (axis_distance(F, place(P, m.u, m.v)) < 2e-4) {
      ++tally.on_axis;
      continue;
    }
    if (slope > 1e-7 || low < -1e-5 || std::abs(d - m.distance) > 1e-10) {
      ++tally.spurious;
      ADD_FAILURE() << fmt::format(
          "{}: reported u {:.9f} v {:.9f} distance {:.12g}: slope {:.2e}, curvature {:.2e}, "
          "own distance {:.12g}",
          what, m.u, m.v, m.distance, slope, low, d);
    }
    for (std::size_t j = 0; j < k; ++j) {
      if (near(m.u, m.v, found[j].u, found[j].v) &&
          climb(field, {m.u, m.v, m.distance}, found[j].u, found[j].v) < 1e-15 && low > 1e-3) {
        ++tally.twice;
        ADD_FAILURE() << what << ": reported twice, u " << m.u << " v " << m.v;
      }
    }
  }
}

double threshold_of(long k)
{
  constexpr std::array<double, 4> thresholds{0.05, 0.5, 5.0, 50.0};
  return thresholds[static_cast<std::size_t>(k / 24) % thresholds.size()];
}

TEST(LocalMinima, NoneMissedNoneSpurious)
{
  std::array<Tally, 3> tallies;
  long overlapping = 0;
  for (long k = 0; k < pair_count(); ++k) {
    const TorusPair pair = random_pair(k);
    // As the kernel: the round one of a mixed pair is probed.
    const bool swap = !pair.a.round() && pair.b.round();
    const Torus &P = swap ? pair.b : pair.a, &F = swap ? pair.a : pair.b;
    const std::vector<BruteMinimum> brute = all_minima(P, F);
    if (brute.front().distance <= 0.0 ||
        (!P.round() && all_minima(F, P, {2048, 128, 48}).front().distance <= 0.0)) {
      ++overlapping;
      continue;
    }
    Tally& tally = tallies[static_cast<std::size_t>(k % 3)];
    ++tally.pairs;
    int evaluations = 0;
    const double threshold = threshold_of(k);
    const std::vector<Minimum> found = kernel_minima(P, F, threshold, evaluations);
    tally.evaluations.add(evaluations);
    compare(P, F, brute, found, threshold, fmt::format("pair {} ({})", k, name(pair.family)), tally);
  }
  fmt::print("local minima ({} overlapping pairs left out)\n", overlapping);
  tallies[0].print("  round/round");
  tallies[1].print("  round/elliptical");
  tallies[2].print("  elliptical/elliptical");
  for (const Tally& t : tallies) t.expect_perfect();
}

TEST(LocalMinima, CirclesAgainstTheRootsOfThePolynomial)
{
  Tally tally;
  long degenerate = 0;
  for (long k = 0; k < pair_count(); k += 3) {
    const TorusPair p = random_pair(k);
    const std::vector<BruteMinimum> roots = circle_minima(p.a, p.b);
    if (roots.empty()) {
      ++degenerate;
      continue;
    }
    if (roots.front().distance <= 0.0) continue;
    ++tally.pairs;
    int evaluations = 0;
    const double threshold = threshold_of(k);
    const std::vector<Minimum> found = kernel_minima(p.a, p.b, threshold, evaluations);
    tally.evaluations.add(evaluations);
    compare(p.a, p.b, roots, found, threshold, fmt::format("pair {} ({})", k, name(p.family)), tally);
  }
  fmt::print("{} degenerate pairs left out\n", degenerate);
  tally.print("round/round, polynomial of degree eight");
  tally.expect_perfect();
}

}  // namespace
}  // namespace hauberk::brute
