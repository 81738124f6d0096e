// Certified bounds of solids that the kit makes of a chart and a field, beside the kernel's own bodies of the
// same shape: over panels and between pairs, against samples that neither has a part in.

#include "counts.hpp"
#include "drawn_pairs.hpp"
#include "geometry/separation.hpp"
#include "panel_figures.hpp"
#include "random_pairs.hpp"
#include "solid_kit/solids.hpp"
#include "statistics.hpp"

#include <hauberk/kit/implicit_solid.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace hauberk::brute {
namespace {

using kit::Point;
using kit::Turn;

/// A ring of round wire by its core, with a field that is no distance.
struct RoundWire : test::PlainTorus {
  static constexpr const char* kind = "round_wire";
  static constexpr bool revolved = true;

  template <class S>
  static Point<S> core(const Turn<S>& u, const S* q)
  {
    return test::Torus::core(u, q);
  }
  template <class S>
  static S radius(const S* q)
  {
    return test::Torus::radius(q);
  }
};

Body kit_body(const Torus& torus)
{
  Primitive p;
  p.kind = PrimitiveKind::solid;
  if (torus.round()) {
    p.solid = std::make_shared<const kit::ImplicitSolid<RoundWire>>(std::vector<double>{torus.R, torus.r0});
  } else {
    p.solid = std::make_shared<const kit::ImplicitSolid<test::OvalRing>>(
        std::vector<double>{torus.R, torus.r0, torus.r1});
  }
  // As Shape::primitives does.
  p.size = {p.solid->radius(), p.solid->thickness(), p.solid->thickness()};
  return make_body(p, 0, 0, 1.0);
}

struct Bodies {
  Body a, b;
};

struct SolidFigures {
  PanelFigures panels;
  Sample half, tight;  ///< bound/distance of pairs
  /// Pairs whose bound is looser than asked. Where the probe's offset alone is beyond the reach of the other,
  /// no foot is known to be the nearest, and the search may end without.
  long open = 0;
};

/// Whether points of P's probe at the distance d are farther from F's surface than its reach.
bool beyond_reach(const Body& P, const Body& F, double d)
{
  return F.solid && P.solid->offset() + d >= F.solid->smoothness().reach;
}

void check_pair(const DrawnPair& p, const Bodies& bodies, SolidFigures& figures, const std::string& what)
{
  constexpr double rounding = 1e-14, resolved = 1e-12;
  for (const double tightness : {0.5, 0.9}) {
    const Separation s = separation(bodies.a, kernel_pose(p.a), bodies.b, kernel_pose(p.b), 0.0,
                                    std::numeric_limits<double>::infinity(), tightness);
    double d = p.distance;
    // The bodies are nearer to each other than the samples of the pair saw.
    if (s.upper < d - resolved) d = dense_distance(p.a, p.b);
    EXPECT_LE(s.lower, d + rounding) << what;
    if (s.lower < tightness * d - resolved) {
      EXPECT_TRUE(beyond_reach(bodies.a, bodies.b, d) || beyond_reach(bodies.b, bodies.a, d)) << what;
      ++figures.open;
    }
    (tightness < 0.9 ? figures.half : figures.tight).add(s.lower / d);
  }
}

/// The second torus turned and moved anew, at most its own size away from where it was.
DrawnPair moved(DrawnPair p, std::mt19937_64& rng)
{
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  p.b.axes = rotation_exp(std::numbers::pi * uniform(rng) * any_direction(rng)) * p.b.axes;
  p.b.center += p.b.R * uniform(rng) * any_direction(rng);
  p.distance = nearest_place(p.a, p.b).distance;
  return p;
}

class SolidBounds : public testing::TestWithParam<PairKind> {};

TEST_P(SolidBounds, AreBelowSamplesAndAsTightAsTheKernels)
{
  const long pairs = count("HAUBERK_ACCURACY_SOLID_PAIRS", 12);
  const long panels = count("HAUBERK_ACCURACY_SOLID_PANELS", 100);  // of each pair
  constexpr int places = 10;
  std::mt19937_64 rng(20264);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const bool round = GetParam() == PairKind::round_round;
  SolidFigures own, kit;
  for (long k = 0; k < pairs; ++k) {
    const DrawnPair p = drawn_pair(GetParam(), k);
    if (p.distance <= 0.0) continue;
    const Bodies kernel_bodies{kernel_body(p.a), kernel_body(p.b)}, kit_bodies{kit_body(p.a), kit_body(p.b)};
    const std::string what = fmt::format("{} {} ({})", name(GetParam()), k, name(p.family));
    for (int i = 0; i < places; ++i) {
      const DrawnPair there = i == 0 ? p : moved(p, rng);
      if (there.distance <= 0.0) continue;
      check_pair(there, kernel_bodies, own, what);
      check_pair(there, kit_bodies, kit, what);
    }
    for (long i = 0; i < panels; ++i) {
      const Panel s{2.0 * std::numbers::pi * uniform(rng), 2.0 * std::numbers::pi * uniform(rng),
                    std::pow(10.0, -3.0 + 2.7 * uniform(rng)),
                    round ? 0.0 : std::pow(10.0, -3.0 + 2.8 * uniform(rng))};
      for (const auto& [bodies, figures] : {std::pair(&kernel_bodies, &own), std::pair(&kit_bodies, &kit)}) {
        if (round) {
          check_panel<1>(p, bodies->a, bodies->b, s, figures->panels, what);
        } else {
          check_panel<2>(p, bodies->a, bodies->b, s, figures->panels, what);
        }
      }
    }
  }
  for (auto* f : {&own, &kit}) {
    fmt::print(
        "{}, {}: {} pairs, {} looser than asked, bound/distance where half is asked {}; nine tenths {}\n  {} panels, third order known "
        "for {}; (least sample - bound)/size, slopes {}, third order {}\n",
        name(GetParam()), f == &own ? "kernel" : "kit", f->half.size(), f->open, f->half.summary(),
        f->tight.summary(), f->panels.panels, f->panels.curved, f->panels.first.summary(),
        f->panels.third.summary());
  }
  EXPECT_EQ(kit.panels.panels, own.panels.panels);
  EXPECT_EQ(own.open, 0);
  EXPECT_LE(kit.open, static_cast<long>(kit.half.size() / 50));
  // As tight in the middle, to a fifth. Where half is asked for, a search by strips comes to more than it was
  // asked.
  if (GetParam() == PairKind::round_round) {
    EXPECT_GT(kit.half.quantile(0.5), 0.8 * own.half.quantile(0.5));
  }
  EXPECT_GT(kit.half.quantile(0.5), 0.6);
  EXPECT_GT(kit.tight.quantile(0.5), 0.8 * own.tight.quantile(0.5));
}

INSTANTIATE_TEST_SUITE_P(Kinds, SolidBounds,
                         testing::Values(PairKind::round_round, PairKind::elliptical_elliptical));

}  // namespace
}  // namespace hauberk::brute
