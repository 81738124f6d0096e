// The certified lower bound against the distance: very many pairs of each kind in double, and those where
// least is left between the two to fifty digits.

#include "counts.hpp"
#include "drawn_pairs.hpp"
#include "geometry/separation.hpp"
#include "statistics.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

namespace hauberk::brute {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// What the double reference resolves, with lengths up to 10.
constexpr double resolved = 1e-12;
/// Rounding of the bound and of the reference together, with lengths up to 10.
constexpr double rounding = 1e-14;
/// Stated rounding of the bound alone. It shows where the spheres about both rings touch at the closest
/// points: there the bound is the distance.
constexpr double stated = 1e-15;

/// Requests as they are made: by the check of motions, of parameter changes, and of motions by 0.01 L, where
/// most pairs are far enough apart.
struct Request {
  const char* what;
  double enough, tightness;
};
constexpr std::array<Request, 3> requests{
    {{"half the distance", infinite, 0.5}, {"nine tenths", infinite, 0.9}, {"0.02 L is enough", 0.02, 0.5}}};

Separation bound(const DrawnPair& p, const Request& r)
{
  return separation(kernel_body(p.a), kernel_pose(p.a), kernel_body(p.b), kernel_pose(p.b), 0.0, r.enough,
                    r.tightness);
}

/// The `most` pairs with the largest scores.
class Tightest {
 public:
  explicit Tightest(std::size_t most) : most_(most) {}
  void offer(double score, long k)
  {
    if (heap_.size() == most_ && score <= heap_.front().first) return;
    const auto greater = [](const auto& x, const auto& y) { return x.first > y.first; };
    heap_.emplace_back(score, k);
    std::push_heap(heap_.begin(), heap_.end(), greater);
    if (heap_.size() <= most_) return;
    std::pop_heap(heap_.begin(), heap_.end(), greater);
    heap_.pop_back();
  }
  const std::vector<std::pair<double, long>>& pairs() const { return heap_; }

 private:
  std::size_t most_;
  std::vector<std::pair<double, long>> heap_;
};

struct Figures {
  Sample ratio, slack, microseconds, evaluations;
  std::array<Sample, draw_family_count> by_family;  // ratio
  void print(const Request& r)
  {
    const auto quantiles = [](Sample& s) {
      return fmt::format("0.1 % {:.4g}, 1 % {:.4g}, 10 % {:.4g}, median {:.4g}, 90 % {:.4g}, max {:.8g}",
                         s.quantile(0.001), s.quantile(0.01), s.quantile(0.1), s.quantile(0.5),
                         s.quantile(0.9), s.quantile(1.0));
    };
    fmt::print("  {}\n    bound/distance        {}\n    (distance - bound)/L  {}, min {:.3g}\n", r.what,
               quantiles(ratio), quantiles(slack), slack.quantile(0.0));
    fmt::print("    microseconds          {}, mean {:.4g}\n    evaluations           {}, mean {:.4g}\n",
               quantiles(microseconds), microseconds.mean(), quantiles(evaluations), evaluations.mean());
  }
};

class CertifiedBound : public testing::TestWithParam<PairKind> {};

TEST_P(CertifiedBound, NeverExceedsTheDistance)
{
  const PairKind kind = GetParam();
  const long first = count("HAUBERK_ACCURACY_FIRST", 0), pairs = count("HAUBERK_ACCURACY_BOUNDS", 2000);
  const std::size_t most = count("HAUBERK_ACCURACY_PRECISE", 15);
  std::array<Figures, requests.size()> figures;
  std::array<Tightest, 3> tightest{Tightest(most), Tightest(most), Tightest(most)};
  Tightest least(most), closest(most);
  long separate = 0, overlapping = 0, unseen = 0, violated = 0;
  std::array<long, draw_family_count> families{};
  for (long k = first; k < first + pairs; ++k) {
    const DrawnPair p = drawn_pair(kind, k);
    if (p.distance <= 0.0) {
      ++overlapping;
      continue;
    }
    std::array<Separation, requests.size()> s;
    std::array<double, requests.size()> time{};
    for (std::size_t r = 0; r < requests.size(); ++r) {
      const auto start = std::chrono::steady_clock::now();
      s[r] = bound(p, requests[r]);
      time[r] = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    }
    double d = p.distance;
    const std::string what = fmt::format("{} {} ({})", name(kind), k, name(p.family));
    if (s[1].upper < d - resolved) {
      // The kernel saw something closer.
      ++unseen;
      const double dense = dense_distance(p.a, p.b);
      if (s[1].upper <= 0.0) {
        ++overlapping;
        EXPECT_LE(dense, resolved) << what;
        continue;
      }
      EXPECT_GE(s[1].upper, dense - resolved) << what;
      d = std::min({d, dense, s[1].upper});
    }
    ++separate;
    ++families[static_cast<std::size_t>(p.family)];
    for (std::size_t r = 0; r < requests.size(); ++r) {
      if (s[r].lower > d + rounding) ++violated;
      EXPECT_LE(s[r].lower, d + rounding) << what << ", " << requests[r].what;
      EXPECT_GE(s[r].lower, std::min(requests[r].enough, requests[r].tightness * d) - rounding) << what;
      figures[r].ratio.add(s[r].lower / d);
      figures[r].slack.add(d - s[r].lower);
      figures[r].microseconds.add(time[r]);
      figures[r].evaluations.add(s[r].evaluations);
      tightest[r].offer(s[r].lower / d, k);
    }
    least.offer(s[1].lower - d, k);
    closest.offer(-d, k);
    figures[0].by_family[static_cast<std::size_t>(p.family)].add(s[0].lower / d);
    figures[1].by_family[static_cast<std::size_t>(p.family)].add(time[0]);
  }
  fmt::print(
      "{}: {} pairs apart, {} overlapping; bound above the distance {}; kernel closer than the samples {}\n",
      name(kind), separate, overlapping, violated, unseen);
  for (std::size_t r = 0; r < requests.size(); ++r) figures[r].print(requests[r]);
  for (int f = 0; f < draw_family_count; ++f) {
    const std::size_t i = f;
    fmt::print(
        "  {:<14} {} pairs, bound/distance 1 % {:.4g}, median {:.4g}; microseconds median {:.4g}, 99 % "
        "{:.4g}\n",
        name(static_cast<DrawFamily>(f)), families[i], figures[0].by_family[i].quantile(0.01),
        figures[0].by_family[i].quantile(0.5), figures[1].by_family[i].quantile(0.5),
        figures[1].by_family[i].quantile(0.99));
  }
  EXPECT_GT(separate, 20 * overlapping);
  EXPECT_EQ(violated, 0);

  // To fifty digits: the pairs with the largest bound/distance of either request, the least difference, and
  // the smallest distances.
  struct Group {
    const char* what;
    const Tightest& pairs;
    std::size_t request;
  };
  const std::array<Group, 5> groups{{{"largest bound/distance, half", tightest[0], 0},
                                     {"largest bound/distance, nine tenths", tightest[1], 1},
                                     {"largest bound/distance, 0.02 L is enough", tightest[2], 2},
                                     {"least distance - bound, nine tenths", least, 1},
                                     {"smallest distance, nine tenths", closest, 1}}};
  for (const Group& group : groups) {
    double least_relative = infinite, least_slack = infinite, apart = 0.0, smallest = infinite, largest = 0.0;
    long above = 0;
    for (const auto& [score, k] : group.pairs.pairs()) {
      const DrawnPair p = drawn_pair(kind, k);
      const double lower = bound(p, requests[group.request]).lower;
      const PreciseSlack precise = precise_slack(p.a, p.b, lower);
      above += precise.slack < 0.0;
      EXPECT_GE(precise.slack, group.request == 2 ? -stated : 0.0)
          << name(kind) << ' ' << k << ' ' << name(p.family) << ": bound " << lower << " above "
          << precise.distance;
      least_relative = std::min(least_relative, precise.slack / precise.distance);
      least_slack = std::min(least_slack, precise.slack);
      apart = std::max(apart, std::abs(precise.distance - p.distance));
      smallest = std::min(smallest, precise.distance);
      largest = std::max(largest, precise.distance);
    }
    fmt::print(
        "  fifty digits, {} with {}: above the distance {}; 1 - bound/distance at least {:.3g}, distance - "
        "bound at least {:.3g}; distances {:.3g} .. {:.3g}, double differs by {:.2g}\n",
        group.pairs.pairs().size(), group.what, above, least_relative, least_slack, smallest, largest, apart);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, CertifiedBound,
                         testing::Values(PairKind::round_round, PairKind::round_elliptical,
                                         PairKind::elliptical_elliptical));

}  // namespace
}  // namespace hauberk::brute
