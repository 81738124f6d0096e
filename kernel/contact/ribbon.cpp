#include "contact/barrier.hpp"
#include "contact/contact_zones.hpp"
#include "contact/formulation.hpp"
#include "contact/line_rule.hpp"
#include "geometry/panel_field.hpp"

#include <algorithm>
#include <utility>

namespace hauberk {
namespace {

/// A place of the ribbon.
struct RibbonPoint {
  Angle u, v;
  ProbePoint q;
  FieldValue f;
  SecondDerivatives h;

  /// dv/du along the ribbon, where phi_v = 0.
  double slope() const { return h.vv > 0.0 ? -h.uv / h.vv : 0.0; }
  /// Second derivative of the gap along the ribbon.
  double second() const { return h.vv > 0.0 ? h.uu - h.uv * h.uv / h.vv : h.uu; }
};

/// `points`: of Gauss's rule, as many as an integral along a core has.
template <int points>
class RibbonIntegral {
 public:
  RibbonIntegral(const PairFrame& frame, const ContactSettings& settings, const Request& request,
                 double share, const NearPanels& near, SideTerms& out)
      : frame_(frame),
        probe_(frame),
        settings_(settings),
        request_(request),
        near_(near),
        out_(out),
        last_(out.evaluations + most_integral_evaluations),
        weight_(share / std::sqrt(2.0 * reference_radius * settings.g_hat))
  {
  }

  void run()
  {
    const FirstPanels<2> first(probe_);
    for (int k = 0; k < first.rows(); ++k)
      if (first.meets(k, near_)) visit_all(first.row(k));
    if (request_.points)
      add_contact_zones(frame_, settings_.g_hat, settings_.clearance, std::move(nodes_), out_.points);
  }

 private:
  template <std::size_t count>
  void visit_all(std::array<PanelField, count> strips)
  {
    for (PanelField& p : fields_of_near(*frame_.F, near_, strips)) visit(p);
  }

  double gap(const FieldValue& f) const { return f.m.phi - settings_.clearance; }

  void visit(PanelField& p)
  {
    if (++out_.evaluations > last_) too_flat(frame_, "integrals over contacts", most_integral_evaluations);
    poll(settings_.keep_going, out_.evaluations);
    out_.min_gap = std::min(out_.min_gap, gap(p.f));
    if (bound_of(probe_, p, settings_.g_hat + settings_.clearance).bound - settings_.clearance >=
        settings_.g_hat)
      return;
    if (gap(p.f) <= 0.0) return;  // min_gap tells
    RibbonPoint middle{p.u, p.v, p.q, p.f, surface_hessian(probe_, p.q, p.f)};
    settle(std::span(&middle, 1));
    const double g = gap(middle.f);
    out_.min_gap = std::min(out_.min_gap, g);
    if (g <= 0.0) return;
    if (size(p.s, middle, std::min(g, 4.0 * settings_.g_hat)) > 1.0 && p.s.hu > smallest_part) {
      visit_all(located_halves(probe_, p, true));
      return;
    }
    const double from = p.s.u - p.s.hu, to = p.s.u + p.s.hu;
    // A gap changes by no more than the distance moved.
    if (g + probe_.Lu * p.s.hu < settings_.g_hat) {
      integrate(middle, p.s.u, from, to);
      return;
    }
    inside_pieces([&](double u) { return line_point(middle, p.s.u, u); }, from, to,
                  [&](double a, double b) { integrate(middle, p.s.u, std::min(a, b), std::max(a, b)); });
  }

  /// Half-width of a strip over the largest that it may have, see ArcIntegral.
  double size(const Panel& s, const RibbonPoint& m, double g) const
  {
    const double level = (points < 9 ? 2.0 : 1.0) * level_length(*frame_.F, m.f);
    const Vec3 along = m.q.pu + m.slope() * m.q.pv;
    return s.hu * std::max({std::sqrt(std::max(m.second(), 0.0) / (2.0 * g)) / settings_.panel_ratio,
                            along.norm() / level, probe_.frequency / widest_panel});
  }

  /// Where the ribbon is at u, to first order from its place at `at`.
  RibbonPoint guess(const RibbonPoint& middle, double at, double u) const
  {
    RibbonPoint r;
    r.u = Angle(u);
    r.v = middle.v.turned(std::clamp(middle.slope() * (u - at), -longest_turn, longest_turn));
    return r;
  }

  /// The field and its second derivatives at these places, at most `points`.
  void look(std::span<RibbonPoint*> places)
  {
    std::array<PointField, points> fields;
    for (std::size_t k = 0; k < places.size(); ++k) {
      places[k]->q = probe_.at(places[k]->u, places[k]->v);
      fields[k] = {&places[k]->q.p, &places[k]->f};
    }
    fields_at(*frame_.F, std::span(fields).first(places.size()));
    for (RibbonPoint* r : places) r->h = surface_hessian(probe_, r->q, r->f);
    out_.evaluations += static_cast<int>(places.size());
  }

  /// Turns these places, which have been looked at, around their cross-sections to where the gap is
  /// stationary: by Newton's method, downhill where it is not convex.
  void settle(std::span<RibbonPoint> places)
  {
    std::array<RibbonPoint*, points> moving;
    for (int step = 0; step < most_steps; ++step) {
      std::size_t count = 0;
      for (RibbonPoint& r : places) {
        const double slope = r.f.n.dot(r.q.pv);
        const double turn = r.h.vv > 0.0 ? std::clamp(-slope / r.h.vv, -longest_turn, longest_turn)
                                         : std::copysign(longest_turn, -slope);
        if (std::abs(turn) < settled) continue;
        r.v = r.v.turned(turn);
        moving[count++] = &r;
      }
      if (count == 0) return;
      look(std::span(moving).first(count));
    }
  }

  LinePoint line_point(const RibbonPoint& middle, double at, double u)
  {
    RibbonPoint r = guess(middle, at, u);
    RibbonPoint* one = &r;
    look(std::span(&one, 1));
    settle(std::span(&r, 1));
    return {u, gap(r.f) - settings_.g_hat, r.f.n.dot(r.q.pu)};
  }

  /// Gauss's rule from one u to another.
  void integrate(const RibbonPoint& middle, double at, double from, double to)
  {
    const double half = 0.5 * (to - from);
    const auto& rule = gauss_rule<points>();
    std::array<RibbonPoint, points> nodes;
    std::array<RibbonPoint*, points> all;
    for (std::size_t k = 0; k < points; ++k) {
      nodes[k] = guess(middle, at, 0.5 * (from + to) + half * rule.x[k]);
      all[k] = &nodes[k];
    }
    look(all);
    settle(nodes);
    for (std::size_t k = 0; k < points; ++k) add(nodes[k], weight_ * half * rule.w[k]);
  }

  /// The gap's derivatives in the relative motion are those at fixed probe coordinates, but that v follows.
  void add(const RibbonPoint& r, double w)
  {
    const double g = gap(r.f);
    out_.min_gap = std::min(out_.min_gap, g);
    if (g <= 0.0 || g >= settings_.g_hat) return;
    const BarrierValue b = barrier<1>(g, settings_.g_hat);
    out_.energy += w * b.b;
    const Vec3 rho = r.q.on_p - frame_.o;
    if (request_.order >= 1) out_.add(r.f, rho, w * b.db, w * b.ddb, request_.order);
    if (request_.order >= 2 && r.h.vv > 0.0) {
      const Vec6 x = gradient_along(r.f, rho, r.q.pv, true);
      const double by = w * b.db / r.h.vv;
      for (int j = 0; j < 6; ++j)
        for (int i = j; i < 6; ++i) out_.hessian(i, j) -= by * x[i] * x[j];
    }
    if (request_.parameters) out_.template add_parameters<2>(frame_, r.f, r.q, w * b.db);
    if (request_.points) nodes_.push_back(zone_node(r.q, r.f, g, settings_.clearance, -w * b.db));
  }

  /// Radians: the longest turn of one step around a cross-section, and the step that is not taken any more.
  static constexpr double longest_turn = 0.5, settled = points < 9 ? 1e-4 : 1e-6;
  static constexpr int most_steps = 12;

  const PairFrame& frame_;
  Probe<2> probe_;
  const ContactSettings& settings_;
  const Request& request_;
  const NearPanels& near_;
  SideTerms& out_;
  int last_;  ///< evaluation after which to give up
  double weight_;
  std::vector<ContactPoint> nodes_;
};

}  // namespace

void add_ribbon(const PairFrame& frame, const ContactSettings& settings, const Request& request, double share,
                const NearPanels& near, SideTerms& out)
{
  if (settings.quadrature == Quadrature::rough)
    RibbonIntegral<6>(frame, settings, request, share, near, out).run();
  else
    RibbonIntegral<9>(frame, settings, request, share, near, out).run();
}

}  // namespace hauberk
