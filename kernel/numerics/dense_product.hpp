#pragma once
/// The product of dense matrices that elimination spends its time in.

#include <vector>

namespace hauberk {

/// Packed parts of the factors; a caller that multiplies often keeps it.
struct ProductSpace {
  std::vector<double> left, right;
};

/// c -= a b^T, lower triangle: a has `rows` rows, b `columns` <= rows, both `depth` columns, and c's diagonal
/// begins at its first entry. All column-major with leading dimensions lda, ldb, ldc. Entries of c above the
/// diagonal may change.
///
/// Bit for bit the same on every processor: each entry is c - a_0 b_0 - a_1 b_1 - ..., every product and
/// every difference rounded, in this order. Wider vectors do more entries at a time and the same with each;
/// a fused multiply-add would round otherwise, and is not used. Thread safe for separate spaces.
void subtract_product(int rows, int columns, int depth, const double* a, int lda, const double* b, int ldb,
                      double* c, int ldc, ProductSpace& space);

}  // namespace hauberk
