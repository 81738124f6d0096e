#include "limits/place_index.hpp"

#include "limits/symmetry.hpp"
#include "numerics/decompositions.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Width of a cell of the grid (L): far above the tolerance, far below the distance of elements.
constexpr double cell_width = 0.01;
constexpr double most_cells = 1 << 20;  ///< along a lattice vector

}  // namespace

LatticeCoordinates::LatticeCoordinates(const Model& m)
{
  if (m.lattice.empty()) return;
  Eigen::Matrix<double, 3, Eigen::Dynamic> T(3, static_cast<Eigen::Index>(m.lattice.size()));
  for (std::size_t k = 0; k < m.lattice.size(); ++k) T.col(k) = m.lattice[k];
  const Matrix inverse = reciprocal_basis(T);
  for (Eigen::Index k = 0; k < inverse.rows(); ++k) reciprocal_.emplace_back(inverse.row(k).transpose());
}

Image LatticeCoordinates::nearest(const Vec3& x) const
{
  Image image{};
  for (std::size_t k = 0; k < size(); ++k) image[k] = static_cast<int>(std::lround(at(k, x)));
  return image;
}

PlaceIndex::PlaceIndex(const Model& m) : model_(&m), lattice_(m)
{
  for (std::size_t k = 0; k < lattice_.size(); ++k) {
    const double across = 1.0 / lattice_.reciprocal(k).norm();  // distance of the cell's faces
    cells_[k] = static_cast<std::int64_t>(std::clamp(std::floor(across / cell_width), 1.0, most_cells));
  }
  for (int i = 0; i < m.element_count(); ++i) {
    const Vec3 g = grid(m.rest[i].position);
    Cell cell{};
    for (std::size_t k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(g[k]));
    elements_[key(cell)].push_back(i);
  }
}

Vec3 PlaceIndex::grid(const Vec3& x) const
{
  if (lattice_.size() == 0) return {x.x() / cell_width, x.y() / cell_width, 0.0};
  Vec3 g = Vec3::Zero();
  for (std::size_t k = 0; k < lattice_.size(); ++k) g[k] = lattice_.at(k, x) * static_cast<double>(cells_[k]);
  return g;
}

std::uint64_t PlaceIndex::key(Cell cell) const
{
  std::uint64_t hash = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (cells_[k] > 0) cell[k] = ((cell[k] % cells_[k]) + cells_[k]) % cells_[k];
    hash = hash * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(cell[k]);
  }
  return hash;
}

void PlaceIndex::find(const Vec3& x, std::vector<Placed>& out) const
{
  out.clear();
  const double tolerance = symmetry_tolerance(x);
  const Vec3 g = grid(x);
  // A place at the border of a cell may have its element beyond it.
  std::array<std::array<std::int64_t, 2>, 3> range{};
  for (std::size_t k = 0; k < std::max<std::size_t>(lattice_.size(), 2); ++k) {
    const double widest = k < lattice_.size()
                              ? tolerance * lattice_.reciprocal(k).norm() * static_cast<double>(cells_[k])
                              : tolerance / cell_width;
    const double at = g[k];
    range[k] = {static_cast<std::int64_t>(std::floor(at - widest)),
                static_cast<std::int64_t>(std::floor(at + widest))};
  }
  std::array<std::uint64_t, 8> visited{};
  std::size_t count = 0;
  for (std::int64_t a = range[0][0]; a <= range[0][1]; ++a) {
    for (std::int64_t b = range[1][0]; b <= range[1][1]; ++b) {
      for (std::int64_t c = range[2][0]; c <= range[2][1]; ++c) {
        const std::uint64_t k = key({a, b, c});
        const auto seen = visited.begin() + static_cast<std::ptrdiff_t>(count);
        if (std::find(visited.begin(), seen, k) != seen) continue;
        if (count < visited.size()) visited[count++] = k;
        const auto cell = elements_.find(k);
        if (cell == elements_.end()) continue;
        for (const int j : cell->second) {
          const Vec3 d = x - model_->rest[j].position;
          const Image image = lattice_.nearest(d);
          if ((d - model_->translation(image)).norm() <= tolerance) out.push_back({j, image});
        }
      }
    }
  }
  std::sort(out.begin(), out.end(), [](const Placed& p, const Placed& q) { return p.element < q.element; });
}

}  // namespace hauberk
