#include "contact/barrier.hpp"
#include "contact/contact_zones.hpp"
#include "contact/formulation.hpp"
#include "contact/line_rule.hpp"
#include "geometry/panel_field.hpp"

#include <algorithm>
#include <utility>

namespace hauberk {
namespace {

using std::numbers::pi;

/// Surface element du dv in units of L^2, frozen so that parameters act through the gap alone.
constexpr double surface_element = 0.25;
/// The same of the product of two cores.
constexpr double product_element = 1.0;

/// `n`: points of the rule along a line of a panel; fewer where the integral is rough.
template <int dim, int n>
class ArcIntegral {
  static constexpr bool rough = n < 7;

 public:
  ArcIntegral(const PairFrame& frame, const ContactSettings& settings, const Request& request, double share,
              const NearPanels& near, SideTerms& out)
      : frame_(frame),
        probe_(frame),
        settings_(settings),
        request_(request),
        near_(near),
        out_(out),
        last_(out.evaluations + most_integral_evaluations),
        weight_(share * (dim == 1 ? 1.0 / std::sqrt(2.0 * reference_radius * settings.g_hat)
                                  : (frame.difference != nullptr ? product_element : surface_element) /
                                        (2.0 * pi * reference_radius * settings.g_hat)))
  {
  }

  void run()
  {
    const FirstPanels<dim> first(probe_, 0.0, Tiling::panels);
    for (int k = 0; k < first.rows(); ++k)
      if (first.meets(k, near_)) visit_all(first.row(k));
    if (request_.points)
      add_contact_zones(frame_, settings_.g_hat, settings_.clearance, std::move(nodes_), out_.points);
  }

 private:
  /// Visits those of the panels, of which places are known and fields are not, that are not known or seen to
  /// be too far away.
  template <std::size_t count>
  void visit_all(std::array<PanelField, count> panels)
  {
    std::array<PanelField*, count> near;
    std::array<PointField, count> points;
    std::size_t found = 0;
    for (PanelField& p : panels) {
      if (!near_.meet(p.s) || beyond_core_tube(p.q.p, probe_.Lu * p.s.hu + probe_.Lv * p.s.hv)) continue;
      near[found] = &p;
      points[found++] = {&p.q.p, &p.f};
    }
    fields_at(*frame_.F, std::span(points).first(found));
    for (std::size_t k = 0; k < found; ++k) visit(*near[k]);
  }

  void visit(const PanelField& p)
  {
    const Panel& s = p.s;
    const ProbePoint& q = p.q;
    const FieldValue& f = p.f;
    const PanelBound b = panel_bound(probe_, s, q, f, settings_.g_hat + probe_.offset + settings_.clearance);
    if (++out_.evaluations > last_) too_flat(frame_, "integrals over contacts", most_integral_evaluations);
    poll(settings_.keep_going, out_.evaluations);
    const double g = b.value - probe_.offset - settings_.clearance;
    out_.min_gap = std::min(out_.min_gap, g);
    if (b.bound - probe_.offset - settings_.clearance >= settings_.g_hat) return;
    if (g <= 0.0) return;  // min_gap tells
    const std::array<double, 2> size = sizes(s, q, f, std::min(g, 4.0 * settings_.g_hat));
    if (std::max(size[0], size[1]) > 1.0 && std::max(s.hu, s.hv) > smallest_part) {
      // Far from contact a bound that is too low is to be raised, by panels that are small in both
      // directions.
      const bool along_u = g < 4.0 * settings_.g_hat ? size[0] >= size[1] : longer_along_u(probe_, p);
      visit_all(located_halves(probe_, p, along_u));
      return;
    }
    // A gap changes by no more than the distance moved. Where an integral over a surface is rough, so it may
    // be across the onset: looking for it on every line would take as long as the integral itself.
    const bool whole = g + probe_.Lu * s.hu + probe_.Lv * s.hv < settings_.g_hat;
    if (whole || (rough && dim == 2))
      integrate(p.u, p.v, s);
    else
      integrate_inside(s);
  }

  /// True where nothing within `reach` of p can be closer to F than g_hat, because the round tube that holds
  /// F's is not: without the distance from an ellipse.
  bool beyond_core_tube(const Vec3& p, double reach) const
  {
    const Body& F = *frame_.F;
    if (!F.is_ellipse()) return false;
    const double across = std::sqrt(p.x() * p.x() + p.y() * p.y()) - F.R;
    const double needed =
        settings_.g_hat + probe_.offset + settings_.clearance + std::max(F.r0, F.r1) + reach;
    return across * across + p.z() * p.z() >= needed * needed;
  }

  /// Half-widths of a panel over the largest that it may have. Along a line the gap is g + g' t + g'' t^2/2,
  /// positive for all t, so that its complex roots, the singularities of the barrier, are sqrt(2 g/g'') away:
  /// where surfaces conform (g'' small) panels are large.
  std::array<double, 2> sizes(const Panel& s, const ProbePoint& q, const FieldValue& f, double g) const
  {
    const SecondDerivatives h = surface_hessian(probe_, q, f);
    const double level = (rough ? 2.0 : 1.0) * level_length(*frame_.F, f);
    const double narrowest = probe_.frequency / widest_panel;
    const auto size = [&](double half, const Vec3& along, double second) {
      return half * std::max({std::sqrt(std::max(second, 0.0) / (2.0 * g)) / settings_.panel_ratio,
                              along.norm() / level, narrowest});
    };
    return {size(s.hu, q.pu, h.uu), dim == 2 ? size(s.hv, q.pv, h.vv) : 0.0};
  }

  /// A place `t` on a line, at the probe coordinates u and v of which the one that varies is t.
  LinePoint line_point(double t, const Angle& u, const Angle& v)
  {
    const ProbePoint q = probe_.at(u, v);
    const FieldValue f = field_at(*frame_.F, q.p);
    ++out_.evaluations;
    return {t, f.m.phi - probe_.offset - settings_.clearance - settings_.g_hat,
            f.n.dot(dim == 2 ? q.pv : q.pu)};
  }

  /// The part of a panel on which the gap is below g_hat; of a surface line by line, whose integrals are
  /// smoother across the lines than the barrier is.
  void integrate_inside(const Panel& s)
  {
    const auto& rule = gauss_rule<n>();
    if constexpr (dim == 1) {
      inside_pieces([this](double u) { return line_point(u, Angle(u), {}); }, s.u - s.hu, s.u + s.hu,
                    [this](double from, double to) {
                      const Panel inside{0.5 * (from + to), 0.0, 0.5 * std::abs(to - from), 0.0};
                      integrate(Angle(inside.u), {}, inside);
                    });
    } else {
      for (std::size_t i = 0; i < n; ++i) {
        const double w = weight_ * s.hu * rule.w[i];
        const Angle at_u(s.u + s.hu * rule.x[i]);
        inside_pieces([&](double v) { return line_point(v, at_u, Angle(v)); }, s.v - s.hv, s.v + s.hv,
                      [&](double from, double to) {
                        const double half = 0.5 * std::abs(to - from);
                        line(at_u, rule_angles<n>(Angle(0.5 * (from + to)), half), w * half);
                      });
      }
    }
  }

  /// Over a panel about (u, v).
  void integrate(const Angle& u, const Angle& v, const Panel& s)
  {
    const std::array<Angle, n> at_u = rule_angles<n>(u, s.hu);
    if constexpr (dim == 1) {
      nodes([&](std::size_t k) { return probe_.at(at_u[k], {}); }, weight_ * s.hu);
    } else {
      const auto& rule = gauss_rule<n>();
      const std::array<Angle, n> at_v = rule_angles<n>(v, s.hv);
      for (std::size_t i = 0; i < n; ++i) line(at_u[i], at_v, weight_ * s.hu * rule.w[i] * s.hv);
    }
  }

  /// Gauss's rule along a line of constant u, with this weight.
  void line(const Angle& u, const std::array<Angle, n>& v, double weight)
  {
    nodes([&](std::size_t k) { return probe_.at(u, v[k]); }, weight);
  }

  /// Gauss's rule, its places by `at`.
  template <typename At>
  void nodes(At&& at, double weight)
  {
    std::array<ProbePoint, n> q;
    std::array<FieldValue, n> f;
    std::array<PointField, n> points;
    for (std::size_t k = 0; k < n; ++k) {
      q[k] = at(k);
      points[k] = {&q[k].p, &f[k]};
    }
    fields_at(*frame_.F, points);
    for (std::size_t k = 0; k < n; ++k) node(q[k], f[k], weight * gauss_rule<n>().w[k]);
  }

  void node(const ProbePoint& q, const FieldValue& f, double w)
  {
    ++out_.evaluations;
    const double g = f.m.phi - probe_.offset - settings_.clearance;
    out_.min_gap = std::min(out_.min_gap, g);
    if (g <= 0.0 || g >= settings_.g_hat) return;
    const BarrierValue b = barrier<dim>(g, settings_.g_hat);
    out_.energy += w * b.b;
    if (request_.order >= 1) out_.add(f, q.on_p - frame_.o, w * b.db, w * b.ddb, request_.order);
    if (request_.parameters) out_.template add_parameters<dim>(frame_, f, q, w * b.db);
    if (request_.points) nodes_.push_back(zone_node(q, f, g, settings_.clearance, -w * b.db));
  }

  const PairFrame& frame_;
  Probe<dim> probe_;
  const ContactSettings& settings_;
  const Request& request_;
  const NearPanels& near_;
  SideTerms& out_;
  int last_;  ///< evaluation after which to give up
  double weight_;
  std::vector<ContactPoint> nodes_;
};

}  // namespace

template <int dim>
void add_arc(const PairFrame& frame, const ContactSettings& settings, const Request& request, double share,
             const NearPanels& near, SideTerms& out)
{
  if (settings.quadrature == Quadrature::rough)
    ArcIntegral<dim, dim == 1 ? 6 : 3>(frame, settings, request, share, near, out).run();
  else
    ArcIntegral<dim, dim == 1 ? 9 : 7>(frame, settings, request, share, near, out).run();
}

template void add_arc<1>(const PairFrame&, const ContactSettings&, const Request&, double, const NearPanels&,
                         SideTerms&);
template void add_arc<2>(const PairFrame&, const ContactSettings&, const Request&, double, const NearPanels&,
                         SideTerms&);

}  // namespace hauberk
