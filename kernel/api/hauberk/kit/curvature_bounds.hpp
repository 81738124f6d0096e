#pragma once
/// Certified bounds of how a surface bends, over all of it.

#include <hauberk/kit/surface_cell.hpp>

#include <queue>

namespace hauberk::kit {

/// Upper bounds over the whole surface.
struct CurvatureBounds {
  double convex = 0.0;   ///< of principal curvatures, at least 0
  double concave = 0.0;  ///< of their negatives, at least 0
};

/// Bounds by branch and bound: of each number the cell with the largest bound is halved, across the side
/// along which it bends more, until the bound is near the largest value found at middles of cells or the
/// budget is spent.
template <class Author, bool with_change>
class CurvatureSearch {
 public:
  explicit CurvatureSearch(const double* q) : q_(q)
  {
    const ChartDomain domain = ChartDomain::of<Author>(q);
    const int columns = domain.revolved ? 1 : ChartDomain::columns;
    const double half_u = domain.revolved ? 0.0 : domain.half_u(), half_v = domain.half_v();
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < domain.rows(); ++j) add((2 * i + 1) * half_u, (2 * j + 1) * half_v, half_u, half_v);
  }

  /// At least the largest value over the surface of what `upper` bounds over a cell, at least 0. `at` is the
  /// value in the middle of a cell. The slack is far above rounding there.
  template <class Upper, class At>
  double bound(const Upper& upper, const At& at, double enough, int budget)
  {
    constexpr double slack = 1.0 + 1e-10;
    double found = 0.0;
    std::priority_queue<std::pair<double, std::size_t>> open;
    const auto consider = [&](std::size_t k) {
      found = std::max(found, at(cells_[k]));
      open.emplace(upper(cells_[k]), k);
    };
    for (std::size_t k = 0; k < cells_.size(); ++k) consider(k);
    for (int k = 0; k < budget && open.top().first > enough * found; ++k) {
      const std::size_t parent = open.top().second;
      open.pop();
      halve(parent);
      consider(parent);
      consider(cells_.size() - 1);
    }
    return slack * std::max(0.0, open.top().first);
  }

  /// The largest value in middles of cells.
  template <class At>
  double largest(const At& at) const
  {
    double most = -std::numeric_limits<double>::infinity();
    for (const SurfaceCell& c : cells_) most = std::max(most, at(c));
    return most;
  }

 private:
  void add(double u, double v, double half_u, double half_v)
  {
    cells_.push_back(surface_cell<Author, with_change>(q_, u, v, half_u, half_v));
  }

  /// One half takes the cell's place, the other comes last.
  void halve(std::size_t k)
  {
    SurfaceCell c = cells_[k];
    const bool across_u = c.is_bent_in_u();
    double& half = across_u ? c.half_u : c.half_v;
    half *= 0.5;
    const double du = across_u ? half : 0.0, dv = across_u ? 0.0 : half;
    add(c.u + du, c.v + dv, c.half_u, c.half_v);
    cells_[k] = surface_cell<Author, with_change>(q_, c.u - du, c.v - dv, c.half_u, c.half_v);
  }

  const double* q_;
  std::vector<SurfaceCell> cells_;
};

template <class Author>
CurvatureBounds curvature_bounds(const double* q)
{
  using Cell = SurfaceCell;
  CurvatureBounds b;
  CurvatureSearch<Author, false> bends(q);
  const auto most = [](const Cell& c) { return c.most; };
  const auto most_at = [](const Cell& c) { return c.most_at; };
  b.convex = bends.bound(most, most_at, 1.08, 1000);
  // Sections that are thin or flat beside their ring take more cells, for a bound that is poorer all the
  // same.
  constexpr double poor = 2.0;
  if (b.convex > poor * bends.largest(most_at)) b.convex = bends.bound(most, most_at, poor, 15'000);
  const auto concave_at = [](const Cell& c) { return -c.least_at; };
  // What an author states holds unless a point of the surface refutes it.
  const bool stated = Statements<Author>::convex && bends.largest(concave_at) <= 1e-9 * b.convex;
  if (!stated) b.concave = bends.bound([](const Cell& c) { return -c.least; }, concave_at, 1.05, 1500);
  return b;
}

/// Upper bound of the normal curvature's derivative along geodesics; infinite where curvature jumps.
template <class Author>
double change_bound(const double* q)
{
  if constexpr (Statements<Author>::curvature_jumps)
    return std::numeric_limits<double>::infinity();
  else
    return CurvatureSearch<Author, true>(q).bound([](const SurfaceCell& c) { return c.change; },
                                                  [](const SurfaceCell& c) { return c.change_at; }, 1.2,
                                                  2000);
}

}  // namespace hauberk::kit
