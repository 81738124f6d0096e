#include "limits/kinks.hpp"

#include "equilibrium/gaps.hpp"
#include "numerics/linear_program.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Gaps below so many times the last activation distance are closed at the limit.
constexpr double active = 100.0;
/// Gradients that depend on others up to this part of the largest depend on them: they are those of a state
/// that is off the limit by about the last activation distance.
constexpr double dependent = 1e-6;
/// Multipliers that miss the load by more than this part of it are none; what programs count as zero.
constexpr double most_missed = 1e-4, zero = 1e-9;
/// Sides that differ by less than this part of the larger are equal.
constexpr double same_sides = 1e-5;

/// Closed gaps and walls: derivatives in unknowns, scaled to steps of unit norm, and in parameters.
struct Closed {
  Matrix normals;     ///< dofs x contacts
  Matrix parameters;  ///< all parameters of all elements x contacts
  Vector clearance;
};

std::vector<Eigen::Index> first_parameters(const Model& m)
{
  std::vector<Eigen::Index> first{0};
  for (const int count : m.parameter_count) first.push_back(first.back() + count);
  return first;
}

Closed closed_contacts(const Model& m, const State& s, double within)
{
  const Vector root = m.metric.cwiseSqrt().cwiseInverse();
  const std::vector<Gap> gaps = find_gaps(m, s, within, true);
  std::vector<Vector> walls;
  for (const LinearInequality& w : m.walls) {
    double gap = w.offset;
    Vector normal = Vector::Zero(m.dofs());
    for (const LinearTerm& t : w.terms) {
      gap += t.coefficient * s.e[t.element * m.coordinate_count + t.coordinate];
      normal[m.offset(t.element) + t.coordinate] += t.coefficient;
    }
    if (gap < within) walls.push_back(std::move(normal));
  }
  const std::vector<Eigen::Index> first = first_parameters(m);
  const auto count = static_cast<Eigen::Index>(gaps.size() + walls.size());
  Closed out{Matrix::Zero(m.dofs(), count), Matrix::Zero(first.back(), count), Vector::Zero(count)};
  Eigen::Index k = 0;
  for (const Gap& g : gaps) {
    out.normals.col(k) = root.cwiseProduct(free_part(m, g.dy));
    const std::size_t a = m.bodies[g.a].element, b = m.bodies[g.b].element;
    out.parameters.col(k).segment(first[a], g.da.size()) += g.da;
    out.parameters.col(k).segment(first[b], g.db.size()) += g.db;
    out.clearance[k++] = -1.0;
  }
  for (const Vector& normal : walls) out.normals.col(k++) = root.cwiseProduct(free_part(m, normal));
  return out;
}

/// The balance of forces, load + N f = 0, as orthonormal rows: rows f = wanted.
struct Balance {
  Matrix rows;
  Vector wanted;
};

/// Null: f is unique, or no f balances the load.
std::optional<Balance> independent_rows(const Matrix& normals, const Vector& load)
{
  Eigen::ColPivHouseholderQR<Matrix> qr(normals);  // N P = Q R
  qr.setThreshold(dependent);
  const Eigen::Index rank = qr.rank(), count = normals.cols();
  if (rank == count) return std::nullopt;
  const Vector turned = qr.householderQ().transpose() * load;
  if (turned.tail(turned.size() - rank).norm() > most_missed) return std::nullopt;
  // R^T = Z T, hence Z^T (P^T f) = -T^-T (Q^T load).
  const Matrix R = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
  const Eigen::HouseholderQR<Matrix> second(R.transpose());
  const Matrix Z = second.householderQ() * Matrix::Identity(count, rank);
  const Matrix T = second.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
  return Balance{Z.transpose() * qr.colsPermutation().transpose(),
                 -T.transpose().triangularView<Eigen::Lower>().solve(turned.head(rank))};
}

/// Extremes of sum f_k c_k over the multipliers: {towards smaller, towards larger} of a value that is
/// maximised.
std::optional<std::array<double, 2>> sides(LinearProgram& multipliers, const Vector& c)
{
  const std::optional<double> larger = multipliers.least(c), smaller = multipliers.least(-c);
  if (!larger || !smaller) return std::nullopt;
  return std::array{-*smaller, *larger};
}

bool differ(const std::array<double, 2>& s)
{
  return !(std::abs(s[1] - s[0]) <= same_sides * std::max(std::abs(s[0]), std::abs(s[1])));
}

}  // namespace

namespace {

/// `falls`: the value is the load's, with the sign changed.
std::optional<OneSidedSensitivities> sides_at(const Model& m, const State& state, const Vector& pull,
                                              double within_gap, bool falls)
{
  const Closed closed = closed_contacts(m, state, within_gap);
  if (closed.normals.cols() < 2) return std::nullopt;
  Vector load = Vector::Zero(m.dofs());
  load.head(m.macro_count) = pull;
  load = m.metric.cwiseSqrt().cwiseInverse().cwiseProduct(free_part(m, load));
  const double size = load.norm();

  const std::optional<Balance> balance = independent_rows(closed.normals, load / size);
  if (!balance) return std::nullopt;
  LinearProgram multipliers(balance->rows, balance->wanted, zero);
  if (!multipliers.feasible()) return std::nullopt;

  OneSidedSensitivities out;
  bool kink = false;
  const auto add = [&](const Vector& c, std::array<double, 2>& to) {
    const auto found = sides(multipliers, c);
    if (!found) return false;
    to = {size * (*found)[0], size * (*found)[1]};
    if (falls) to = {-to[0], -to[1]};
    kink = kink || differ(to);
    return true;
  };
  if (!add(closed.clearance, out.clearance)) return std::nullopt;
  out.parameters.resize(closed.parameters.rows());
  for (Eigen::Index p = 0; p < closed.parameters.rows(); ++p) {
    if (!add(closed.parameters.row(p).transpose(), out.parameters[p])) return std::nullopt;
  }
  return kink ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace

std::optional<OneSidedSensitivities> one_sided_sensitivities(const Model& m, const LimitTask& task,
                                                             const Locked& l)
{
  if (m.sparse() || std::isfinite(l.stage.target) || !traits(l.stage.contact.formulation).is_of_gaps)
    return std::nullopt;
  const double within_gap = active * l.stage.contact.g_hat;
  const bool falls = task.sense == Sense::negative;
  const MacroLoad load = macro_load(m, task.direction, task.sense);
  if (load.held.cols() == 0) return sides_at(m, l.state, load.pull, within_gap, falls);
  const HeldModel held(m, load.held);
  return sides_at(held.model(), held.restricted(l.state), held.pull(load.pull), within_gap, falls);
}

}  // namespace hauberk
