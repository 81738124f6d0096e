#include "geometry/closed_curve.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace hauberk {
namespace {

/// Samples for a harmonic: the largest value of a function of frequency K between samples is beyond the
/// largest sample by at most pi/(samples per harmonic) of the bound of its derivative over K.
constexpr int samples_per_harmonic = 256;

double step_of(const std::vector<Harmonic>& harmonics)
{
  return 2.0 * std::numbers::pi / static_cast<double>(samples_per_harmonic * harmonics.size());
}

/// Calls visit(x, x', x'', x''') at points evenly spaced in u.
template <typename Visit>
void sample(const std::vector<Harmonic>& harmonics, Visit&& visit)
{
  const int count = samples_per_harmonic * static_cast<int>(harmonics.size());
  for (int i = 0; i < count; ++i) {
    const double u = i * step_of(harmonics);
    std::array<Vec3, 4> x{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    double k = 0.0;
    for (const Harmonic& h : harmonics) {
      k += 1.0;
      const double c = std::cos(k * u), s = std::sin(k * u);
      const Vec3 even = c * h.c + s * h.s, odd = k * (c * h.s - s * h.c);
      x[0] += even;
      x[1] += odd;
      x[2] -= k * k * even;
      x[3] -= k * k * odd;
    }
    visit(x);
  }
}

}  // namespace

ClosedCurve::ClosedCurve(std::vector<Harmonic> harmonics, double scale) : harmonics_(std::move(harmonics))
{
  std::array<double, 5> sums{};  // |x^(m)| <= sum k^m (|c_k| + |s_k|)
  double k = 0.0;
  for (Harmonic& h : harmonics_) {
    k += 1.0;
    h.c *= scale;
    h.s *= scale;
    double term = h.c.norm() + h.s.norm();
    for (double& sum : sums) {
      sum += term;
      term *= k;
    }
  }
  sample(harmonics_, [this](const std::array<Vec3, 4>& x) {
    for (std::size_t m = 0; m < 4; ++m) bounds_[m] = std::max(bounds_[m], x[m].norm());
    const double speed = x[1].norm();
    bend_ = std::min(bend_, speed > 0.0 ? speed * speed * speed / x[1].cross(x[2]).norm() : 0.0);
  });
  for (std::size_t m = 0; m < 4; ++m)
    bounds_[m] = std::min(sums[m], bounds_[m] + 0.5 * step_of(harmonics_) * sums[m + 1]);
}

CurvePoint ClosedCurve::at(const Angle& u) const
{
  CurvePoint p{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double c = 1.0, s = 0.0, k = 0.0;
  for (const Harmonic& h : harmonics_) {
    const double next = c * u.c - s * u.s;
    s = s * u.c + c * u.s;
    c = next;
    k += 1.0;
    const Vec3 even = c * h.c + s * h.s;
    p.x += even;
    p.xu += k * (c * h.s - s * h.c);
    p.xuu -= (k * k) * even;
  }
  return p;
}

double mean_radius(const std::vector<Harmonic>& harmonics)
{
  double sum = 0.0;
  for (const Harmonic& h : harmonics) sum += h.c.squaredNorm() + h.s.squaredNorm();
  return std::sqrt(0.5 * sum);
}

}  // namespace hauberk
