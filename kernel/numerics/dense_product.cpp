#include "numerics/dense_product.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace hauberk {
namespace {

/// Depth and rows of a packed part: one of the left factor stays in the second cache, with a tile of the
/// right one in the first.
constexpr int part_depth = 256, part_rows = 96;

/// Columns of a tile of c, which stays in registers: two vectors high, eight sums that do not wait for each
/// other.
constexpr int tile_columns = 4;
constexpr int most_tile_rows = 16;

using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));

/// tile -= left right^T over `depth`; left and right packed, the tile with leading dimension ldc.
template <class V>
[[gnu::always_inline]] inline void update(const double* left, const double* right, int depth, double* tile,
                                          std::ptrdiff_t ldc)
{
  constexpr int lanes = sizeof(V) / sizeof(double);
  V upper[tile_columns], lower[tile_columns];
  for (int j = 0; j < tile_columns; ++j) {
    std::memcpy(&upper[j], tile + j * ldc, sizeof(V));
    std::memcpy(&lower[j], tile + j * ldc + lanes, sizeof(V));
  }
  for (int k = 0; k < depth; ++k, left += 2 * lanes, right += tile_columns) {
    V first, second;
    std::memcpy(&first, left, sizeof(V));
    std::memcpy(&second, left + lanes, sizeof(V));
    for (int j = 0; j < tile_columns; ++j) {
      upper[j] -= first * right[j];
      lower[j] -= second * right[j];
    }
  }
  for (int j = 0; j < tile_columns; ++j) {
    std::memcpy(tile + j * ldc, &upper[j], sizeof(V));
    std::memcpy(tile + j * ldc + lanes, &lower[j], sizeof(V));
  }
}

/// What a processor can do: rows of a tile, and how it is updated.
struct Kernel {
  int rows;
  void (*update)(const double* left, const double* right, int depth, double* tile, std::ptrdiff_t ldc);
};

// The flag -ffp-contract=off of this file keeps the compiler from fusing what is rounded one by one.
void update_2(const double* left, const double* right, int depth, double* tile, std::ptrdiff_t ldc)
{
  update<Two>(left, right, depth, tile, ldc);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void update_4(const double* left, const double* right, int depth, double* tile,
                                      std::ptrdiff_t ldc)
{
  update<Four>(left, right, depth, tile, ldc);
}

[[gnu::target("avx512f")]] void update_8(const double* left, const double* right, int depth, double* tile,
                                         std::ptrdiff_t ldc)
{
  update<Eight>(left, right, depth, tile, ldc);
}

Kernel widest()
{
  if (__builtin_cpu_supports("avx512f")) return {16, update_8};
  if (__builtin_cpu_supports("avx2")) return {8, update_4};
  return {4, update_2};
}
#else
Kernel widest() { return {4, update_2}; }
#endif

/// `size` rows of a (from `first` on) and `depth` of its columns in panels of `width`, each column by column;
/// what the last panel lacks is zero.
void pack(const double* a, int lda, int first, int size, int depth, int width, std::vector<double>& out)
{
  const auto panels = static_cast<std::size_t>((size + width - 1) / width);
  const std::size_t needed = panels * static_cast<std::size_t>(width) * static_cast<std::size_t>(depth);
  if (out.size() < needed) out.resize(needed);
  double* to = out.data();
  for (int i = 0; i < size; i += width) {
    const int count = std::min(width, size - i);
    const double* from = a + first + i;
    for (int k = 0; k < depth; ++k, to += width, from += lda) {
      for (int r = 0; r < count; ++r) to[r] = from[r];
      for (int r = count; r < width; ++r) to[r] = 0.0;
    }
  }
}

/// Updates a tile of fewer rows or columns than a whole one, in a copy.
void update_edge(const Kernel& kernel, const double* left, const double* right, int depth, double* tile,
                 std::ptrdiff_t ldc, int rows, int columns)
{
  std::array<double, static_cast<std::size_t>(most_tile_rows) * tile_columns> copy{};
  for (int j = 0; j < columns; ++j) std::copy_n(tile + j * ldc, rows, copy.begin() + j * kernel.rows);
  kernel.update(left, right, depth, copy.data(), kernel.rows);
  for (int j = 0; j < columns; ++j) std::copy_n(copy.begin() + j * kernel.rows, rows, tile + j * ldc);
}

}  // namespace

void subtract_product(int rows, int columns, int depth, const double* a, int lda, const double* b, int ldb,
                      double* c, int ldc, ProductSpace& space)
{
  static const Kernel kernel = widest();
  for (int k = 0; k < depth; k += part_depth) {
    const int deep = std::min(part_depth, depth - k);
    pack(b + static_cast<std::ptrdiff_t>(k) * ldb, ldb, 0, columns, deep, tile_columns, space.right);
    for (int first = 0; first < rows; first += part_rows) {
      const int size = std::min(part_rows, rows - first);
      pack(a + static_cast<std::ptrdiff_t>(k) * lda, lda, first, size, deep, kernel.rows, space.left);
      for (int j = 0; j < std::min(columns, first + size); j += tile_columns) {
        const double* right = space.right.data() + static_cast<std::ptrdiff_t>(j) * deep;
        const int wide = std::min(tile_columns, columns - j);
        // Tiles above the diagonal are left out.
        const int begin = std::max(0, (j - first) / kernel.rows * kernel.rows);
        for (int i = begin; i < size; i += kernel.rows) {
          const double* left = space.left.data() + static_cast<std::ptrdiff_t>(i) * deep;
          double* tile = c + first + i + static_cast<std::ptrdiff_t>(j) * ldc;
          const int high = std::min(kernel.rows, size - i);
          if (wide == tile_columns && high == kernel.rows)
            kernel.update(left, right, deep, tile, ldc);
          else
            update_edge(kernel, left, right, deep, tile, ldc, high, wide);
        }
      }
    }
  }
}

}  // namespace hauberk
