#include "contact/barrier.hpp"
#include "contact/formulation.hpp"
#include "geometry/panel_field.hpp"

#include <hauberk/solid.hpp>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <optional>

namespace hauberk {
namespace {

using std::numbers::pi;

/// Relative radius of curvature that makes sqrt(2 r g) a length of order of the contact zone; it only
/// scales the stiffness, so that the three barriers push alike (see barrier.hpp). Unit: L.
constexpr double reference_radius = 0.5;

/// Surface element du dv in units of L^2, frozen so that parameters act through the gap alone.
constexpr double surface_element = 0.25;
/// The same of the product of two cores.
constexpr double product_element = 1.0;

constexpr double smallest_panel = 1e-12;
/// Evaluations that the integral of one pair is worth, some seconds. Blades, with thousands of radii of
/// curvature around them, would take hours.
constexpr int most_evaluations = 30000000;

template <int n>
struct GaussRule {
  std::array<double, n> x, w;
};

template <int n>
const GaussRule<n>& gauss_rule()
{
  static const GaussRule<n> rule = [] {
    GaussRule<n> r{};
    const auto& a = boost::math::quadrature::gauss<double, n>::abscissa();
    const auto& w = boost::math::quadrature::gauss<double, n>::weights();
    std::size_t k = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      r.x[k] = a[i];
      r.w[k++] = w[i];
      if (a[i] != 0.0) {
        r.x[k] = -a[i];
        r.w[k++] = w[i];
      }
    }
    return r;
  }();
  return rule;
}

/// The rule's places on an interval about `middle`, in pairs on either side of it.
template <int n>
std::array<Angle, n> rule_angles(const Angle& middle, double half)
{
  const auto& x = gauss_rule<n>().x;
  std::array<Angle, n> out;
  std::size_t k = 0;
  if (n % 2 == 1) out[k++] = middle;
  for (; k < n; k += 2) {
    const Angle by(half * x[k]);
    out[k] = middle.turned(by);
    out[k + 1] = middle.turned(by.reversed());
  }
  return out;
}

/// Half-width of the largest panels in each probe coordinate, radians.
constexpr double widest_panel = 0.15;

/// The same of a solid, by the larger of both curvatures and by how fast the surface's changes anywhere.
double solid_level_length(const Body& F, const FieldValue& f)
{
  const double bend = std::max({std::abs(f.m.k), std::abs(f.k_azimuth), 1e-300});
  const double change = F.solid->smoothness().change * F.unit * F.unit;
  // The change C of the curvature k along a surface lets it grow by itself over k/C.
  const double length = 0.2 / bend;
  return std::isfinite(change) && change > 0.0 ? std::min(length, 0.3 / std::sqrt(change)) : length;
}

/// A length over which the curvature of F's field changes little at the place of `f`: a part of
/// the radius of curvature of the level surface, and of the arc of F's profile over which that changes, both
/// seen from where the place is. With w = a^2 sin^2 v + b^2 cos^2 v the curvature a b/w^(3/2) of an ellipse
/// changes over the arc w/sqrt|a^2 - b^2|: its smallest radius at a sharp end, its length along a flat side.
double level_length(const Body& F, const FieldValue& f)
{
  if (F.solid) return solid_level_length(F, f);
  const double radius = 1.0 / std::max(f.m.k, 1e-300);
  double length = 0.2 * radius;
  if (F.is_ellipse()) {
    const double a = F.r0 * f.m.s, b = F.r1 * f.m.c, w = a * a + b * b;
    const double eccentric = std::sqrt(std::abs(F.r0 * F.r0 - F.r1 * F.r1));
    const double closer = f.m.k * f.m.phi < 0.5 ? 1.0 / (1.0 - f.m.k * f.m.phi) : 2.0;  // 1 + kappa phi
    length = std::min(length, 0.15 * closer * w / std::max(eccentric, 1e-300));
  }
  return length;
}

/// A place on a line of integration: the gap less g_hat there, and its derivative.
struct LinePoint {
  double t = 0.0, beyond = 0.0, slope = 0.0;

  bool inside() const { return beyond < 0.0; }
};

/// The cubic through two places with their slopes, over s in [0, 1] from one to the other.
struct LineCubic {
  double c0, c1, c2, c3;

  LineCubic(const LinePoint& a, const LinePoint& b)
  {
    const double h = b.t - a.t, rise = b.beyond - a.beyond;
    c0 = a.beyond;
    c1 = h * a.slope;
    c2 = 3.0 * rise - h * (2.0 * a.slope + b.slope);
    c3 = h * (a.slope + b.slope) - 2.0 * rise;
  }
  double at(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
  double slope(double s) const { return c1 + s * (2.0 * c2 + s * 3.0 * c3); }
  double second(double s) const { return 2.0 * c2 + 6.0 * c3 * s; }
};

/// The root of f in [0, 1], f of different signs there, by Newton steps kept between the ends; to about 1e-6.
template <typename F, typename D>
double root_in_unit(F&& f, D&& derivative)
{
  double low = 0.0, high = 1.0, s = 0.5;
  const bool rises = f(0.0) < f(1.0);
  for (int k = 0; k < 30; ++k) {
    const double value = f(s), d = derivative(s);
    ((value < 0.0) == rises ? low : high) = s;
    double next = d != 0.0 ? s - value / d : -1.0;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - s);
    s = next;
    if (step < 1e-6) break;
  }
  return s;
}

/// Width, in parts of the line, to which the place is found where the barrier sets in: what is cut off is of
/// fourth order in it, as the barrier begins with a third power.
constexpr double onset_width = 1e-4;

/// Where the barrier sets in between a and b, one inside and one not: by cubics through both ends, then by
/// Newton's step from a place so close that what the step leaves is within onset_width. `at` evaluates a
/// place.
template <typename At>
double onset_between(At&& at, LinePoint a, LinePoint b)
{
  const double width = std::abs(b.t - a.t);
  for (;;) {
    const double h = b.t - a.t;
    const LineCubic cubic(a, b);
    const double s =
        root_in_unit([&](double x) { return cubic.at(x); }, [&](double x) { return cubic.slope(x); });
    const LinePoint m = at(a.t + s * h);
    const double step = m.slope != 0.0 ? -m.beyond / m.slope : width;
    // The step leaves g'' step^2/(2 g').
    const double left = std::abs(0.5 * cubic.second(s) / (h * h) * step * step / m.slope);
    if (left < onset_width * width) return std::clamp(m.t + step, std::min(a.t, b.t), std::max(a.t, b.t));
    (m.inside() == a.inside() ? a : b) = m;
    if (std::abs(b.t - a.t) < onset_width * width) return m.t;
  }
}

/// Between a and b, on the same side of the onset and with the gap turning between them: a place on the other
/// side, if the gap gets there.
template <typename At>
std::optional<LinePoint> beyond_turn(At&& at, LinePoint a, LinePoint b)
{
  const double width = std::abs(b.t - a.t);
  while (std::abs(b.t - a.t) > onset_width * width) {
    const LineCubic cubic(a, b);
    const double s =
        root_in_unit([&](double x) { return cubic.slope(x); }, [&](double x) { return cubic.second(x); });
    const LinePoint m = at(a.t + s * (b.t - a.t));
    if (m.inside() != a.inside()) return m;
    // How much further the gap may still go, from its slope there over the rest of the way.
    if (std::abs(m.beyond) > 2.0 * std::abs(m.slope) * std::abs(b.t - a.t)) return std::nullopt;
    ((m.slope < 0.0) == (a.slope < 0.0) ? a : b) = m;
  }
  return std::nullopt;
}

/// Calls piece(from, to) for the parts of a line on which the gap is below g_hat. The barrier is a power of
/// (1 - x) there, and no more than twice differentiable at g_hat: Gauss's rule across that point has an error
/// of 1e-5 of the energy, on the parts up to it one of 1e-7. The line is so short that the gap turns at most
/// once on it.
template <typename At, typename Piece>
void inside_pieces(At&& at, double from, double to, Piece&& piece)
{
  const auto monotone = [&](const LinePoint& a, const LinePoint& b) {
    if (a.inside() == b.inside()) {
      if (a.inside()) piece(a.t, b.t);
      return;
    }
    const double onset = onset_between(at, a, b);
    if (a.inside())
      piece(a.t, onset);
    else
      piece(onset, b.t);
  };
  const LinePoint a = at(from), b = at(to);
  const bool turns = a.inside() == b.inside() &&
                     (a.inside() ? a.slope > 0.0 && b.slope < 0.0 : a.slope < 0.0 && b.slope > 0.0);
  if (turns) {
    if (const auto m = beyond_turn(at, a, b)) {
      monotone(a, *m);
      monotone(*m, b);
      return;
    }
  }
  monotone(a, b);
}

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
        last_(out.evaluations + most_evaluations),
        weight_(share * (dim == 1 ? 1.0 / std::sqrt(2.0 * reference_radius * settings.g_hat)
                                  : (frame.difference != nullptr ? product_element : surface_element) /
                                        (2.0 * pi * reference_radius * settings.g_hat)))
  {
  }

  void run()
  {
    const FirstPanels<dim> first(probe_);
    for (int k = 0; k < FirstPanels<dim>::rows; ++k)
      if (first.meets(k, near_)) visit_all(first.row(k));
    if (request_.points) cluster();
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
    if (++out_.evaluations > last_) too_flat(frame_, "integrals over contacts", most_evaluations);
    poll(settings_.keep_going, out_.evaluations);
    const double g = b.value - probe_.offset - settings_.clearance;
    out_.min_gap = std::min(out_.min_gap, g);
    if (b.bound - probe_.offset - settings_.clearance >= settings_.g_hat) return;
    if (g <= 0.0) return;  // min_gap tells
    const std::array<double, 2> size = sizes(s, q, f, std::min(g, 4.0 * settings_.g_hat));
    if (std::max(size[0], size[1]) > 1.0 && std::max(s.hu, s.hv) > smallest_panel) {
      // Far from contact a bound that is too low is to be raised, by panels that are small in both
      // directions.
      const bool along_u = g < 4.0 * settings_.g_hat ? size[0] >= size[1] : longer_along_u(probe_, s);
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
    if (request_.points) {
      ContactPoint c;
      c.normal = f.n;
      c.on_f = q.on_p - f.m.phi * f.n;
      c.on_p = c.on_f + (g + settings_.clearance) * f.n;
      c.gap = g;
      c.force = -w * b.db;
      nodes_.push_back(c);
    }
  }

  /// Part of a pair's force below which a zone is none: stray nodes at the rim of the range, beyond the width
  /// of the zone that bears the load.
  static constexpr double negligible = 1e-9;

  /// One resultant for each contact zone: nodes are taken by falling force and join the first zone near whose
  /// seed they lie: within a few widths sqrt(2 r g_hat), and no further than g_hat from the plane in which it
  /// touches. Where surfaces conform, a zone bends around a tube and is cut into as many as that takes: a
  /// single resultant would act at a point far from both surfaces.
  void cluster()
  {
    std::stable_sort(nodes_.begin(), nodes_.end(),
                     [](const ContactPoint& a, const ContactPoint& b) { return a.force > b.force; });
    struct Zone {
      ContactPoint seed;
      Vec3 force = Vec3::Zero(), on_p = Vec3::Zero(), on_f = Vec3::Zero();
      double weight = 0.0;
    };
    std::vector<Zone> zones;
    const double width = 4.0 * std::sqrt(2.0 * (frame_.P->R) * settings_.g_hat);
    for (const ContactPoint& c : nodes_) {
      Zone* home = nullptr;
      for (Zone& z : zones) {
        const Vec3 along_f = c.on_f - z.seed.on_f, along_p = c.on_p - z.seed.on_p;
        const double bow =
            std::max(std::abs(along_f.dot(z.seed.normal)), std::abs(along_p.dot(z.seed.normal)));
        if (along_f.norm() < width && bow < settings_.g_hat && z.seed.normal.dot(c.normal) > 0.0) {
          home = &z;
          break;
        }
      }
      if (home == nullptr) {
        zones.push_back({c});
        home = &zones.back();
      }
      home->force += c.force * c.normal;
      home->on_p += c.force * c.on_p;
      home->on_f += c.force * c.on_f;
      home->weight += c.force;
      home->seed.gap = std::min(home->seed.gap, c.gap);
    }
    double total = 0.0;
    for (const Zone& z : zones) total += z.weight;
    for (const Zone& z : zones) {
      if (z.weight <= negligible * total) continue;
      ContactPoint c = z.seed;
      c.force = z.force.norm();
      c.normal = z.force / c.force;
      // Mean points lie inside where the zone bows; along its line of action a force may be moved. The field
      // of a curve is not known.
      c.on_f = z.on_f / z.weight;
      if (frame_.difference == nullptr) c.on_f -= field_at(*frame_.F, c.on_f).m.phi * c.normal;
      c.on_p = c.on_f + (c.gap + settings_.clearance) * c.normal;
      out_.points.push_back(c);
    }
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
