#include "dense_product.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace hauberk {
namespace {

/// Depth and rows of a packed part: one of the left factor stays in the second cache, with a tile of the
/// right one in the first.
constexpr int part_depth = 256, part_rows = 96;

/// Sizes of a tile of c, which stays in registers: eight rows are one vector of AVX-512, two of AVX, four of
/// SSE2.
constexpr int tile_rows = 8, tile_columns = 4;

using Row = double __attribute__((vector_size(tile_rows * sizeof(double))));

/// tile -= left right^T over `depth`; left and right packed, the tile with leading dimension ldc.
[[gnu::always_inline]] inline void update(const double* left, const double* right, int depth, double* tile,
                                          std::ptrdiff_t ldc)
{
  std::array<Row, tile_columns> sum;
  for (std::size_t j = 0; j < tile_columns; ++j)
    std::memcpy(&sum[j], tile + static_cast<std::ptrdiff_t>(j) * ldc, sizeof(Row));
  for (int k = 0; k < depth; ++k, left += tile_rows, right += tile_columns) {
    Row column;
    std::memcpy(&column, left, sizeof(Row));
    for (std::size_t j = 0; j < tile_columns; ++j) sum[j] -= column * right[j];
  }
  for (std::size_t j = 0; j < tile_columns; ++j)
    std::memcpy(tile + static_cast<std::ptrdiff_t>(j) * ldc, &sum[j], sizeof(Row));
}

// No target has fused multiply-adds: the compiler would contract the products above.
using Update = void (*)(const double*, const double*, int, double*, std::ptrdiff_t);

void update_plain(const double* left, const double* right, int depth, double* tile, std::ptrdiff_t ldc)
{
  update(left, right, depth, tile, ldc);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void update_avx2(const double* left, const double* right, int depth, double* tile,
                                         std::ptrdiff_t ldc)
{
  update(left, right, depth, tile, ldc);
}

Update widest() { return __builtin_cpu_supports("avx2") ? update_avx2 : update_plain; }
#else
Update widest() { return update_plain; }
#endif

/// `size` rows of a (from `first` on) and `depth` of its columns in panels of `width`, each column by column;
/// what the last panel lacks is zero.
void pack(const double* a, int lda, int first, int size, int depth, int width, std::vector<double>& out)
{
  const auto panels = static_cast<std::size_t>((size + width - 1) / width);
  out.assign(panels * static_cast<std::size_t>(width) * static_cast<std::size_t>(depth), 0.0);
  double* to = out.data();
  for (int i = 0; i < size; i += width) {
    const auto count = static_cast<std::size_t>(std::min(width, size - i));
    for (int k = 0; k < depth; ++k, to += width)
      std::memcpy(to, a + first + i + static_cast<std::ptrdiff_t>(k) * lda, count * sizeof(double));
  }
}

}  // namespace

void subtract_product(int rows, int columns, int depth, const double* a, int lda, const double* b, int ldb,
                      double* c, int ldc, ProductSpace& space)
{
  static const Update run = widest();
  std::array<double, static_cast<std::size_t>(tile_rows) * tile_columns> edge{};
  for (int k = 0; k < depth; k += part_depth) {
    const int deep = std::min(part_depth, depth - k);
    pack(b + static_cast<std::ptrdiff_t>(k) * ldb, ldb, 0, columns, deep, tile_columns, space.right);
    for (int first = 0; first < rows; first += part_rows) {
      const int size = std::min(part_rows, rows - first);
      pack(a + static_cast<std::ptrdiff_t>(k) * lda, lda, first, size, deep, tile_rows, space.left);
      for (int j = 0; j < std::min(columns, first + size); j += tile_columns) {
        const double* right = space.right.data() + static_cast<std::ptrdiff_t>(j) * deep;
        const int wide = std::min(tile_columns, columns - j);
        // Tiles above the diagonal are left out.
        const int begin = std::max(0, (j - first) / tile_rows * tile_rows);
        for (int i = begin; i < size; i += tile_rows) {
          const double* left = space.left.data() + static_cast<std::ptrdiff_t>(i) * deep;
          double* tile = c + first + i + static_cast<std::ptrdiff_t>(j) * ldc;
          const int high = std::min(tile_rows, size - i);
          if (wide == tile_columns && high == tile_rows) {
            run(left, right, deep, tile, ldc);
            continue;
          }
          const auto bytes = static_cast<std::size_t>(high) * sizeof(double);
          for (int s = 0; s < wide; ++s)
            std::memcpy(&edge[static_cast<std::size_t>(s) * tile_rows],
                        tile + static_cast<std::ptrdiff_t>(s) * ldc, bytes);
          run(left, right, deep, edge.data(), tile_rows);
          for (int s = 0; s < wide; ++s)
            std::memcpy(tile + static_cast<std::ptrdiff_t>(s) * ldc,
                        &edge[static_cast<std::size_t>(s) * tile_rows], bytes);
        }
      }
    }
  }
}

}  // namespace hauberk
