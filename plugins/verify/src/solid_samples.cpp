#include "solid_samples.hpp"

#include "surface.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::verification {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
/// Samples along each coordinate, away from the planes of symmetry that a chart may have.
constexpr int count = 12;
constexpr double shift = 0.37;

double sample(int k) { return full_turn * (k + shift) / count; }

struct Sampled {
  double u = 0.0, v = 0.0;
  Vec3 x = Vec3::Zero();
};

class Samples {
 public:
  Samples(const Solid& solid, double tolerance) : solid_(solid), allowed_(tolerance * solid.radius())
  {
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        chart_.push_back({sample(i), sample(j), solid.surface_point(probe_angles(sample(i), sample(j)))});
  }

  std::string disagreement() const
  {
    for (const Sampled& s : chart_)
      if (std::string found = at(s); !found.empty())
        return fmt::format("{} (u = {:.6g}, v = {:.6g})", found, s.u, s.v);
    if (solid_.probe_dimension() == 1) return across_core();
    return {};
  }

 private:
  bool off(double found, double expected) const { return !(std::abs(found - expected) <= allowed_); }

  std::string at(const Sampled& s) const
  {
    const SolidDistance here = solid_.distance(s.x);
    if (off(here.distance, 0.0))
      return fmt::format("its distance is {:.3g} at a point of its chart", here.distance);
    if (s.x.norm() > solid_.radius() + allowed_)
      return fmt::format("a point of its chart is {:.9g} from its origin, its radius {:.9g}", s.x.norm(),
                         solid_.radius());
    const double reach = solid_.smoothness().reach, out = 0.1 * std::min(solid_.thickness(), reach);
    if (const double beyond = solid_.distance(s.x + out * here.normal).distance;
        reach > 0.0 && off(beyond, out))
      return fmt::format("{:.3g} beyond a point of its chart its distance is {:.9g}", out, beyond);
    if (std::string found = outside(1.5 * solid_.radius() * here.normal); !found.empty()) return found;
    if (solid_.probe_dimension() == 1) {
      if (const double away = from_core(s.x); off(away, solid_.offset()))
        return fmt::format("a point of its chart is {:.9g} from its core, its offset {:.9g}", away,
                           solid_.offset());
      return {};
    }
    const double probe = solid_.distance(solid_.probe(probe_angles(s.u, s.v)).x).distance;
    return off(probe, 0.0) ? fmt::format("its distance is {:.3g} at a point of its probe", probe) : "";
  }

  std::string outside(const Vec3& x) const
  {
    const double stated = solid_.distance(x).at_least;
    for (const Sampled& s : chart_)
      if ((x - s.x).norm() < stated - allowed_)
        return fmt::format("it states a distance of at least {:.9g}, and a point of its chart is {:.9g} away",
                           stated, (x - s.x).norm());
    return {};
  }

  /// Distance from the core by sampling, and by thirds around the lowest sample.
  double from_core(const Vec3& x) const
  {
    constexpr int samples = 360;
    const auto away = [&](double u) { return (solid_.probe(probe_angles(u, 0.0)).x - x).norm(); };
    double nearest = 0.0;
    for (int k = 1; k < samples; ++k)
      if (away(full_turn * k / samples) < away(nearest)) nearest = full_turn * k / samples;
    double low = nearest - full_turn / samples, high = nearest + full_turn / samples;
    for (int k = 0; k < 60; ++k) {
      const double first = low + (high - low) / 3.0, second = high - (high - low) / 3.0;
      if (away(first) < away(second))
        high = second;
      else
        low = first;
    }
    return away(0.5 * (low + high));
  }

  std::string across_core() const
  {
    for (int i = 0; i < count; ++i) {
      const ProbeDerivatives core = solid_.probe(probe_angles(sample(i), 0.0));
      const Vec3 first = core.u.unitOrthogonal(), second = core.u.normalized().cross(first);
      for (int j = 0; j < count; ++j) {
        const Vec3 x =
            core.x + solid_.offset() * (std::cos(sample(j)) * first + std::sin(sample(j)) * second);
        if (const double there = solid_.distance(x).distance; off(there, 0.0))
          return fmt::format("its distance is {:.3g} at the offset from its core (u = {:.6g})", there,
                             sample(i));
      }
    }
    return {};
  }

  const Solid& solid_;
  double allowed_;
  std::vector<Sampled> chart_;
};

}  // namespace

std::string disagreement(const Solid& solid, double tolerance)
{
  return Samples(solid, tolerance).disagreement();
}

}  // namespace hauberk::verification
