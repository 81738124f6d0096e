#pragma once
/// Panels with the field at their centres: what every search over a probe set looks at, some at a time.
///
/// The distance from an ellipse is an iteration whose operations wait for each other; for several points at
/// once it takes little longer than for one. So centres are looked at in groups: the first panels row by row,
/// later ones with the other half of what was split.

#include "geometry/panel_bound.hpp"
#include "geometry/strip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace hauberk {

/// A panel, its centre by angle and place, and the field there. Of a strip the centre is where its
/// cross-section is looked at, and `half` of its window as far as it is known.
struct PanelField {
  Panel s;
  Angle u, v;
  ProbePoint q;
  FieldValue f;
  double half = all_around;

  /// The part of the panel that may be near.
  Panel near() const { return is_strip(s) ? Panel{s.u, s.v, s.hu, half} : s; }
};

/// An angle in [0, 2 pi].
inline double in_turn(double angle)
{
  return angle - 2.0 * std::numbers::pi * std::floor(angle / (2.0 * std::numbers::pi));
}

constexpr std::size_t most_together = 4;  ///< fields that are looked at in one go

/// The field of a body for these panels, at most `most_together`, whose places `q` are known.
inline void fill_fields(const Body& F, std::span<PanelField> panels)
{
  if (!F.is_ellipse()) {
    for (PanelField& p : panels) p.f = field_at(F, p.q.p);
    return;
  }
  std::array<PointField, most_together> points;
  for (std::size_t k = 0; k < panels.size(); ++k) points[k] = {&panels[k].q.p, &panels[k].f};
  fields_at(F, std::span(points).first(panels.size()));
}

/// The part of a probe set that may be in range; without panels nothing is known, and all of it may. Angles
/// of both are in [0, 3 pi].
class NearPanels {
 public:
  NearPanels() = default;
  explicit NearPanels(std::vector<Panel> panels) : panels_(std::move(panels)) {}

  /// True where some of panel s may be in range.
  bool meet(const Panel& s) const
  {
    // Widened by rounding, so that what only touches counts as well.
    constexpr double rounding = 1e-12;
    const auto apart = [](double x, double y) {
      const double d = std::abs(x - y);
      return d > std::numbers::pi ? std::abs(2.0 * std::numbers::pi - d) : d;
    };
    return panels_.empty() || std::any_of(panels_.begin(), panels_.end(), [&](const Panel& p) {
             return apart(p.u, s.u) <= p.hu + s.hu + rounding && apart(p.v, s.v) <= p.hv + s.hv + rounding;
           });
  }

  /// With all that is within these half-widths of it.
  NearPanels widened(double by_u, double by_v) const
  {
    NearPanels out = *this;
    for (Panel& p : out.panels_) {
      p.hu += by_u;
      p.hv += by_v;
    }
    return out;
  }

 private:
  std::vector<Panel> panels_;
};

/// How a probe set of dimension 2 is divided at first: where there are strips, into strips or not.
enum class Tiling { strips, panels };

/// Those of the panels, of which places are known and fields are not, that may be in range, with their
/// fields, in front of the others.
inline std::span<PanelField> fields_of_near(const Body& F, const NearPanels& near,
                                            std::span<PanelField> panels)
{
  std::size_t found = 0;
  for (const PanelField& p : panels)
    if (near.meet(p.s)) panels[found++] = p;
  fill_fields(F, panels.first(found));
  return panels.first(found);
}

/// The first panels of a search, four at a time; from `turn` on, radians.
template <int dim>
class FirstPanels {
 public:
  explicit FirstPanels(const Probe<dim>& probe, double turn = 0.0, Tiling tiling = Tiling::strips)
      : probe_(probe),
        turn_(turn),
        across_(dim == 1 || (tiling == Tiling::strips && has_strips(probe.f)) ? 1 : most_across)
  {
    for (int j = 0; across_ > 1 && j < across_; ++j) v_[j] = Angle(center(j, across_));
  }

  int rows() const { return along * across_ / static_cast<int>(most_together); }

  /// True where some of row k may be in range.
  bool meets(int k, const NearPanels& near) const
  {
    for (std::size_t j = 0; j < most_together; ++j)
      if (near.meet(panel(k, static_cast<int>(j)))) return true;
    return false;
  }

  /// Row k, with places and without fields.
  std::array<PanelField, most_together> row(int k) const
  {
    std::array<PanelField, most_together> out;
    for (std::size_t j = 0; j < out.size(); ++j) {
      PanelField& p = out[j];
      p.s = panel(k, static_cast<int>(j));
      p.u = j > 0 && across_ > 1 ? out[0].u : Angle(p.s.u);
      if constexpr (dim == 2) {
        if (across_ == 1) p.s.v = in_turn(facing_angle(probe_.f, p.u));
        p.v = across_ == 1 ? Angle(p.s.v) : v_[j];
      }
      p.q = probe_.at(p.u, p.v);
    }
    return out;
  }

 private:
  static constexpr int along = 8, most_across = 4;

  Panel panel(int k, int j) const
  {
    constexpr double half = std::numbers::pi / along;
    if (across_ > 1) return {center(k, along), center(j, across_), half, std::numbers::pi / across_};
    return {center(static_cast<int>(most_together) * k + j, along), 0.0, half, dim == 1 ? 0.0 : all_around};
  }
  double center(int i, int count) const { return turn_ + (2 * i + 1) * std::numbers::pi / count; }

  const Probe<dim>& probe_;
  double turn_;
  int across_;
  std::array<Angle, most_across> v_;
};

/// How far from where a strip is looked at its nearest place is, at `by` from its centre in u: to first
/// order, and where the cross-section has none, as it faces.
inline double turn_to_nearest(const Probe<2>& probe, const PanelField& p, double by)
{
  constexpr double farthest = 0.5;
  const SecondDerivatives h = surface_hessian(probe, p.q, p.f);
  if (!(h.vv > 0.0)) return std::remainder(facing_angle(probe.f, p.u) - p.s.v, 2.0 * std::numbers::pi);
  return std::clamp(-(p.f.n.dot(p.q.pv) + h.uv * by) / h.vv, -farthest, farthest);
}

/// The halves of a panel along u or v, with places and without fields. Of a strip along v they are those of
/// its window.
template <int dim>
std::array<PanelField, 2> located_halves(const Probe<dim>& probe, const PanelField& p, bool along_u)
{
  const std::array<Panel, 2> half = halves(p.near(), along_u);
  const Angle by(along_u ? half[0].hu : half[0].hv), back = by.reversed();
  std::array<PanelField, 2> out;
  for (std::size_t k = 0; k < 2; ++k) {
    const Angle& turn = k == 0 ? back : by;
    out[k].s = half[k];
    out[k].u = along_u ? p.u.turned(turn) : p.u;
    out[k].v = along_u ? p.v : p.v.turned(turn);
    if constexpr (dim == 2) {
      if (is_strip(p.s)) {
        if (along_u) {
          const double to_nearest = turn_to_nearest(probe, p, half[k].u - p.s.u);
          out[k].s.v += to_nearest;
          out[k].s.hv = all_around;
          out[k].v = p.v.turned(to_nearest);
        }
        out[k].s.v = in_turn(out[k].s.v);
      }
    }
    out[k].q = probe.at(out[k].u, out[k].v);
  }
  return out;
}

/// True where a panel is to be halved along u: where it is longer. A strip is halved along v where its window
/// is still many times as long as it is wide, which halving it along u does not change.
template <int dim>
bool longer_along_u(const Probe<dim>& probe, const PanelField& p)
{
  if constexpr (dim == 1) return true;
  constexpr double longest_window = 4.0;  // over the width of its strip
  const double along = probe.Lu * p.s.hu;
  return is_strip(p.s) ? longest_window * along >= probe.Lv * p.half : along >= probe.Lv * p.s.hv;
}

/// True where the halves of a panel will be those of a strip's window, and something of it is outside.
template <int dim>
bool leaves_a_rest(const Probe<dim>& probe, const PanelField& p)
{
  return is_strip(p.s) && p.half < all_around && !longer_along_u(probe, p);
}

/// The halves of a panel along its longer side, with their fields.
template <int dim>
std::array<PanelField, 2> split(const Probe<dim>& probe, const PanelField& p)
{
  std::array<PanelField, 2> out = located_halves(probe, p, longer_along_u(probe, p));
  fill_fields(*probe.f.F, out);
  return out;
}

/// Lower bound of the field over a panel, see panel_bound(). Of a strip it is not more than `needed` where a
/// part of it is only known not to be below that; its window is entered.
template <int dim>
PanelBound bound_of(const Probe<dim>& probe, PanelField& p, double needed)
{
  if constexpr (dim == 2) {
    if (is_strip(p.s)) {
      const StripWindow window = strip_window(probe, p.s, p.q, p.f, needed);
      p.half = window.half;
      if (window.half == 0.0) return {p.f.m.phi, window.bound};
      PanelBound b = panel_bound(probe, p.near(), p.q, p.f, needed);
      if (window.half < all_around) b.bound = std::min(b.bound, needed);
      return b;
    }
  }
  return panel_bound(probe, p.s, p.q, p.f, needed);
}

}  // namespace hauberk
