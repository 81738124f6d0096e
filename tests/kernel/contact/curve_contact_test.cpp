/// Contact energies of tubes around curves: the same as of circles where they are circles; derivatives in
/// poses and in all geometric quantities, by central differences that converge with second order.

#include <scenes.hpp>
#include "contact/body_pair.hpp"
#include "curve_pairs.hpp"
#include "differences.hpp"
#include "pose_derivatives.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

struct Case {
  const char* name;
  Formulation formulation;
  int other;  ///< 0: a curve, 1: a circle, 2: an ellipse
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class CurveContact : public ::testing::TestWithParam<Case> {
 protected:
  /// A wavy link that nearly touches the other body.
  static std::pair<Primitive, Primitive> primitives(std::mt19937_64& rng)
  {
    const int other = GetParam().other;
    return {wavy(0.15, 0.12, rng), other == 0   ? wavy(0.15, 0.12, rng)
                                   : other == 1 ? circle(1.0, 0.15)
                                                : ellipse(1.0, 0.12, 0.2)};
  }
  static ContactSettings settings() { return {GetParam().formulation, 0.3, 0.01}; }
};

TEST_P(CurveContact, DerivativesInPoses)
{
  // Surfaces are integrated to about 1e-8 of the energy; differences magnify that by 1/h and 1/h^2.
  const bool surface = GetParam().formulation == Formulation::arc && GetParam().other == 0;
  const auto draw = [](std::mt19937_64& rng) {
    const auto [a, b] = primitives(rng);
    return Couple(a, b, linked_pose(1.6, 0.5, rng));
  };
  expect_pose_derivatives(draw, settings(),
                          surface ? SmallDifferences{3e-6, 1e-3} : SmallDifferences{1e-8, 1e-5}, 5);
}

TEST_P(CurveContact, DerivativesInGeometry)
{
  std::mt19937_64 rng(6);
  int tried = 0;
  for (int trial = 0; trial < 40 && tried < 3; ++trial) {
    const auto [a, b] = primitives(rng);
    const Couple c(a, b, linked_pose(1.6, 0.5, rng));
    const auto terms = [&](const Couple& x, bool parameters) {
      return side_terms(x.frame(), settings(), {parameters ? 1 : 0, parameters, false}, 1.0);
    };
    const SideTerms now = terms(c, true);
    if (!(now.min_gap > 0.01) || now.energy == 0.0) continue;
    ++tried;
    const auto check = [&](const std::string& what, double derivative, auto&& change) {
      std::array<double, 3> error{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double h = 1e-3 / (1 << k);
        std::array<double, 2> energy{};
        for (std::size_t sign = 0; sign < 2; ++sign) {
          Primitive p = a, q = b;
          change(p, q, sign == 0 ? h : -h);
          energy[sign] = terms(Couple(p, q, c.pose), false).energy;
        }
        error[k] = std::abs((energy[0] - energy[1]) / (2.0 * h) - derivative);
      }
      SCOPED_TRACE(what);
      expect_second_order(error, now.gradient.norm(), 3e-6);
    };
    ASSERT_EQ(now.curve_P.size(), 18U);
    ASSERT_EQ(now.curve_F.size(), GetParam().other == 0 ? 18U : 0U);
    for (std::size_t k = 0; k < 18; ++k) {
      const auto coefficient = [k](Primitive& p) -> double& {
        Harmonic& h = p.curve[k / 6];
        return (k % 6 < 3 ? h.c : h.s)[static_cast<Eigen::Index>(k % 3)];
      };
      check("P" + std::to_string(k), now.curve_P[k],
            [&](Primitive& p, Primitive&, double h) { coefficient(p) += h; });
      if (GetParam().other != 0) continue;
      check("F" + std::to_string(k), now.curve_F[k],
            [&](Primitive&, Primitive& q, double h) { coefficient(q) += h; });
    }
    check("r of P", now.dP[4] + now.dP[5],
          [](Primitive& p, Primitive&, double h) { p.size[1] = p.size[2] += h; });
    if (GetParam().other < 2) {
      check("r of F", now.dF[4] + now.dF[5],
            [](Primitive&, Primitive& q, double h) { q.size[1] = q.size[2] += h; });
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
      // F lies at the origin, so its frame is the world's; P's element is turned.
      check("position of P", now.dP[i], [&](Primitive& p, Primitive&, double h) {
        p.position += h * c.pose.rotation.transpose().col(i);
      });
      check("position of F", now.dF[i], [&](Primitive&, Primitive& q, double h) { q.position[i] += h; });
    }
  }
  EXPECT_EQ(tried, 3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, CurveContact,
                         ::testing::Values(Case{"nearest_curve", Formulation::nearest, 0},
                                           Case{"nearest_circle", Formulation::nearest, 1},
                                           Case{"nearest_ellipse", Formulation::nearest, 2},
                                           Case{"arc_curve", Formulation::arc, 0},
                                           Case{"arc_circle", Formulation::arc, 1},
                                           Case{"arc_ellipse", Formulation::arc, 2}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(CurveTubes, NearestContactOfCirclesAsCurvesIsThatOfCircles)
{
  std::mt19937_64 rng(8);
  const ContactSettings settings{Formulation::nearest, 0.2, 0.0};
  int touching = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const Pose pose = linked_pose(1.6, 0.8, rng);
    const Couple plain(circle(1.0, 0.15), circle(0.9, 0.1), pose);
    const Couple both(circle_curve(1.0, 0.15), circle_curve(0.9, 0.1), pose);
    const PairContact x = pair_contact(plain.A, pose, plain.B, Pose{}, settings, 2);
    const PairContact y = pair_contact(both.A, pose, both.B, Pose{}, settings, 2);
    if (!(x.min_gap > 1e-3)) continue;
    EXPECT_NEAR(x.terms.energy, y.terms.energy, 1e-10 * std::abs(x.terms.energy));
    EXPECT_LT((x.terms.gradient - y.terms.gradient).norm(), 1e-9 * (1e-9 + x.terms.gradient.norm()));
    EXPECT_LT((x.terms.hessian - y.terms.hessian).norm(), 1e-8 * (1e-9 + x.terms.hessian.norm()));
    touching += x.terms.energy > 0.0;
  }
  EXPECT_GT(touching, 20);
}

TEST(CurveTubes, ThePlaceOfContactIsOnBothTubes)
{
  std::mt19937_64 rng(9);
  int found = 0;
  for (int trial = 0; trial < 80; ++trial) {
    const Couple c(wavy(0.15, 0.12, rng), wavy(0.15, 0.12, rng), linked_pose(1.6, 0.5, rng));
    const SideTerms t = side_terms(c.frame(), {Formulation::nearest, 0.2, 0.0}, {1, false, true}, 1.0);
    if (!(t.min_gap > 0.0)) continue;
    const PairFrame frame = c.frame();
    Vec3 force = Vec3::Zero();
    for (const ContactPoint& p : t.points) {
      EXPECT_NEAR((p.on_p - p.on_f).dot(p.normal), p.gap, 1e-12);
      const auto distance = [&](const Body& body, const Vec3& local) {
        double least = 10.0;
        for (int i = 0; i < 20000; ++i)
          least =
              std::min(least, (body.curve->at(Angle(2.0 * std::numbers::pi * i / 20000)).x - local).norm());
        return least;
      };
      const Mat3 axes = (Mat3() << frame.e1, frame.e2, frame.e3).finished();
      EXPECT_NEAR(distance(c.A, axes.transpose() * (p.on_p - frame.a)), c.A.r0, 1e-6);
      EXPECT_NEAR(distance(c.B, p.on_f), c.B.r0, 1e-6);
      force += p.force * p.normal;
      ++found;
    }
    EXPECT_LT((force + t.gradient.head<3>()).norm(), 1e-10 * (1.0 + force.norm()));
  }
  EXPECT_GT(found, 20);
}

}  // namespace
}  // namespace hauberk::test
