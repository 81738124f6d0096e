#pragma once
/// The part of a sparse factorisation that depends on the pattern of the matrix alone.

#include <vector>

namespace hauberk {

/// Rows in the order of elimination, and columns that are eliminated together.
struct SymbolicFactor {
  std::vector<int> order;
  std::vector<int> first;  ///< column of each block, and the number of columns
  std::vector<int> begin;  ///< of each block's rows in `rows`, and the number of these
  std::vector<int> rows;   ///< each block's own columns first, ascending
};

/// Orders the lower triangle of a symmetric matrix of size n, by compressed columns, so that its factor fills
/// little, and joins columns of like pattern. `given`: the order, if not null. False where memory does not
/// suffice. Thread safe.
using FindSymbolicFactor = bool(int n, const int* columns, const int* rows, const int* given,
                                SymbolicFactor& out);

}  // namespace hauberk
