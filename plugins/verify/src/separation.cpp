#include "separation.hpp"

#include "facets.hpp"
#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hauberk::verification {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
/// Windows in which the lowest point of a valley is sought, at most.
constexpr int most_windows = 50;
constexpr double golden = std::numbers::phi - 1.0;

struct Lowest {
  double at, value;
};

/// Smallest value of f in [low, high], where f falls, then rises. The angle is found to about 1e-8, so the
/// value to rounding.
template <class F>
Lowest golden_minimum(const F& f, double low, double high)
{
  double x1 = high - golden * (high - low), x2 = low + golden * (high - low);
  double f1 = f(x1), f2 = f(x2);
  Lowest best = f1 < f2 ? Lowest{x1, f1} : Lowest{x2, f2};
  const auto keep = [&best](double x, double value) {
    if (value < best.value) best = {x, value};
  };
  while (high - low > 1e-9) {
    if (f1 < f2) {
      high = x2;
      x2 = x1;
      f2 = f1;
      x1 = high - golden * (high - low);
      f1 = f(x1);
      keep(x1, f1);
    } else {
      low = x1;
      x1 = x2;
      f1 = f2;
      x2 = low + golden * (high - low);
      f2 = f(x2);
      keep(x2, f2);
    }
  }
  return best;
}

/// Smallest value over a circle; |df/du| <= slope.
template <class F>
double circle_minimum(const F& f, double slope)
{
  constexpr int coarse = 64, divisions = 6;
  struct Cell {
    double u, value;
  };
  double width = full_turn / coarse, best = std::numeric_limits<double>::infinity();
  std::vector<Cell> cells, finer;
  for (int i = 0; i < coarse; ++i) {
    cells.push_back({(i + 0.5) * width, f((i + 0.5) * width)});
    best = std::min(best, cells.back().value);
  }
  for (int level = 0; level < divisions; ++level) {
    finer.clear();
    for (const Cell& cell : cells) {
      if (cell.value - 0.5 * slope * width > best) continue;
      for (const double shift : {-0.25, 0.25}) {
        const double u = cell.u + shift * width;
        finer.push_back({u, f(u)});
        best = std::min(best, finer.back().value);
      }
    }
    cells.swap(finer);
    width *= 0.5;
  }
  for (const Cell& cell : cells) {
    if (cell.value - 0.5 * slope * width > best) continue;
    if (cell.value > f(cell.u - width) || cell.value > f(cell.u + width)) continue;
    best = std::min(best, golden_minimum(f, cell.u - 1.5 * width, cell.u + 1.5 * width).value);
  }
  return best;
}

/// Smallest value over the angles of a torus; |df/du| <= slope_u, |df/dv| <= slope_v.
template <class F>
double torus_minimum(const F& f, double slope_u, double slope_v)
{
  constexpr int coarse_u = 64, coarse_v = 16, divisions = 4;
  struct Cell {
    double u, v, value;
  };
  double du = full_turn / coarse_u, dv = full_turn / coarse_v, best = std::numeric_limits<double>::infinity();
  std::vector<Cell> cells, finer;
  const auto add = [&](std::vector<Cell>& to, double u, double v) {
    to.push_back({u, v, f(u, v)});
    best = std::min(best, to.back().value);
  };
  const auto hopeless = [&](const Cell& cell) {
    return cell.value - 0.5 * std::hypot(slope_u * du, slope_v * dv) > best;
  };
  for (int i = 0; i < coarse_u; ++i)
    for (int j = 0; j < coarse_v; ++j) add(cells, (i + 0.5) * du, (j + 0.5) * dv);
  for (int level = 0; level < divisions; ++level) {
    finer.clear();
    for (const Cell& cell : cells) {
      if (hopeless(cell)) continue;
      for (const double s : {-0.25, 0.25})
        for (const double t : {-0.25, 0.25}) add(finer, cell.u + s * du, cell.v + t * dv);
    }
    cells.swap(finer);
    du *= 0.5;
    dv *= 0.5;
  }
  const auto lowest_around = [&](const Cell& cell) {
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        if ((i != 0 || j != 0) && f(cell.u + i * du, cell.v + j * dv) < cell.value) return false;
    return true;
  };
  for (const Cell& cell : cells) {
    if (hopeless(cell) || !lowest_around(cell)) continue;
    // A valley between surfaces that conform may leave the cell at a slant: follow it while it falls.
    Cell lowest = cell;
    for (int follow = 0; follow < most_windows; ++follow) {
      const auto over_v = [&](double u) {
        return golden_minimum([&](double v) { return f(u, v); }, lowest.v - 2.0 * dv, lowest.v + 2.0 * dv);
      };
      const Lowest in_u =
          golden_minimum([&](double u) { return over_v(u).value; }, lowest.u - 1.5 * du, lowest.u + 1.5 * du);
      if (!(in_u.value < lowest.value)) break;
      const bool inside = std::abs(in_u.at - lowest.u) < du;
      const double v = over_v(in_u.at).at;
      const bool done = inside && std::abs(v - lowest.v) < dv;
      lowest = {in_u.at, v, in_u.value};
      if (done) break;
    }
    best = std::min(best, lowest.value);
  }
  return best;
}

/// A tube of constant radius is an offset of its core: its distance is that of the core less the radius.
double tube_separation(const Primitive& tube, const Primitive& other)
{
  return circle_minimum([&](double u) { return signed_distance(other, core_point(tube, u)); },
                        core_speed(tube)) -
         tube.r0;
}

}  // namespace

double separation(const Primitive& a, const Primitive& b)
{
  if (a.facets > 0) return mesh_separation(a, b);
  if (a.solid || b.solid) {
    const double width = 1e-12 * (reach(a) + reach(b));
    return enclose(a, b, width, std::numeric_limits<double>::infinity()).found;
  }
  if (is_tube(a)) return tube_separation(a, b);
  if (is_tube(b)) return tube_separation(b, a);
  return torus_minimum([&](double u, double v) { return signed_distance(b, surface_point(a, u, v)); },
                       a.R + a.r0, std::max(a.r0, a.r1));
}

Enclosure enclosed_separation(const Primitive& a, const Primitive& b, double width, double enough)
{
  if (a.facets == 0 && (a.solid || b.solid)) return enclose(a, b, width, enough);
  const double exact = separation(a, b);
  return {exact, exact};
}

double separation_bound(const Primitive& a, const Primitive& b)
{
  const auto mesh_of_curve = [](const Primitive& t) { return t.facets > 0 && !t.curve.empty(); };
  if (a.surface || b.surface || a.solid || b.solid || mesh_of_curve(a) || mesh_of_curve(b))
    return (a.place.position - b.place.position).norm() - reach(a) - reach(b);
  const double excess = a.facets > 0 ? mesh_excess(a) + mesh_excess(b) : 0.0;
  Primitive thin_a = a, thin_b = b;
  thin_a.r0 = thin_a.r1 = std::max(a.r0, a.r1);
  thin_b.r0 = thin_b.r1 = std::max(b.r0, b.r1);
  return tube_separation(thin_a, thin_b) - excess;
}

}  // namespace hauberk::verification
