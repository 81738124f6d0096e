#include "numerics/sparse_ldlt.hpp"

#include "numerics/dense_product.hpp"
#include "numerics/on_demand.hpp"
#include "numerics/symbolic_factor.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace hauberk {
namespace {

using Eigen::MatrixXd;

/// Columns that are eliminated one by one.
constexpr int panel = 32;

/// Eliminates the first `columns` of a dense symmetric matrix (lower triangle): L and D take their place,
/// what is left of the others theirs. Returns false where a pivot is zero; counts negative ones, to no more
/// than one too many.
bool eliminate(Eigen::Map<MatrixXd>& front, int columns, int most_negative, int& negative, MatrixXd& scaled,
               ProductSpace& space)
{
  const int rows = static_cast<int>(front.rows());
  scaled.resize(rows, columns);
  for (int begin = 0; begin < columns; begin += panel) {
    const int end = std::min(begin + panel, columns);
    for (int j = begin; j < end; ++j) {
      const int below = rows - j - 1;
      const double d = front(j, j);
      if (!(d < 0.0) && !(d > 0.0)) return false;
      if (d < 0.0 && ++negative > most_negative) return false;
      scaled.col(j).tail(below) = front.col(j).tail(below);
      front.col(j).tail(below) /= d;
      for (int k = j + 1; k < end; ++k)
        front.col(k).tail(rows - k) -= scaled(k, j) * front.col(j).tail(rows - k);
    }
    if (end < columns) {
      subtract_product(rows - end, columns - end, end - begin, &front(end, begin), rows, &scaled(end, begin),
                       rows, &front(end, end), rows, space);
    }
  }
  if (columns < rows) {
    subtract_product(rows - columns, rows - columns, columns, &front(columns, 0), rows, &scaled(columns, 0),
                     rows, &front(columns, columns), rows, space);
  }
  return true;
}

}  // namespace

SparseLdlt::SparseLdlt(const Sparse& lower, const std::vector<int>& order)
{
  analyze(lower, order);
  const auto n = static_cast<Eigen::Index>(order_.size());
  permutation_.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) permutation_.indices()[order_[k]] = static_cast<int>(k);
  permuted_.resize(n, n);
  permuted_.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(permutation_);
}

void SparseLdlt::analyze(const Sparse& lower, const std::vector<int>& order)
{
  SymbolicFactor symbolic;
  auto* find =
      reinterpret_cast<FindSymbolicFactor*>(on_demand("cholmod_symbolic", "hauberk_symbolic_factor"));
  if (!find(static_cast<int>(lower.cols()), lower.outerIndexPtr(), lower.innerIndexPtr(),
            order.empty() ? nullptr : order.data(), symbolic))
    throw std::bad_alloc();
  order_ = std::move(symbolic.order);

  std::vector<int> block_of(order_.size());
  blocks_.resize(symbolic.first.size() - 1);
  std::size_t size = 0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    Block& b = blocks_[k];
    b.first = symbolic.first[k];
    b.columns = symbolic.first[k + 1] - b.first;
    b.rows.assign(symbolic.rows.begin() + symbolic.begin[k], symbolic.rows.begin() + symbolic.begin[k + 1]);
    b.at = size;
    size += b.rows.size() * static_cast<std::size_t>(b.columns);
    std::fill_n(block_of.begin() + b.first, b.columns, static_cast<int>(k));
  }
  for (Block& b : blocks_) {
    const std::size_t columns = b.columns;
    if (columns < b.rows.size()) b.parent = block_of[b.rows[columns]];
  }
  values_.resize(size);
}

bool SparseLdlt::factor(double shift, int most_negative)
{
  negative_ = 0;
  std::vector<MatrixXd> left(blocks_.size());  // of each block, until its parent takes it
  std::vector<std::vector<int>> children(blocks_.size());
  std::vector<int> place(order_.size());  // of a row in the front
  std::vector<int> to;                    // of a child's rows
  std::vector<double> storage;
  MatrixXd scaled;
  ProductSpace space;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const Block& b = blocks_[k];
    const auto rows = static_cast<Eigen::Index>(b.rows.size());
    if (storage.size() < b.rows.size() * b.rows.size()) storage.resize(b.rows.size() * b.rows.size());
    Eigen::Map<MatrixXd> front(storage.data(), rows, rows);
    front.triangularView<Eigen::Lower>().setZero();
    for (std::size_t r = 0; r < b.rows.size(); ++r) place[b.rows[r]] = static_cast<int>(r);
    for (int c = 0; c < b.columns; ++c) {
      for (Sparse::InnerIterator it(permuted_, b.first + c); it; ++it)
        front(place[it.row()], c) += it.value();
      front(c, c) += shift;
    }
    for (const int child : children[k]) {
      const Block& from = blocks_[child];
      MatrixXd& part = left[child];
      to.clear();
      for (auto row = from.rows.begin() + from.columns; row != from.rows.end(); ++row)
        to.push_back(place[*row]);
      for (Eigen::Index c = 0; c < part.cols(); ++c) {
        double* column = &front(0, to[c]);
        const double* added = &part(0, c);
        for (Eigen::Index r = c; r < part.rows(); ++r) column[to[r]] += added[r];
      }
      part.resize(0, 0);
    }
    if (!eliminate(front, b.columns, most_negative, negative_, scaled, space)) return false;
    Eigen::Map<MatrixXd>(values_.data() + b.at, rows, b.columns) = front.leftCols(b.columns);
    if (b.parent >= 0) {
      const Eigen::Index rest = rows - b.columns;
      left[k].resize(rest, rest);
      left[k].triangularView<Eigen::Lower>() = front.bottomRightCorner(rest, rest);
      children[b.parent].push_back(static_cast<int>(k));
    }
  }
  return true;
}

MatrixXd SparseLdlt::solve(const MatrixXd& b) const
{
  const MatrixXd permuted = permutation_ * b;
  MatrixXd x(b.rows(), b.cols());
  // One column at a time: of few columns a product of matrices costs more than those of vectors.
  for (Eigen::Index k = 0; k < b.cols(); ++k) x.col(k) = solve_permuted(permuted.col(k));
  return permutation_.transpose() * x;
}

Eigen::VectorXd SparseLdlt::solve_permuted(Eigen::VectorXd x) const
{
  Eigen::VectorXd rest;
  const auto l_of = [this](const Block& block) {
    return Eigen::Map<const MatrixXd>(values_.data() + block.at, static_cast<Eigen::Index>(block.rows.size()),
                                      block.columns);
  };
  for (const Block& block : blocks_) {
    const auto l = l_of(block);
    auto own = x.segment(block.first, block.columns);
    l.topRows(block.columns).triangularView<Eigen::UnitLower>().solveInPlace(own);
    rest.noalias() = l.bottomRows(l.rows() - block.columns) * own;
    for (Eigen::Index r = 0; r < rest.size(); ++r) x[block.rows[block.columns + r]] -= rest[r];
  }
  for (std::size_t k = blocks_.size(); k-- > 0;) {
    const Block& block = blocks_[k];
    const auto l = l_of(block);
    auto own = x.segment(block.first, block.columns);
    own.array() /= l.diagonal().array();
    rest.resize(l.rows() - block.columns);
    for (Eigen::Index r = 0; r < rest.size(); ++r) rest[r] = x[block.rows[block.columns + r]];
    own.noalias() -= l.bottomRows(rest.size()).transpose() * rest;
    l.topRows(block.columns).triangularView<Eigen::UnitLower>().transpose().solveInPlace(own);
  }
  return x;
}

}  // namespace hauberk
