#include "equilibrium/stage.hpp"

#include "contact/published.hpp"
#include "equilibrium/curvature.hpp"

#include <cmath>

namespace hauberk {

SafeStep checked_step(const Model& m, const State& from, const Vector& dy, double keep, const Stage& stage,
                      GapBounds* bounds)
{
  if (stage.ccd == CollisionCheck::certified || traits(stage.contact.formulation).is_of_meshes)
    return largest_safe_step(m, from, dy, keep, stage.contact.threads, bounds, stage.contact.keep_going);
  return sampled_safe_step(m, from, dy, std::sqrt(published::d_th) * stage.contact.g_hat);
}

std::vector<ElementPair> stage_pairs(const Model& m, const State& s, const Stage& stage)
{
  return near_pairs(m, s, stage.contact.g_hat + stage.contact.clearance);
}

namespace {

/// K of what the objective adds to -load . macro, 1/2 macro . K macro; empty: nothing.
Matrix macro_stiffness(const Model& m, const Stage& stage)
{
  const bool finite = std::isfinite(stage.target);
  if (!finite && stage.tether.cols() == 0) return {};
  Matrix K = Matrix::Zero(m.macro_count, m.macro_count);
  if (finite && m.macro_square.size() > 0)
    K = m.macro_square / stage.target;
  else if (finite)
    K.diagonal().setConstant(1.0 / stage.target);
  if (stage.tether.cols() > 0) K += stage.tether_stiffness * stage.tether * stage.tether.transpose();
  return K;
}

/// With that K.
Vector driving_load(const Matrix& K, const State& s, const Vector& load)
{
  return K.size() > 0 ? Vector(load - K * s.macro) : load;
}

}  // namespace

double load_size(const Model& m, const Vector& load)
{
  return std::sqrt((load.cwiseAbs2().array() / m.metric.head(m.macro_count).array()).sum());
}

Vector driving_load(const Model& m, const State& s, const Vector& load, const Stage& stage)
{
  return driving_load(macro_stiffness(m, stage), s, load);
}

TotalEnergy total_energy(const Model& m, const State& s, const Vector& load, const Stage& stage,
                         const std::vector<ElementPair>& pairs, int order, const GapBounds* bounds)
{
  TotalEnergy t;
  Request request;
  request.order = order;
  t.contact = contact_energy(m, s, pairs, stage.contact, request, bounds);
  t.admissible = t.contact.min_gap > 0.0;
  t.energy = stage.mu * t.contact.energy - load.dot(s.macro);
  const Matrix K = macro_stiffness(m, stage);
  if (order >= 1) {
    t.gradient = stage.mu * t.contact.gradient;
    t.gradient.head(m.macro_count) -= driving_load(K, s, load);
  }
  if (order >= 2) {
    t.hessian = stage.mu * t.contact.hessian;
    t.sparse_hessian = stage.mu * t.contact.sparse_hessian;
  }
  if (K.size() > 0) {
    t.energy += 0.5 * s.macro.dot(K * s.macro);
    for (int k = 0; order >= 2 && k < m.macro_count; ++k) {
      for (int l = 0; l < (m.sparse() ? k + 1 : m.macro_count); ++l)
        (m.sparse() ? t.sparse_hessian.coeffRef(k, l) : t.hessian(k, l)) += K(k, l);
    }
  }
  if (m.held.cols() > 0) {
    if (order >= 1) t.gradient = free_part(m, t.gradient);
    if (order >= 2 && !m.sparse()) hold(m, t.hessian);
  }
  return t;
}

}  // namespace hauberk
