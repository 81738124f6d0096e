/// Contact of solids that the kernel does not know: tori written as solids act like the built-in tori, in
/// distances, energies, derivatives, certified bounds and links; derivatives in sizes by central differences.

#include <scenes.hpp>
#include "contact/body_pair.hpp"
#include "curve_pairs.hpp"
#include "differences.hpp"
#include "geometry/separation.hpp"
#include "pose_derivatives.hpp"
#include "torus_solid.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

/// How the two bodies are written: 0 built in, else a solid whose probe has this dimension.
struct Case {
  const char* name;
  Formulation formulation;
  int first, second;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

Primitive torus(double R, double r, int how) { return how == 0 ? circle(R, r) : torus_solid(R, r, how); }

class SolidContact : public ::testing::TestWithParam<Case> {
 protected:
  static ContactSettings settings()
  {
    ContactSettings s{GetParam().formulation, 0.3, 0.01};
    // Bodies that are not written alike are never integrated over both; so the tori are not, either.
    if (GetParam().first != GetParam().second) s.sides = Sides::one;
    return s;
  }
  /// Whether an integral is over a surface, and not over a core as the torus's is.
  static bool over_a_surface()
  {
    return GetParam().formulation == Formulation::arc && GetParam().first == 2 && GetParam().second == 2;
  }
};

TEST_P(SolidContact, IsThatOfTheTorus)
{
  if (over_a_surface()) GTEST_SKIP() << "integrated over a surface instead of a core";
  std::mt19937_64 rng(5);
  int tried = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const Pose pose = linked_pose(1.6, 0.5, rng);
    const Couple plain(circle(1.0, 0.15), circle(0.9, 0.12), pose);
    const Couple solids(torus(1.0, 0.15, GetParam().first), torus(0.9, 0.12, GetParam().second), pose);
    const PairContact x = pair_contact(plain.A, pose, plain.B, Pose{}, settings(), 2);
    const PairContact y = pair_contact(solids.A, pose, solids.B, Pose{}, settings(), 2);
    if (!(x.min_gap > 0.01) || x.terms.energy == 0.0) continue;
    ++tried;
    const double small = GetParam().formulation == Formulation::arc ? 1e-7 : 1e-9;
    EXPECT_NEAR(y.terms.energy, x.terms.energy, small * x.terms.energy);
    EXPECT_LT((y.terms.gradient - x.terms.gradient).norm(), small * x.terms.gradient.norm());
    EXPECT_LT((y.terms.hessian - x.terms.hessian).norm(), 10.0 * small * x.terms.hessian.norm());
  }
  EXPECT_GT(tried, 20);
}

TEST_P(SolidContact, DerivativesInPoses)
{
  const auto draw = [](std::mt19937_64& rng) {
    const Primitive first = torus(1.0, 0.15, GetParam().first), second = torus(0.9, 0.12, GetParam().second);
    return Couple(first, second, linked_pose(1.6, 0.5, rng));
  };
  expect_pose_derivatives(draw, settings(),
                          over_a_surface() ? SmallDifferences{3e-6, 1e-3} : SmallDifferences{1e-8, 1e-5}, 6);
}

TEST_P(SolidContact, DerivativesInSizes)
{
  std::mt19937_64 rng(7);
  int tried = 0;
  for (int trial = 0; trial < 40 && tried < 4; ++trial) {
    const Pose pose = linked_pose(1.6, 0.5, rng);
    const std::array<double, 4> sizes{1.0, 0.15, 0.9, 0.12};
    const auto terms = [&](const std::array<double, 4>& s, bool parameters) {
      const Couple c(torus(s[0], s[1], GetParam().first), torus(s[2], s[3], GetParam().second), pose);
      return side_terms(c.frame(), settings(), {parameters ? 1 : 0, parameters, false}, 1.0);
    };
    const SideTerms now = terms(sizes, true);
    if (!(now.min_gap > 0.01) || now.energy == 0.0) continue;
    ++tried;
    const std::array<double, 4> derivative{
        GetParam().first == 0 ? now.dP[quantity_R] : now.curve_P.at(0),
        GetParam().first == 0 ? now.dP[quantity_r0] + now.dP[quantity_r1] : now.curve_P.at(1),
        GetParam().second == 0 ? now.dF[quantity_R] : now.curve_F.at(0),
        GetParam().second == 0 ? now.dF[quantity_r0] + now.dF[quantity_r1] : now.curve_F.at(1)};
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<double, 3> error{};
      for (std::size_t j = 0; j < 3; ++j) {
        const double h = 1e-3 / (1 << j);
        std::array<double, 4> more = sizes, less = sizes;
        more[k] += h;
        less[k] -= h;
        error[j] =
            std::abs((terms(more, false).energy - terms(less, false).energy) / (2.0 * h) - derivative[k]);
      }
      expect_second_order(error, now.gradient.norm(), 3e-6, k % 2 == 0 ? "R" : "r");
    }
  }
  EXPECT_EQ(tried, 4);
}

TEST_P(SolidContact, SeparationAndLinksAreThoseOfTori)
{
  std::mt19937_64 rng(8);
  int linked = 0, open = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Pose pose = linked_pose(1.6, 0.8, rng);
    const Couple plain(circle(1.0, 0.15), circle(0.9, 0.12), pose);
    const Couple solids(torus(1.0, 0.15, GetParam().first), torus(0.9, 0.12, GetParam().second), pose);
    const Separation x = separation(plain.A, pose, plain.B, Pose{}, 0.01, 1e300, 0.999);
    const Separation y = separation(solids.A, pose, solids.B, Pose{}, 0.01, 1e300, 0.999);
    if (!(x.lower > 1e-3)) {
      EXPECT_LE(y.lower, std::max(x.upper, 0.0));  // of bodies that meet no more is known than that
      continue;
    }
    ++open;
    EXPECT_LE(y.lower, x.upper) << "a lower bound above a distance that there is";
    EXPECT_GE(y.upper, x.lower);
    EXPECT_GT(y.lower, 0.99 * x.lower);
    const int number = std::abs(linking_number(plain.A, pose, plain.B, Pose{}));
    EXPECT_EQ(std::abs(linking_number(solids.A, pose, solids.B, Pose{})), number);
    linked += number;
  }
  EXPECT_GT(linked, 20);
  EXPECT_GT(open, 40);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SolidContact,
                         ::testing::Values(Case{"nearest_cores", Formulation::nearest, 1, 1},
                                           Case{"nearest_surfaces", Formulation::nearest, 2, 2},
                                           Case{"nearest_circle_core", Formulation::nearest, 0, 1},
                                           Case{"nearest_circle_surface", Formulation::nearest, 0, 2},
                                           Case{"arc_cores", Formulation::arc, 1, 1},
                                           Case{"arc_surfaces", Formulation::arc, 2, 2},
                                           Case{"arc_surface_circle", Formulation::arc, 2, 0}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace hauberk::test
