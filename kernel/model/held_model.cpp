#include "model/held_model.hpp"
#include "numerics/decompositions.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace hauberk {
namespace {

/// A load case in the unknowns q with macro = B q. It knows no angles: whoever holds conditions has turned
/// the load into one on q already.
class SubspaceLoadCase final : public LoadCase {
 public:
  SubspaceLoadCase(const LoadCase& inner, const Matrix& basis)
      : inner_(inner), basis_(basis), nm_(inner.macro_count()), nq_(static_cast<int>(basis.cols()))
  {
    for (int k = 0; k < nq_; ++k)
      macros_.push_back({fmt::format("q{}", k), inner.macros().front().length_power});
  }

 protected:
  using Values = std::span<const double>;
  using Macros = std::array<double, max_macro>;

  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return inner_.coordinate_count(); }
  int do_lattice_vectors() const override { return inner_.lattice_vectors(); }

  void do_position(Values q, Values e, const Vec3& X, const Vec3& T, PositionMap& out) const override
  {
    Macros macro;
    PositionMap map;
    inner_.position(full(q, macro), e, X, T, map);
    const auto nc = static_cast<int>(e.size());
    out.x = map.x;
    out.J.leftCols(nq_) = map.J.leftCols(nm_).lazyProduct(basis_);
    out.J.middleCols(nq_, nc) = map.J.middleCols(nm_, nc);
    out.curved = map.curved;
    if (map.curved) curve(map, nc, out);
  }
  double do_acceleration_bound(Values q, Values dq, Values e, Values de, const Vec3& X,
                               const Vec3& T) const override
  {
    Macros macro, dmacro;
    return inner_.acceleration_bound(full(q, macro), full(dq, dmacro), e, de, X, T);
  }
  bool do_admissible(Values q) const override
  {
    Macros macro;
    return inner_.admissible(full(q, macro));
  }
  std::pair<double, double> do_stretch_range(Values q) const override
  {
    Macros macro;
    return inner_.stretch_range(full(q, macro));
  }
  void do_load(double, std::span<double>) const override { throw std::logic_error(no_angles); }
  double do_value(double, Values) const override { throw std::logic_error(no_angles); }
  std::string do_measure() const override { return inner_.measure(); }
  int do_value_length_power() const override { return inner_.value_length_power(); }
  std::pair<std::string, std::string> do_sense_names() const override { return inner_.sense_names(); }
  void do_metric(std::span<double> m) const override { std::fill(m.begin(), m.end(), 1.0); }
  Boundedness do_boundedness(Values, std::span<const Vec3>) const override { return Boundedness::attained; }
  bool do_bends() const override { return inner_.bends(); }
  std::string do_not_a_sheet(const SheetState& state) const override
  {
    Macros macro;
    SheetState there = state;
    there.macro = full(state.macro, macro);
    return inner_.not_a_sheet(there);
  }

 private:
  static constexpr const char* no_angles = "a load case restricted by conditions has no angles";

  Values full(Values q, Macros& macro) const
  {
    for (int k = 0; k < nm_; ++k) {
      double sum = 0.0;
      for (int j = 0; j < nq_; ++j) sum += basis_(k, j) * q[j];
      macro[k] = sum;
    }
    return {macro.data(), static_cast<std::size_t>(nm_)};
  }

  /// H' = P^T H P with P = [B 0; 0 1], for each component of the position.
  void curve(const PositionMap& map, int nc, PositionMap& out) const
  {
    constexpr int n = PositionMap::n;
    using Square = Eigen::Matrix<double, n, n, Eigen::RowMajor>;
    Matrix P = Matrix::Zero(nm_ + nc, nq_ + nc);
    P.topLeftCorner(nm_, nq_) = basis_;
    P.bottomRightCorner(nc, nc).setIdentity();
    for (std::size_t c = 0; c < map.H.size(); ++c) {
      const Eigen::Map<const Square> from(map.H[c][0].data());
      Eigen::Map<Square> to(out.H[c][0].data());
      to.setZero();
      to.topLeftCorner(nq_ + nc, nq_ + nc) = P.transpose() * from.topLeftCorner(nm_ + nc, nm_ + nc) * P;
    }
  }

  const LoadCase& inner_;
  Matrix basis_;
  int nm_, nq_;
  std::vector<MacroInfo> macros_;
};

Vector metric_weights(const LoadCase& load)
{
  std::vector<double> weights(load.macro_count());
  load.metric(weights);
  return Eigen::Map<const Vector>(weights.data(), static_cast<Eigen::Index>(weights.size()));
}

/// Columns that span the null space of held^T and are orthonormal in the norm with these weights.
Matrix null_space(const Matrix& held, const Vector& weights)
{
  const Vector root = weights.cwiseSqrt().cwiseInverse();
  return root.asDiagonal() * orthogonal_complement(root.asDiagonal() * held);
}

}  // namespace

MacroLoad macro_load(const Model& m, const Direction& direction, Sense sense)
{
  Vector pull(m.macro_count);
  m.load->load(direction, {pull.data(), static_cast<std::size_t>(m.macro_count)});
  if (sense == Sense::negative) pull = -pull;
  const std::vector<MacroCondition> conditions = m.load->conditions(direction);
  if (conditions.empty()) return {std::move(pull)};
  if (!m.load->takes_components())
    throw PluginError("load case: holds conditions on macroscopic unknowns of different units");
  Matrix held(m.macro_count, static_cast<Eigen::Index>(conditions.size()));
  for (Eigen::Index k = 0; k < held.cols(); ++k) {
    const auto& c = conditions[k].coefficients;
    for (int i = 0; i < m.macro_count; ++i) held(i, k) = c[i];
  }
  constexpr double nothing = 1e-9;
  if (rank(held) < held.cols() || !(within(held, pull).norm() > nothing * pull.norm())) {
    throw PluginError(fmt::format(
        "load case: what is held at {} depends on each other, or holds all that the load could move",
        direction.text()));
  }
  return {std::move(pull), std::move(held)};
}

Vector within(const Matrix& held, const Vector& macro)
{
  if (held.cols() == 0) return macro;
  return macro - held * least_squares(held, macro);
}

double missed(const Matrix& held, const Vector& macro)
{
  double most = 0.0;
  for (Eigen::Index k = 0; k < held.cols(); ++k)
    most = std::max(most, std::abs(held.col(k).dot(macro)) / held.col(k).norm());
  return most;
}

bool keeps(const Matrix& held, const Vector& macro)
{
  constexpr double kept = 1e-9;
  return missed(held, macro) <= kept;
}

HeldModel::HeldModel(const Model& full, const Matrix& held)
    : basis_(null_space(held, metric_weights(*full.load))),
      back_(reciprocal_basis(basis_)),
      load_(std::make_unique<SubspaceLoadCase>(*full.load, basis_)),
      model_(full)
{
  const Eigen::Index nq = basis_.cols(), elements = full.metric.size() - full.macro_count;
  model_.load = load_.get();
  model_.macro_count = static_cast<int>(nq);
  model_.metric.resize(nq + elements);
  model_.metric.head(nq) =
      (basis_.transpose() * full.metric.head(full.macro_count).asDiagonal() * basis_).diagonal();
  model_.metric.tail(elements) = full.metric.tail(elements);
  model_.macro_square = basis_.transpose() * basis_;
  if (full.held.cols() > 0) {
    model_.held.resize(nq + elements, full.held.cols());
    model_.held.topRows(nq).setZero();
    model_.held.bottomRows(elements) = full.held.bottomRows(elements);
  }
}

State HeldModel::restricted(const State& full) const
{
  State s = full;
  s.macro = back_ * full.macro;
  return s;
}

State HeldModel::full(const State& restricted) const
{
  State s = restricted;
  s.macro = basis_ * restricted.macro;
  return s;
}

}  // namespace hauberk
