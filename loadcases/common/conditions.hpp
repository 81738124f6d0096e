#pragma once
/// What holds elements as a whole where they are.

#include <hauberk/load_case.hpp>

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// Conditions on one coordinate of all elements each, independent ones only.
class Conditions {
 public:
  Conditions(std::span<const Vec3> X, std::vector<LinearEquality>& out) : X_(X), out_(out) {}

  /// sum over elements of f(X_i) . (coordinates from `first` on) = 0, unless the others say it already.
  template <int size, class F>
  void add(const std::string& name, int first, const F& f)
  {
    constexpr double dependent = 1e-9;
    const auto n = static_cast<Eigen::Index>(X_.size());
    Eigen::VectorXd row = Eigen::VectorXd::Zero(max_coordinates * n);
    for (Eigen::Index i = 0; i < n; ++i) row.segment<size>(max_coordinates * i + first) = f(X_[i]);
    const double whole = row.norm();
    Eigen::VectorXd left = row;
    for (int pass = 0; pass < 2; ++pass)  // the second takes what rounding left
      for (const Eigen::VectorXd& unit : kept_) left -= unit.dot(left) * unit;
    if (!(left.norm() > dependent * whole)) return;
    kept_.push_back(left.normalized());
    LinearEquality condition{name, {}};
    for (Eigen::Index k = 0; k < row.size(); ++k) {
      if (left[k] == 0.0) continue;
      condition.terms.push_back(
          {static_cast<int>(k / max_coordinates), static_cast<int>(k % max_coordinates), kept_.back()[k]});
    }
    out_.push_back(std::move(condition));
  }

 private:
  std::span<const Vec3> X_;
  std::vector<LinearEquality>& out_;
  std::vector<Eigen::VectorXd> kept_;
};

}  // namespace hauberk
