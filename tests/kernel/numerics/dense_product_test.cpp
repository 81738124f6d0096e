/// Products of dense blocks: bit for bit what plain loops give, on any processor.

#include "numerics/dense_product.hpp"

#include <gtest/gtest.h>
#include <Eigen/Core>

#include <random>

namespace hauberk::test {
namespace {

TEST(DenseProduct, IsThatOfPlainLoopsBitForBit)
{
  std::mt19937_64 rng(11);
  std::normal_distribution<double> normal;
  ProductSpace space;
  for (const auto& [rows, columns, depth] : {std::array{1, 1, 1},
                                             {8, 4, 32},
                                             {9, 5, 3},
                                             {100, 100, 32},
                                             {203, 117, 300},
                                             {97, 97, 257},
                                             {50, 7, 0}}) {
    // Leading dimensions are larger than what is multiplied.
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(rows + 3, depth, [&] { return normal(rng); }),
                          b = Eigen::MatrixXd::NullaryExpr(columns + 1, depth, [&] { return normal(rng); });
    Eigen::MatrixXd c = Eigen::MatrixXd::NullaryExpr(rows + 2, columns, [&] { return normal(rng); });
    const Eigen::MatrixXd before = c;
    subtract_product(rows, columns, depth, a.data(), rows + 3, b.data(), columns + 1, c.data(), rows + 2,
                     space);
    for (int j = 0; j < columns; ++j) {
      for (int i = j; i < rows; ++i) {
        double expected = before(i, j);
        for (int k = 0; k < depth; ++k) {
          const double product = a(i, k) * b(j, k);
          expected -= product;
        }
        ASSERT_EQ(c(i, j), expected) << rows << ' ' << columns << ' ' << depth << ' ' << i << ' ' << j;
      }
      // Nothing outside is touched.
      for (int i = rows; i < rows + 2; ++i) ASSERT_EQ(c(i, j), before(i, j));
    }
  }
}

}  // namespace
}  // namespace hauberk::test
