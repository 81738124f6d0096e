#include "equilibrium/quadratic_model.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Shift that null directions carry, relative to the largest scaled diagonal of the Hessian (rounding) and
/// to the load (curvatures below it do not matter).
constexpr double rounding_shift = 1e-14;
constexpr double load_shift = 1e-7;

/// Curvature below -this times the load counts as a saddle.
constexpr double saddle_curvature = 1e-5;

constexpr double longest_escape = 0.05;  ///< L: of a step along negative curvature

}  // namespace

double QuadraticModel::change(const TotalEnergy& e, const Vector& dy, double fraction) const
{
  return fraction * e.gradient.dot(dy) + 0.5 * fraction * fraction * dy.dot(curvature_->times(dy));
}

ModelStep QuadraticModel::newton_step(const TotalEnergy& e, double radius)
{
  ModelStep s;
  const double scale = curvature_->scale();
  const double floor = std::max(load_shift * load_norm_, rounding_shift * scale);
  double lambda = floor, too_low = 0.0;
  const auto raise = [&] {
    too_low = lambda;
    lambda = std::max(8.0 * lambda, 1e-4 * load_norm_);
    s.shifted = true;
  };
  // Shifts that a known direction of negative curvature rules out are not tried.
  if (soft_.size() > 0) {
    const double needed = -soft_.dot(curvature_->times(soft_));
    while (lambda <= needed) raise();
  }
  bool softened = false;
  for (int it = 0; it < 60; ++it) {
    if (!curvature_->factor(lambda)) {
      raise();
      continue;
    }
    if (s.shifted && !softened) soften();
    softened = true;
    s.dy = -curvature_->solve(e.gradient);
    s.lambda = lambda;
    const double norm = step_norm(m_, s.dy);
    if (norm <= 1.1 * radius) break;
    // Newton on the secular equation 1/norm(lambda) = 1/radius.
    const Vector w = m_.metric.cwiseProduct(s.dy);
    const double q = w.dot(curvature_->solve(w));
    double next = lambda + (norm * norm / q) * (norm - radius) / radius;
    if (!(next > lambda)) next = 2.0 * lambda;
    lambda = std::max(next, too_low * 1.5);
    if (lambda > 2.0 * floor) s.shifted = true;
  }
  if (s.dy.size() == 0) {
    throw ComputationError(fmt::format(
        "the curvature of a state with a smallest gap of {:.1e} L cannot be factorised at any shift",
        e.contact.min_gap));
  }
  s.predicted = -change(e, s.dy);
  if (s.predicted < 0.0) s.predicted = -0.5 * e.gradient.dot(s.dy);
  return s;
}

/// Turns `soft_` towards the direction of least curvature, by inverse iteration with what was factored.
void QuadraticModel::soften()
{
  int steps = 2;
  if (soft_.size() == 0) {
    steps = 5;
    soft_ = unsymmetric(m_.dofs());
  }
  for (int k = 0; k < steps; ++k) {
    soft_ = curvature_->solve(m_.metric.cwiseProduct(soft_));
    soft_ /= step_norm(m_, soft_);
  }
}

bool QuadraticModel::saddle_step(const TotalEnergy& e, double radius, ModelStep& s)
{
  Vector d;
  const double lowest = curvature_->lowest(s.lambda, d);
  if (lowest > -std::max(saddle_curvature * load_norm_, 10.0 * rounding_shift * curvature_->scale()))
    return false;
  const double slope = e.gradient.dot(d);
  if (slope > 0.0) d = -d;
  const double length = std::min(radius, longest_escape);
  s.dy = length * d;
  s.predicted = -change(e, s.dy);
  s.shifted = true;
  return true;
}

}  // namespace hauberk
