#pragma once
/// Panels with the field at their centres: what every search over a probe set looks at, some at a time.
///
/// The distance from an ellipse is an iteration whose operations wait for each other; for several points at
/// once it takes little longer than for one. So centres are looked at in groups: the first panels row by row,
/// later ones with the other half of what was split.

#include "geometry/panel_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace hauberk {

/// A panel, its centre by angle and place, and the field there.
struct PanelField {
  Panel s;
  Angle u, v;
  ProbePoint q;
  FieldValue f;
};

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

/// The first panels of a search, four at a time; from `turn` on, radians.
template <int dim>
class FirstPanels {
 public:
  static constexpr int across = dim == 2 ? 4 : 1, along = 8,
                       rows = along * across / static_cast<int>(most_together);

  explicit FirstPanels(const Probe<dim>& probe, double turn = 0.0) : probe_(probe), turn_(turn)
  {
    for (int j = 0; dim == 2 && j < across; ++j) v_[j] = Angle(center(j, across));
  }

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
      p.u = j > 0 && dim == 2 ? out[0].u : Angle(p.s.u);
      if constexpr (dim == 2) p.v = v_[j];
      p.q = probe_.at(p.u, p.v);
    }
    return out;
  }

 private:
  Panel panel(int k, int j) const
  {
    if constexpr (dim == 1)
      return {center(static_cast<int>(most_together) * k + j, along), 0.0, std::numbers::pi / along, 0.0};
    return {center(k, along), center(j, across), std::numbers::pi / along, std::numbers::pi / across};
  }
  double center(int i, int count) const { return turn_ + (2 * i + 1) * std::numbers::pi / count; }

  const Probe<dim>& probe_;
  double turn_;
  std::array<Angle, across> v_;
};

/// The halves of a panel along u or v, with places and without fields.
template <int dim>
std::array<PanelField, 2> located_halves(const Probe<dim>& probe, const PanelField& p, bool along_u)
{
  const std::array<Panel, 2> half = halves(p.s, along_u);
  const Angle by(along_u ? half[0].hu : half[0].hv), back = by.reversed();
  std::array<PanelField, 2> out;
  for (std::size_t k = 0; k < 2; ++k) {
    const Angle& turn = k == 0 ? back : by;
    out[k].s = half[k];
    out[k].u = along_u ? p.u.turned(turn) : p.u;
    out[k].v = along_u ? p.v : p.v.turned(turn);
    out[k].q = probe.at(out[k].u, out[k].v);
  }
  return out;
}

/// True where a panel is longer along u.
template <int dim>
bool longer_along_u(const Probe<dim>& probe, const Panel& s)
{
  return dim == 1 || probe.Lu * s.hu >= probe.Lv * s.hv;
}

/// The halves of a panel along its longer side, with their fields.
template <int dim>
std::array<PanelField, 2> split(const Probe<dim>& probe, const PanelField& p)
{
  std::array<PanelField, 2> out = located_halves(probe, p, longer_along_u(probe, p.s));
  fill_fields(*probe.f.F, out);
  return out;
}

}  // namespace hauberk
