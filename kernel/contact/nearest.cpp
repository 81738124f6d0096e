#include "contact/barrier.hpp"
#include "contact/formulation.hpp"
#include "geometry/panel_field.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace hauberk {
namespace {

using std::numbers::pi;

/// Panels this small hold one minimum or a merge whose depth is below rounding (depth ~ h^4).
constexpr double merge_width = 1e-4;  // radians

/// Half-width from which a Newton iteration decides what a surface panel holds.
constexpr double seed_width = 0.06;  // L

/// Evaluations that the minima of one pair are worth. Blades, with thousands of radii of curvature around
/// them, or tubes that are thousands of times as tall as wide, would take hours; nothing wrong is said about
/// them instead.
constexpr int most_evaluations = 20000000;

/// Slope at which a descent has arrived (rounding).
constexpr double smallest_slope = 2e-16;

/// Surfaces that lie flat upon each other, or coaxial, have no curvature along which they could be nearest:
/// rounding may give it this size (1/L) and any sign. One such place is found on each panel.
constexpr double flat = 1e-12;
/// Distances of such places that differ by less are those of one circle or face.
constexpr double same_distance = 1e-12;

/// Minima closer than this are the same one found from two panels.
constexpr double same_minimum = 1e-5;  // radians

/// Smallest profile radius of curvature: bounds the meridian curvature k <= 1/(r + phi).
double smallest_radius(const Body& b) { return std::min(b.r0 * b.r0 / b.r1, b.r1 * b.r1 / b.r0); }

/// Value and derivatives of the field along the probe set: gradient and Hessian in (u, v).
struct Local {
  ProbePoint q;
  FieldValue f;
  double gu = 0, gv = 0, huu = 0, huv = 0, hvv = 0;
};

template <int dim>
Local local_of(const Probe<dim>& probe, const ProbePoint& q, const FieldValue& f)
{
  Local l;
  l.q = q;
  l.f = f;
  l.gu = l.f.n.dot(l.q.pu);
  const Vec3 Ku = field_hessian(l.f, l.q.pu);
  const SecondDerivatives own = probe.second(l.q, l.f.n);
  l.huu = Ku.dot(l.q.pu) + own.uu;
  if constexpr (dim == 2) {
    l.gv = l.f.n.dot(l.q.pv);
    l.huv = Ku.dot(l.q.pv) + own.uv;
    l.hvv = field_hessian(l.f, l.q.pv).dot(l.q.pv) + own.vv;
  }
  return l;
}

template <int dim>
Local local_at(const Probe<dim>& probe, double u, double v)
{
  const ProbePoint q = probe.at(u, v);
  return local_of(probe, q, field_at(*probe.f.F, q.p));
}

double wrapped(double angle) { return std::remainder(angle, 2.0 * pi); }

void insert(std::vector<Minimum>& minima, const Minimum& m)
{
  for (const Minimum& o : minima) {
    if (std::abs(wrapped(o.u - m.u)) < same_minimum && std::abs(wrapped(o.v - m.v)) < same_minimum) return;
  }
  minima.push_back(m);
}

/// The one of the coordinates of a folded probe's point whose v, or u of dimension 1, is in [0, pi].
template <int dim>
Minimum unfolded(Fold fold, Minimum m)
{
  double& turned = dim == 1 ? m.u : m.v;
  turned = wrapped(turned);
  if (turned >= 0.0) return m;
  turned = -turned;
  if (fold == Fold::pole) m.u = wrapped(m.u + pi);
  return m;
}

/// Finds all minima by subdivision.
template <int dim>
class StationarySearch {
 public:
  StationarySearch(const PairFrame& frame, double threshold, const NearPanels& near,
                   std::vector<Minimum>& out, int& evaluations, const std::function<bool()>* keep_going)
      : probe_(frame),
        keep_going_(keep_going),
        near_(with_basins(near)),
        threshold_(threshold + probe_.offset),
        out_(out),
        evaluations_(evaluations),
        last_(evaluations + most_evaluations),
        rf_(frame.difference != nullptr ? frame.difference->tightest_bend() : smallest_radius(*frame.F)),
        rp_(frame.P->curve ? frame.P->curve->tightest_bend() : smallest_radius(*frame.P))
  {
  }

  void run()
  {
    // Turned by an arbitrary angle so that symmetric scenes have no minimum on a panel's end.
    constexpr double turn = 0.1234;
    const FirstPanels<dim> first(probe_, turn);
    for (int k = 0; k < first.rows(); ++k)
      if (first.meets(k, near_)) visit_all(first.row(k));
  }

 private:
  /// Where minima in range are sought from: a descent may find one that lies in a neighbour of its own panel,
  /// which is at most as wide as this.
  NearPanels with_basins(const NearPanels& near) const
  {
    if constexpr (dim == 1) return near;
    return near.widened(2.0 * seed_width / probe_.Lu, 2.0 * seed_width / probe_.Lv);
  }

  /// Visits those of the panels, of which places are known and fields are not, that may be in range.
  template <std::size_t count>
  void visit_all(std::array<PanelField, count> panels)
  {
    for (PanelField& p : fields_of_near(*probe_.f.F, near_, panels)) visit(p);
  }

  void visit(PanelField& p)
  {
    if (++evaluations_ > last_) too_flat(probe_.f, "closest points", most_evaluations);
    poll(keep_going_, evaluations_);
    if (bound_of(probe_, p, threshold_).bound >= threshold_) return;
    const Panel s = p.near();
    const double d = probe_.Lu * s.hu + probe_.Lv * s.hv;
    const Local l = local_of(probe_, p.q, p.f);
    // Largest curvature of the field on the panel.
    const FieldCurvature field = field_curvature(*probe_.f.F, l.f, d);
    if (field.second < std::numeric_limits<double>::infinity()) {
      const double k = field.second;
      const double uu = probe_.Lu * probe_.Lu * k + probe_.Luu;
      if constexpr (dim == 1) {
        if (std::abs(l.gu) > uu * s.hu) return;
        const double third =
            probe_.Lu * (probe_.Lu * probe_.Lu * field.third + 3.0 * probe_.Luu * k) + probe_.Luuu;
        if (std::abs(l.huu) > third * s.hu) {
          bracket(s);
          return;
        }
      } else {
        const double uv = probe_.Lu * probe_.Lv * k + probe_.Luv;
        const double vv = probe_.Lv * probe_.Lv * k + probe_.Lvv;
        if (std::abs(l.gu) > uu * s.hu + uv * s.hv || std::abs(l.gv) > uv * s.hu + vv * s.hv) return;
      }
    }
    // Deep inside F, beyond its medial axis, no curvature bound exists: small panels decide by themselves.
    if constexpr (dim == 1) {
      if (s.hu < merge_width) {
        bracket_fold(s);
        return;
      }
    } else if (std::max(probe_.Lu * s.hu, probe_.Lv * s.hv) < seed(l)) {
      descend(s, l);
      return;
    }
    visit_all(located_halves(probe_, p, longer_along_u(probe_, p)));
  }

  Minimum canonical(const Minimum& m) const
  {
    const Body& P = *probe_.f.P;
    return P.solid && P.solid->fold() != Fold::none ? unfolded<dim>(P.solid->fold(), m) : m;
  }

  /// Panels this small hold at most one basin, or one that starts from a neighbour: the smallest radius of
  /// curvature of either surface.
  double seed(const Local& l) const
  {
    const double of_field = probe_.f.difference != nullptr ? rf_ : rf_ + std::max(l.f.m.phi, 0.0);
    const double radius = std::min({rp_, of_field, l.f.rho});
    return std::max(std::min(seed_width, radius), 1e-3);
  }

  /// Dimension 1: the second derivative keeps its sign on the panel, so it holds a minimum exactly when
  /// the first derivative changes from negative to positive.
  void bracket(const Panel& s)
  {
    double lo = s.u - s.hu * (1.0 + 1e-9), hi = s.u + s.hu * (1.0 + 1e-9);
    const Local first = local_at(probe_, lo, 0.0), last = local_at(probe_, hi, 0.0);
    evaluations_ += 2;
    refine(lo, hi, first, last);
  }

  /// A panel too small to be split whose second derivative changes its sign: a minimum and a maximum that are
  /// about to meet leave no change of sign of the slope between its ends, but one on either side of its
  /// turning point.
  void bracket_fold(const Panel& s)
  {
    const double lo = s.u - s.hu * (1.0 + 1e-9), hi = s.u + s.hu * (1.0 + 1e-9);
    const Local first = local_at(probe_, lo, 0.0), last = local_at(probe_, hi, 0.0);
    evaluations_ += 2;
    const bool same_sign = (first.gu < 0.0) == (last.gu < 0.0), turns = (first.huu < 0.0) != (last.huu < 0.0);
    if (!same_sign || !turns) return refine(lo, hi, first, last);
    const double turn = lo + (hi - lo) * first.huu / (first.huu - last.huu);
    const Local middle = local_at(probe_, turn, 0.0);
    ++evaluations_;
    refine(lo, turn, first, middle);
    refine(turn, hi, middle, last);
  }

  /// The minimum between lo and hi, if the slope rises through zero there.
  void refine(double lo, double hi, const Local& first, const Local& last)
  {
    const double glo = first.gu, ghi = last.gu, width = 0.5 * (hi - lo);
    if (!(glo < 0.0 && ghi >= 0.0)) return;
    double u = lo + (hi - lo) * glo / (glo - ghi);
    Local l = local_at(probe_, u, 0.0);
    for (int it = 0; it < 60; ++it) {
      ++evaluations_;
      (l.gu < 0.0 ? lo : hi) = u;
      double next = u - l.gu / l.huu;
      if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
      const double step = std::abs(next - u);
      u = next;
      l = local_at(probe_, u, 0.0);
      if (step < 1e-9 * width + 1e-15 || hi - lo < 4e-16) break;
    }
    if (l.f.m.phi < threshold_) insert(out_, canonical({u, 0.0, l.f.m.phi - probe_.offset}));
  }

  /// Dimension 2: descends from the centre by damped Newton steps to the minimum whose basin holds it.
  void descend(const Panel& s, Local l)
  {
    const double su = probe_.Lu, sv = probe_.Lv;  // scaled coordinates
    double u = s.u, v = s.v;
    for (int it = 0; it < 60; ++it) {
      const double a = l.huu / (su * su), b = l.huv / (su * sv), c = l.hvv / (sv * sv);
      const double mean = 0.5 * (a + c), dev = std::hypot(0.5 * (a - c), b), lowest = mean - dev;
      const double gx = l.gu / su, gy = l.gv / sv, slope = std::hypot(gx, gy);
      const double shift = lowest > 1e-9 ? 0.0 : 1e-2 - lowest;
      const double A = a + shift, C = c + shift, det = A * C - b * b;
      double dx = -(C * gx - b * gy) / det, dy = -(A * gy - b * gx) / det;
      const double size = std::hypot(dx, dy);
      if (slope < smallest_slope || (size < 1e-12 && shift == 0.0)) {
        if (lowest > -flat && l.f.m.phi < threshold_)
          insert(out_, canonical({u, v, l.f.m.phi - probe_.offset, lowest <= flat}));
        return;
      }
      if (size > 2.0 * seed_width) {
        dx *= 2.0 * seed_width / size;
        dy *= 2.0 * seed_width / size;
      }
      bool lower = false;
      for (double t = 1.0; t > 1e-4 && !lower; t *= 0.5) {
        const Local n = local_at(probe_, u + t * dx / su, v + t * dy / sv);
        ++evaluations_;
        // Below rounding of the distance the slope decides.
        lower = n.f.m.phi < l.f.m.phi ||
                (n.f.m.phi < l.f.m.phi + 1e-14 && std::hypot(n.gu / su, n.gv / sv) < slope);
        if (!lower) continue;
        u += t * dx / su;
        v += t * dy / sv;
        l = n;
      }
      if (!lower) {
        // Inside of F the distance has ridges, where nothing is deeper beside them and no slope ends.
        const bool ends = (slope < 1e-10 && lowest > -flat) || l.f.m.phi < 0.0;
        if (ends && l.f.m.phi < threshold_)
          insert(out_, canonical({u, v, l.f.m.phi - probe_.offset, lowest <= flat}));
        return;
      }
    }
  }

  Probe<dim> probe_;
  const std::function<bool()>* keep_going_;
  NearPanels near_;
  double threshold_;
  std::vector<Minimum>& out_;
  int& evaluations_;
  int last_;  ///< evaluation after which to give up
  double rf_, rp_;
};

}  // namespace

void too_flat(const PairFrame& frame, const char* what, long evaluations)
{
  const Body &P = *frame.P, &F = *frame.F;
  throw ComputationError(fmt::format(
      "{} of elements {} and {} take more than {} evaluations: their cross-sections are too flat for their "
      "size (r1/r0 {:.3g} and {:.3g})",
      what, P.element, F.element, evaluations, P.r1 / P.r0, F.r1 / F.r0));
}

template <int dim>
std::vector<Minimum> local_minima(const PairFrame& frame, double threshold, int& evaluations,
                                  const NearPanels& near, const std::function<bool()>* keep_going)
{
  std::vector<Minimum> minima;
  StationarySearch<dim>(frame, threshold, near, minima, evaluations, keep_going).run();
  std::sort(minima.begin(), minima.end(),
            [](const Minimum& a, const Minimum& b) { return a.distance < b.distance; });
  return minima;
}

template <int dim>
void add_nearest(const PairFrame& frame, const ContactSettings& settings, const Request& request,
                 const NearPanels& near, SideTerms& out)
{
  const Probe<dim> probe(frame);
  double of_flat = -std::numeric_limits<double>::infinity();
  for (const Minimum& m : local_minima<dim>(frame, settings.g_hat + settings.clearance, out.evaluations, near,
                                            settings.keep_going)) {
    // Of a circle or a face one place stands for the others: their number is that of panels.
    if (m.flat && m.distance - of_flat < same_distance) continue;
    if (m.flat) of_flat = m.distance;
    const double g = m.distance - settings.clearance;
    out.min_gap = std::min(out.min_gap, g);
    if (g <= 0.0) continue;
    const Local l = local_at(probe, m.u, m.v);
    const BarrierValue b = barrier<0>(g, settings.g_hat);
    out.energy += b.b;
    const Vec3 rho = l.q.on_p - frame.o;
    if (request.order >= 1) out.add(l.f, rho, b.db, b.ddb, request.order);
    if (request.order >= 2) {
      const Vec6 xu = gradient_along(l.f, rho, l.q.pu, true);
      // Of curves, whose speed changes along them, it is that of the place.
      const bool place = frame.P->curve || frame.P->solid;
      constexpr double slowest = 1e-3;  // of a solid, whose probe stands still at poles and ends
      const double speed_u = place ? std::max(l.q.pu.norm(), slowest * probe.Lu) : probe.Lu;
      const double speed_v = frame.difference != nullptr ? l.q.pv.norm()
                             : frame.P->solid            ? std::max(l.q.pv.norm(), slowest * probe.Lv)
                                                         : probe.Lv;
      if constexpr (dim == 1) {
        if (l.huu > 0.0) out.hessian.noalias() -= (b.db / l.huu) * xu * xu.transpose();
        out.regularity = std::min(out.regularity, l.huu / (speed_u * speed_u));
      } else {
        // On a difference v moves no point of P.
        const Vec6 xv = gradient_along(l.f, rho, l.q.pv, frame.difference == nullptr);
        const double det = l.huu * l.hvv - l.huv * l.huv;
        if (det > 0.0) {
          out.hessian.noalias() -= (b.db / det) * (l.hvv * xu * xu.transpose() + l.huu * xv * xv.transpose() -
                                                   l.huv * (xu * xv.transpose() + xv * xu.transpose()));
        }
        const double a = l.huu / (speed_u * speed_u), c = l.hvv / (speed_v * speed_v);
        const double o = l.huv / (speed_u * speed_v);
        out.regularity = std::min(out.regularity, 0.5 * (a + c) - std::hypot(0.5 * (a - c), o));
      }
    }
    if (request.parameters) out.template add_parameters<dim>(frame, l.f, l.q, b.db);
    if (request.points) {
      ContactPoint c;
      c.normal = l.f.n;
      c.on_f = l.q.on_p - l.f.m.phi * l.f.n;
      c.on_p = l.q.on_p - probe.offset * l.f.n;
      c.gap = g;
      c.force = -b.db;
      out.points.push_back(c);
    }
  }
}

template std::vector<Minimum> local_minima<1>(const PairFrame&, double, int&, const NearPanels&,
                                              const std::function<bool()>*);
template std::vector<Minimum> local_minima<2>(const PairFrame&, double, int&, const NearPanels&,
                                              const std::function<bool()>*);
template void add_nearest<1>(const PairFrame&, const ContactSettings&, const Request&, const NearPanels&,
                             SideTerms&);
template void add_nearest<2>(const PairFrame&, const ContactSettings&, const Request&, const NearPanels&,
                             SideTerms&);

}  // namespace hauberk
