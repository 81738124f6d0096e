#include "random_pairs.hpp"

#include <cmath>

namespace hauberk::brute {
namespace {

using std::numbers::pi;
constexpr Sampling coarse{256, 48, 24};

class Draw {
 public:
  explicit Draw(long k) : kind_(k % 3), family_(static_cast<Family>((k / 3) % family_count))
  {
    std::seed_seq seed{k, 20250L};
    rng_.seed(seed);
  }

  TorusPair pair()
  {
    TorusPair p;
    p.family = family_;
    for (int attempt = 0; attempt < 30; ++attempt) {
      shapes(p);
      place(p);
      if (surface_distance(p.a, p.b, coarse) > 0.0) break;
    }
    // Half of all pairs away from the axes of the world.
    if (chance()) move_together(p.a, p.b, rng_);
    return p;
  }

 private:
  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(rng_); }
  double power(double base, double lo, double hi) { return std::pow(base, uniform(lo, hi)); }
  bool chance() { return (rng_() & 1U) != 0U; }
  /// Zero, or a power of ten down to 1e-9.
  double tiny() { return chance() ? 0.0 : power(10.0, -9.0, -1.0); }

  Torus shape(double R, bool round)
  {
    Torus t;
    t.R = R;
    t.r0 =
        R * (family_ == Family::thin ? uniform(0.01, 0.05) : power(10.0, std::log10(0.02), std::log10(0.6)));
    t.r1 = round ? t.r0 : t.r0 * power(5.0, -1.0, 1.0);
    return t;
  }

  void shapes(TorusPair& p)
  {
    const bool first_round = kind_ == 0 || (kind_ == 1 && chance());
    const bool second_round = kind_ == 0 || (kind_ == 1 && !first_round);
    p.a = shape(1.0, first_round);
    p.b = shape(family_ == Family::tightly_linked ? power(3.0, -1.0, 1.0) : power(10.0, -1.0, 1.0),
                second_round);
  }

  void place(TorusPair& p)
  {
    const double reach = p.a.bound() + p.b.bound();
    Torus& b = p.b;
    switch (family_) {
      case Family::coplanar:
        b.axes = rotation_exp(tiny() * any_direction(rng_));
        b.center = Vec3(uniform(0.0, 1.2) * reach, 0.0, tiny());
        break;
      case Family::coaxial:
        b.axes = rotation_exp(tiny() * any_direction(rng_));
        b.center = Vec3(tiny(), 0.0, uniform(-1.0, 1.0) * (p.a.r1 + b.r1) * 2.0);
        break;
      case Family::through_center:
        b.axes = chance() ? rotation_exp(Vec3(0.5 * pi, 0.0, 0.0)) : any_rotation(rng_);
        b.center = p.a.center - b.R * b.axes.col(0);
        break;
      case Family::symmetric: {
        static const Vec3 turns[] = {Vec3(0.5 * pi, 0, 0), Vec3(0, 0.5 * pi, 0), Vec3(0, 0, 0)};
        b.axes = rotation_exp(turns[rng_() % 3]);
        b.center = Vec3::Zero();
        b.center[static_cast<int>(rng_() % 3)] = uniform(0.0, 1.1) * reach;
        break;
      }
      case Family::tightly_linked:
      case Family::thin:
        b.axes = any_rotation(rng_);
        b.center = p.a.R * Vec3(1, 0, 0) + uniform(0.0, 0.8) * std::min(p.a.R, b.R) * any_direction(rng_);
        break;
      default:
        b.axes = any_rotation(rng_);
        b.center = uniform(0.0, 1.2) * reach * any_direction(rng_);
    }
    if (family_ == Family::tightly_linked || family_ == Family::nearly_tangent) push(p);
  }

  /// Moves b along the closest direction until the gap is as small as drawn; gives up on overlap.
  void push(TorusPair& p)
  {
    const double target = power(10.0, -9.0, -2.0);
    for (int k = 0; k < 12; ++k) {
      const bool probe_a = p.a.round() || !p.b.round();
      const Torus &P = probe_a ? p.a : p.b, &F = probe_a ? p.b : p.a;
      const BruteMinimum m = all_minima(P, F, coarse).front();
      if (m.distance <= 0.0 || std::abs(m.distance - target) < 1e-3 * target) return;
      const Foot f = foot(F, P.round() ? P.core(m.u) : P.surface(m.u, m.v));
      p.b.center += (probe_a ? 1.0 : -1.0) * (m.distance - target) * f.normal;
    }
  }

  long kind_;
  Family family_;
  std::mt19937_64 rng_;
};

}  // namespace

std::string name(Family family)
{
  static const char* const names[] = {"anywhere",       "coplanar",       "coaxial",   "nearly tangent",
                                      "tightly linked", "through centre", "symmetric", "thin"};
  return names[static_cast<int>(family)];
}

Vec3 any_direction(std::mt19937_64& rng)
{
  std::normal_distribution<double> normal;
  const double x = normal(rng), y = normal(rng), z = normal(rng);
  return Vec3(x, y, z).normalized();
}

void move_together(Torus& a, Torus& b, std::mt19937_64& rng)
{
  const Mat3 Q = any_rotation(rng);
  const Vec3 shift = 2.0 * any_direction(rng);
  for (Torus* t : {&a, &b}) {
    t->center = Q * t->center + shift;
    t->axes = Q * t->axes;
  }
}

Mat3 any_rotation(std::mt19937_64& rng)
{
  std::normal_distribution<double> normal;
  const double w = normal(rng), x = normal(rng), y = normal(rng), z = normal(rng);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

TorusPair random_pair(long k) { return Draw(k).pair(); }

}  // namespace hauberk::brute
