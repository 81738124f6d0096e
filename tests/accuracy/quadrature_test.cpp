// Contact integrals of `arc`: the trapezoidal rule over another distance, and panels that are much smaller.

#include "contact/barrier.hpp"
#include "contact/body_pair.hpp"
#include "drawn_pairs.hpp"
#include "pair_field.hpp"
#include "statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace hauberk::brute {
namespace {

using std::numbers::pi;

/// A pair whose gap is a given part of the activation distance.
struct Contact {
  Torus P, F;
  double g_hat;
};

/// Linked pairs and such as nearly touch, at gaps as stages have them.
std::vector<Contact> contacts(PairKind kind, std::size_t count)
{
  std::vector<Contact> out;
  for (long k = 0; out.size() < count; ++k) {
    const DrawnPair pair = drawn_pair(kind, k);
    if (pair.family != DrawFamily::linked && pair.family != DrawFamily::near_touching) continue;
    const double g_hat = pair.distance / std::array{0.05, 0.1, 0.3}[static_cast<std::size_t>(k % 3)];
    if (g_hat < 3e-4 || g_hat > 0.1) continue;  // where stages integrate
    const bool swapped = pair.b.round() && !pair.a.round();
    out.push_back({swapped ? pair.b : pair.a, swapped ? pair.a : pair.b, g_hat});
  }
  return out;
}

SideTerms integral(const Contact& c, Quadrature quadrature, double panel_ratio)
{
  ContactSettings settings{Formulation::arc, c.g_hat, 0.0};
  settings.quadrature = quadrature;
  settings.panel_ratio = panel_ratio;
  const Body P = kernel_body(c.P), F = kernel_body(c.F);
  const PairFrame frame(P, kernel_pose(c.P), F, kernel_pose(c.F));
  return side_terms(frame, settings, Request{1, false, false}, 1.0);
}

/// The energy by the trapezoidal rule, `n` places around. L = 1; weights as method.md has them: along lines
/// du/sqrt(g_hat), over surfaces (du dv/4)/(pi g_hat).
double trapezoidal(const Contact& c, int n)
{
  const bool line = c.P.round();
  const PairField<double> field(c.P, c.F, line);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = 2.0 * pi * i / n;
    if (!line && field.least(u) > c.g_hat) continue;
    for (int j = 0; j < (line ? 1 : n); ++j) {
      const double g = field.value(u, 2.0 * pi * j / n);
      sum += line ? barrier<1>(g, c.g_hat).b : barrier<2>(g, c.g_hat).b;
    }
  }
  const double h = 2.0 * pi / n;
  return line ? h / std::sqrt(c.g_hat) * sum : 0.25 * h * h / (pi * c.g_hat) * sum;
}

TEST(Quadrature, FineIsTheTrapezoidalRuleOverAnotherDistance)
{
  for (const PairKind kind :
       {PairKind::round_round, PairKind::round_elliptical, PairKind::elliptical_elliptical}) {
    const bool line = kind != PairKind::elliptical_elliptical;
    int compared = 0;
    for (const Contact& c : contacts(kind, 20)) {
      if (!line && c.g_hat < 0.01) continue;  // narrower than what so many places tell
      ++compared;
      const double energy = integral(c, Quadrature::fine, line ? 0.5 : 0.25).energy;
      EXPECT_NEAR(energy / trapezoidal(c, line ? 100000 : 2000), 1.0, 1e-6) << name(kind) << ' ' << c.g_hat;
    }
    EXPECT_GE(compared, 3) << name(kind);
  }
}

/// Errors of energy and force relative to those of panels an eighth as long.
struct Errors {
  Sample energy, force, evaluations;
};

Errors errors(PairKind kind, Quadrature quadrature)
{
  Errors out;
  for (const Contact& c : contacts(kind, 100)) {
    const SideTerms exact = integral(c, Quadrature::fine, 0.125), found = integral(c, quadrature, 0.5);
    out.energy.add(std::abs(found.energy / exact.energy - 1.0));
    out.force.add((found.gradient - exact.gradient).norm() / exact.gradient.norm());
    out.evaluations.add(found.evaluations);
  }
  fmt::print("{}, {}: energy {}\n    force {}\n    evaluations {}\n", name(kind),
             quadrature == Quadrature::fine ? "fine" : "rough", out.energy.summary(), out.force.summary(),
             out.evaluations.summary());
  return out;
}

TEST(Quadrature, IsAsAccurateAsItsNameSays)
{
  for (const PairKind kind : {PairKind::round_round, PairKind::round_elliptical}) {
    Errors fine = errors(kind, Quadrature::fine), rough = errors(kind, Quadrature::rough);
    EXPECT_LT(fine.energy.quantile(1.0), 2e-11);
    EXPECT_LT(rough.energy.quantile(1.0), 2e-7);
    EXPECT_LT(rough.evaluations.mean(), 0.8 * fine.evaluations.mean());
  }
  Errors fine = errors(PairKind::elliptical_elliptical, Quadrature::fine),
         rough = errors(PairKind::elliptical_elliptical, Quadrature::rough);
  EXPECT_LT(fine.energy.quantile(0.5), 2e-7);
  EXPECT_LT(fine.energy.quantile(1.0), 1e-4);
  EXPECT_LT(rough.energy.quantile(0.5), 4e-4);
  EXPECT_LT(rough.energy.quantile(1.0), 2e-2);
  EXPECT_LT(rough.evaluations.mean(), 0.2 * fine.evaluations.mean());
}

}  // namespace
}  // namespace hauberk::brute
