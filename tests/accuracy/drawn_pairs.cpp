#include "drawn_pairs.hpp"

#include "random_pairs.hpp"

#include <cmath>

namespace hauberk::brute {
namespace {

class Drawing {
 public:
  Drawing(PairKind kind, long k) : kind_(kind)
  {
    std::seed_seq seed{static_cast<long>(kind), k, 20261L};
    rng_.seed(seed);
    pair_.family = static_cast<DrawFamily>(k % draw_family_count);
  }

  DrawnPair draw()
  {
    for (int attempt = 0; attempt < 30 && pair_.distance <= 0.0; ++attempt) {
      shapes();
      place();
      pair_.distance = nearest_place(pair_.a, pair_.b).distance;
      if (pair_.family == DrawFamily::near_touching) push();
    }
    turn_all();
    return pair_;
  }

 private:
  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(rng_); }
  double power(double lo, double hi) { return lo * std::pow(hi / lo, uniform(0.0, 1.0)); }
  bool chance() { return (rng_() & 1U) != 0U; }
  /// Zero, or a power of ten down to 1e-9.
  double tiny() { return chance() ? 0.0 : power(1e-9, 0.1); }

  Torus shape(double R, bool round)
  {
    Torus t;
    t.R = R;
    const bool flat = pair_.family == DrawFamily::flat;
    if (round) {
      t.r0 = R * (flat                               ? uniform(0.5, 0.9)
                  : pair_.family == DrawFamily::thin ? power(3e-3, 0.03)
                                                     : power(0.02, 0.6));
      t.r1 = t.r0;
      return t;
    }
    const double aspect = flat ? power(3.0, 30.0) : power(1.0, 5.0);
    const double wide = R * (pair_.family == DrawFamily::thin ? power(6e-3, 0.03) : power(0.05, 0.7));
    t.r0 = chance() ? wide : wide / aspect;
    t.r1 = t.r0 == wide ? wide / aspect : wide;
    return t;
  }

  void shapes()
  {
    const bool mixed = kind_ == PairKind::round_elliptical;
    const bool first_round = kind_ == PairKind::round_round || (mixed && chance());
    const bool second_round = kind_ == PairKind::round_round || (mixed && !first_round);
    double ra = 1.0, rb = power(0.2, 5.0);
    if (pair_.family == DrawFamily::linked || pair_.family == DrawFamily::thin) rb = power(0.5, 2.0);
    if (pair_.family == DrawFamily::extreme_ratio) {
      rb = 1.0 / power(10.0, 300.0);
      if (chance()) std::swap(ra, rb);
    }
    pair_.a = shape(ra, first_round);
    pair_.b = shape(rb, second_round);
  }

  void place()
  {
    const Torus& a = pair_.a;
    Torus& b = pair_.b;
    const double reach = a.bound() + b.bound();
    b.axes = any_rotation(rng_);
    switch (pair_.family) {
      case DrawFamily::linked:
      case DrawFamily::thin:
        b.center = a.R * Vec3(1, 0, 0) + uniform(0.0, 0.8) * std::min(a.R, b.R) * any_direction(rng_);
        break;
      case DrawFamily::aligned:
        b.axes = rotation_exp(tiny() * any_direction(rng_));
        b.center = chance() ? Vec3(tiny(), 0.0, uniform(-1.5, 1.5) * (a.r1 + b.r1))
                            : Vec3(uniform(0.0, 1.2) * reach, 0.0, tiny());
        break;
      case DrawFamily::extreme_ratio: {
        // The small ring about the large one's tube, where it matters how long the large one is.
        const Torus &large = a.R > b.R ? a : b, &small = a.R > b.R ? b : a;
        const Vec3 at(large.R, 0.0, 0.0);
        const Vec3 out =
            at + uniform(0.0, 2.0) * (small.bound() + std::max(large.r0, large.r1)) * any_direction(rng_);
        b.center = a.R > b.R ? out : Vec3(-b.axes * out);
        break;
      }
      default:
        b.center = uniform(0.0, 1.2) * reach * any_direction(rng_);
    }
  }

  /// Moves b along the closest direction until the gap is about as small as drawn; gives up on overlap.
  void push()
  {
    const double target = power(1e-12, 1e-2);
    for (int k = 0; k < 4 && pair_.distance > 0.0; ++k) {
      const NearestPlace m = nearest_place(pair_.a, pair_.b);
      pair_.distance = m.distance;
      if (m.distance <= 0.0 || std::abs(m.distance - target) < 0.1 * target) return;
      pair_.b.center -= (m.distance - target) * m.normal;
    }
    pair_.distance = nearest_place(pair_.a, pair_.b).distance;
  }

  /// Half of all pairs away from the axes of the world.
  void turn_all()
  {
    if (chance()) return;
    move_together(pair_.a, pair_.b, rng_);
  }

  PairKind kind_;
  std::mt19937_64 rng_;
  DrawnPair pair_;
};

}  // namespace

std::string name(PairKind kind)
{
  static const char* const names[] = {"round/round", "round/elliptical", "elliptical/elliptical"};
  return names[static_cast<int>(kind)];
}

std::string name(DrawFamily family)
{
  static const char* const names[] = {"generic", "linked", "near touching", "aligned",
                                      "thin",    "flat",   "extreme ratio"};
  return names[static_cast<int>(family)];
}

DrawnPair drawn_pair(PairKind kind, long k) { return Drawing(kind, k).draw(); }

}  // namespace hauberk::brute
