// The kernel's list of local minima against brute force, and against the roots of a polynomial for circles.

#include "circle_roots.hpp"
#include "contact/formulation.hpp"
#include "contact/published.hpp"
#include "counts.hpp"
#include "drawn_pairs.hpp"
#include "pair_field.hpp"
#include "random_pairs.hpp"
#include "statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hauberk::brute {
namespace {

constexpr double merge_depth = 1e-9;  ///< shallower minima are one with their neighbour
constexpr double same_place = 1e-5;   ///< L
constexpr double at_threshold = 1e-9;

struct Tally {
  long pairs = 0, minima = 0, merged = 0, level = 0, on_axis = 0;
  long missed = 0, spurious = 0, twice = 0, wrong_distance = 0;
  long sampled_missed = 0, sampled_nearest = 0,
       sampled_pairs = 0;  // by the published search, which promises none
  std::size_t most = 0;    // reported for one pair
  Sample evaluations;
  void print(const char* what)
  {
    fmt::print(
        "{}: {} pairs, {} isolated minima; missed {}, spurious {}, twice {}, wrong distance {}\n"
        "    left out: {} merging with a neighbour, {} in level families, {} on the other's axis\n"
        "    most reported for a pair {}; evaluations {}\n"
        "    missed by samples: {} minima of {} pairs, the nearest of {}\n",
        what, pairs, minima, missed, spurious, twice, wrong_distance, merged, level, on_axis, most,
        evaluations.summary(), sampled_missed, sampled_pairs, sampled_nearest);
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

/// Places on P of the minima that the published search finds.
std::vector<Minimum> sampled_places(const Torus& P, const Torus& F)
{
  const Body p = kernel_body(P), f = kernel_body(F);
  int evaluations = 0;
  std::vector<Minimum> out;
  for (const published::PublishedMinimum& m :
       published::sampled_minima(PairFrame(p, kernel_pose(P), f, kernel_pose(F)), evaluations))
    out.push_back({m.c[0], P.round() ? 0.0 : m.c[1], std::sqrt(m.d)});
  return out;
}

void compare(const Torus& P, const Torus& F, const std::vector<BruteMinimum>& brute,
             const std::vector<Minimum>& found, double threshold, const std::string& what, Tally& tally)
{
  const Field field{P, F};
  const std::vector<Minimum> samples = sampled_places(P, F);
  constexpr double same_distance = 1e-9;
  tally.sampled_nearest += samples.front().distance > brute.front().distance + same_distance;
  bool all = true;
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
      const auto sampled = [&](const Minimum& m) {
        return near(b.u, b.v, m.u, m.v) || climb(field, b, m.u, m.v) < merge_depth;
      };
      if (std::none_of(samples.begin(), samples.end(), sampled)) {
        ++tally.sampled_missed;
        all = false;
      }
      if (hit) continue;
      ++tally.missed;
      fmt::print("{}: missed u {:.9f} v {:.9f} distance {:.12g} (threshold {:.3g}), curvature {:.3g}\n", what,
                 b.u, b.v, b.distance, threshold, lowest_curvature(field, b.u, b.v));
    }
  }
  tally.sampled_pairs += !all;
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
    Tally& tally = tallies[k % 3];
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

/// Two linked rings whose tubes are several times as high as wide, wider apart than they need be. Each tube
/// is too high for the other's hole, so that contact splits into up to four places: above and below, on both
/// sides.
std::pair<Torus, Torus> tall_linked_pair(long k)
{
  std::seed_seq seed{k, 5L};
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  using std::numbers::pi;
  Torus P, F;
  F.r0 = 0.03 + 0.1 * uniform(rng);
  F.r1 = 0.3 + 0.6 * uniform(rng);
  P.R = 0.6 + uniform(rng);
  P.r0 = 0.03 + 0.1 * uniform(rng);
  P.r1 = 0.3 + 0.6 * uniform(rng);
  const double tilt = uniform(rng) < 0.5 ? 0.02 : 0.3;
  const double turn = tilt * uniform(rng);
  const Mat3 leaning = rotation_exp(turn * any_direction(rng));
  P.axes = leaning * rotation_exp(Vec3(0.5 * pi, 0, 0)) * rotation_exp(Vec3(0, 0, 2.0 * pi * uniform(rng)));
  F.axes = rotation_exp(Vec3(0, 0, 2.0 * pi * uniform(rng)));
  const double inwards = uniform(rng), aside = 0.3 * tilt * uniform(rng);
  P.center = Vec3(F.R + P.R - F.r0 - P.r0 - inwards, 0, 0) + aside * any_direction(rng);
  return {P, F};
}

/// The published search starts from the nearest of 72 x 72 samples for each of 12 angles around either ring.
/// Two minima above each other, at the same angles around both rings, share their starts: the one whose
/// samples lie nearer is found, the other is not, and it may be the closer one.
TEST(LocalMinima, SamplesMissMinimaOfTallLinkedRings)
{
  Tally tally;
  for (long k = 0; k < pair_count() / 4; ++k) {
    const auto [P, F] = tall_linked_pair(k);
    if (nearest_place(P, F).distance <= 0.0) continue;
    ++tally.pairs;
    int evaluations = 0;
    constexpr double threshold = 50.0;
    const std::vector<Minimum> found = kernel_minima(P, F, threshold, evaluations);
    tally.evaluations.add(evaluations);
    compare(P, F, all_minima(P, F), found, threshold, fmt::format("tall pair {}", k), tally);
  }
  tally.print("tall linked rings");
  tally.expect_perfect();
  EXPECT_GT(tally.sampled_missed, tally.minima / 100);
}

TEST(LocalMinima, SamplesMissTheNearestOfTallLinkedRings)
{
  long pairs = 0, sampled = 0, certified = 0;
  double furthest = 1.0;
  const auto look = [&](long k) {
    const auto [P, F] = tall_linked_pair(k);
    const double exact = nearest_place(P, F).distance;
    if (exact <= 0.0) return;
    ++pairs;
    constexpr double same_distance = 1e-9;
    int evaluations = 0;
    const std::vector<Minimum> found = kernel_minima(P, F, 1.01 * exact, evaluations);
    certified += found.empty() || found.front().distance > exact + same_distance;
    const double closest = sampled_places(P, F).front().distance;
    if (closest > exact + same_distance) {
      ++sampled;
      fmt::print("tall pair {}: nearest {:.6f}, of the samples {:.6f}\n", k, exact, closest);
    }
    furthest = std::max(furthest, closest / exact);
  };
  for (long k = 0; k < pair_count(); ++k) look(k);
  look(9492);
  fmt::print(
      "tall linked rings: {} pairs, nearest minimum missed by certified {}, by samples {}, whose distance is "
      "up to {:.4f} of the right one\n",
      pairs, certified, sampled, furthest);
  EXPECT_EQ(certified, 0);
  EXPECT_GT(furthest, 1.05);
}

/// The nearest minimum for every kind and family of `drawn_pair`.
TEST(LocalMinima, NearestOfDrawnPairs)
{
  constexpr double same_distance = 1e-9;
  for (const PairKind kind :
       {PairKind::round_round, PairKind::round_elliptical, PairKind::elliptical_elliptical}) {
    std::array<long, draw_family_count> sampled{};
    long pairs = 0, certified = 0, level = 0, sampled_all = 0;
    for (long k = 0; k < pair_count() / 2; ++k) {
      const DrawnPair p = drawn_pair(kind, k);
      if (p.distance <= 0.0) continue;
      ++pairs;
      const bool swap = !p.a.round() && p.b.round();
      const Torus &P = swap ? p.b : p.a, &F = swap ? p.a : p.b;
      int evaluations = 0;
      const std::vector<Minimum> found = kernel_minima(P, F, 1.01 * p.distance + same_distance, evaluations);
      if (found.empty() || found.front().distance > p.distance + same_distance) {
        // Surfaces about one axis are equally close all around: there is no isolated minimum to report.
        const Field field{P, F};
        const BruteMinimum nearest = all_minima(P, F).front();
        if (rise_along_valley(field, nearest, 0.3) < merge_depth) {
          ++level;
        } else {
          ++certified;
          ADD_FAILURE() << name(kind) << ' ' << k << ' ' << name(p.family) << ": nearest missed";
        }
      }
      if (sampled_places(P, F).front().distance > p.distance + same_distance) {
        ++sampled_all;
        ++sampled[static_cast<std::size_t>(p.family)];
      }
    }
    fmt::print(
        "{}: {} pairs, nearest minimum missed by certified {} (equally close all around: {}), by samples {}:",
        name(kind), pairs, certified, level, sampled_all);
    for (int f = 0; f < draw_family_count; ++f)
      fmt::print(" {} {}", name(static_cast<DrawFamily>(f)), sampled[f]);
    fmt::print("\n");
  }
}

TEST(LocalMinima, FlatRingsAreNotPassedOver)
{
  // Cores in the field of a ring up to 300 times as high as wide: minima by the changes of sign of the slope
  // at 20,000 places.
  constexpr int places = 20000;
  const auto angle = [](int i) { return 2.0 * std::numbers::pi * i / places; };
  long pairs = 0, minima = 0;
  for (long k = 0; k < 240; ++k) {
    // In number 612 a bound of the third derivative that ignored the edge passed over one of three minima.
    std::mt19937_64 rng(static_cast<unsigned long>((k == 0 ? 612 : k) * 7919 + 13));
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Torus P, F;
    const double wide = 0.1 + 0.6 * uniform(rng), aspect = std::pow(10.0, 1.0 + 1.5 * uniform(rng));
    const bool high = uniform(rng) >= 0.5;
    F.r0 = high ? wide / aspect : wide;
    F.r1 = high ? wide : wide / aspect;
    P.R = std::pow(10.0, -0.7 + 1.4 * uniform(rng));
    P.r0 = P.r1 = 0.01 * P.R;
    P.axes = any_rotation(rng);
    P.center = 2.0 * uniform(rng) * (1.0 + P.R) * any_direction(rng);
    const PairField<double> field(P, F, true);
    std::vector<double> expected;
    bool inside = false;
    for (int i = 0; i < places && !inside; ++i) {
      const FieldJet<double> here = field.at(angle(i), 0.0);
      inside = here.value < 0.0;
      if (here.gu < 0.0 && field.at(angle(i + 1), 0.0).gu >= 0.0) expected.push_back(angle(i));
    }
    if (inside) continue;
    ++pairs;
    minima += static_cast<long>(expected.size());
    int evaluations = 0;
    const std::vector<Minimum> found = kernel_minima(P, F, 100.0, evaluations);
    for (const double u : expected) {
      const auto near = [&](const Minimum& m) {
        return std::abs(std::remainder(m.u - u, 2.0 * std::numbers::pi)) < 2.0 * angle(1);
      };
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), near)) << "pair " << k << ", u " << u;
    }
  }
  fmt::print("flat rings: {} pairs, {} minima\n", pairs, minima);
  EXPECT_GT(pairs, 150);
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
