#pragma once
/// Bounds over single panels against samples.

#include "drawn_pairs.hpp"
#include "geometry/panel_bound.hpp"
#include "pair_field.hpp"
#include "statistics.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace hauberk::brute {

/// Least of the field over a panel by samples, border and corners included.
inline double least_on(const PairField<double>& field, const Panel& s, int nu, int nv)
{
  double least = 1e300;
  for (int i = 0; i <= nu; ++i) {
    for (int j = 0; j <= nv; ++j) {
      const double x = 2.0 * i / nu - 1.0, y = nv > 0 ? 2.0 * j / nv - 1.0 : 0.0;
      least = std::min(least, field.value(s.u + x * s.hu, s.v + y * s.hv));
    }
  }
  return least;
}

struct PanelFigures {
  long panels = 0, curved = 0, sharper = 0;
  Sample first, third;  // what is lost of the bound, relative to the largest drop possible (Lipschitz)
};

/// Both bounds over a panel of P, which is the torus p.a, in the field of F, which is p.b, against samples of
/// a field that the kernel has no part in.
template <int dim>
void check_panel(const DrawnPair& p, const Body& P, const Body& F, const Panel& s, PanelFigures& figures,
                 const std::string& what)
{
  const PairFrame frame(P, kernel_pose(p.a), F, kernel_pose(p.b));
  const Probe<dim> probe(frame);
  const ProbePoint q = probe.at(s.u, s.v);
  const FieldValue f = field_at(F, q.p);
  if (f.m.phi <= 0.0) return;
  const PairField<double> field(p.a, p.b, dim == 1);
  const double offset = dim == 1 ? p.a.r0 : 0.0;
  const double least = least_on(field, s, dim == 1 ? 400 : 24, dim == 1 ? 0 : 24) + offset;
  const double gu = f.n.dot(q.pu), gv = dim == 2 ? f.n.dot(q.pv) : 0.0;
  const double taylor = taylor_bound(probe, s, f.m.phi, f.rho, gu, gv) - f.doubt;
  constexpr double rounding = 1e-14;
  EXPECT_LE(taylor, least + rounding) << what;
  const double size = panel_size(probe, s).first;
  ++figures.panels;
  figures.first.add((least - taylor) / size);
  const FieldCurvature curvature = field_curvature(F, f, size);
  if (!(curvature.third < std::numeric_limits<double>::infinity())) return;
  const double curved = curved_bound(probe, s, q, f, curvature);
  EXPECT_LE(curved, least + rounding) << what;
  ++figures.curved;
  figures.sharper += curved > taylor;
  figures.third.add((least - std::max(curved, taylor)) / size);
}

}  // namespace hauberk::brute
