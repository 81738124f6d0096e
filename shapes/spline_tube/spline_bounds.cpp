#include "spline_solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <queue>

namespace hauberk {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Outward normals of a ball at its circle: the cone m . T = -rho.
struct Cone {
  Vec3 T;
  double rho = 0.0, sigma = 1.0;

  explicit Cone(const BallSpline::Derivatives& d)
  {
    const Vec3 speed = d[1].head<3>();
    T = speed.normalized();
    rho = d[1][3] / speed.norm();
    sigma = std::sqrt(std::max(0.0, 1.0 - rho * rho));
  }
  /// The largest m . x.
  double most(const Vec3& x) const
  {
    const double along = T.dot(x);
    return -rho * along + sigma * (x - along * T).norm();
  }
};

/// How far the normals of a stretch turn from those of its middle: by the turn of the tangent, at most A/V a
/// unit of t, and by the change of the cone's angle, whose cosine changes by r''/V + r' A/V^2.
double normals_turn(const Stretch& s)
{
  if (!(s.slowest > 0.0)) return 2.0;
  const double slope = s.radius[1] / s.slowest;
  const double across = std::sqrt(std::max(1e-300, 1.0 - slope * slope));
  const double turn = s.centre[2] / s.slowest;
  return std::min(2.0, s.half * (turn + (s.radius[2] / s.slowest + slope * turn) / across));
}

/// (C^2 - R^2)/(2 E) - r: the radius h of the ball outside that touches where the normal is m and just
/// reaches a ball of the spline further on, from |c_t + (r_t + h) m - c_s| = h + r_s. Here C is the distance
/// of centres, R the difference of radii and E = -(m . (c_t - c_s) + r_t - r_s); all by the same power of
/// t - s. A lower bound where C, and R, E and r, are bounds from below and from above; of a ball that may be
/// within another one there is none.
double touching(double C, double R, double E, double r)
{
  if (!(C >= std::abs(R))) return -infinity;
  return E > 0.0 ? 0.5 * (C * C - R * R) / E - r : infinity;
}

/// A stretch with its cone of normals, and its halves once they are asked for.
struct Place {
  Stretch stretch;
  Cone cone;
  double turns;
  std::array<Place*, 2> halves{};

  explicit Place(const Stretch& of) : stretch(of), cone(of.d), turns(normals_turn(of)) {}
};

/// Two places and a lower bound of the ball's radius where it touches in the one and reaches the other.
struct Pair {
  Place *t, *s;
  double bound = 0.0;

  bool operator<(const Pair& other) const { return bound > other.bound; }  // the least first
};

class ReachBound {
 public:
  explicit ReachBound(const BallSpline& spline) : spline_(spline), pieces_(stretches(spline, 1)) {}

  /// Of all pairs; with `enough`, of as many as tell that it is above that.
  double of_all(double enough = infinity)
  {
    // Of a ring all pairs are nearly as close as the closest, which many small pairs had to tell: the bound
    // may be half of the reach, which makes contact slower and nothing wrong.
    constexpr double tight = 0.95;
    constexpr int most_pairs = 20000;
    const int parts = spline_.period() > 16 ? 1 : 2;
    std::vector<Place*> all;
    for (int k = 0; k < spline_.period(); ++k)
      for (int i = 0; i < parts; ++i) all.push_back(&place(k, (i + 0.5) / parts, 0.5 / parts));
    for (Place* t : all)
      for (Place* s : all) push(*t, *s, -infinity);
    for (int count = 0; !queue_.empty(); ++count) {
      const Pair pair = queue_.top();
      if (!(least_ > 0.0)) return least_;
      if (pair.bound >= std::min(enough, tight * least_) || count >= most_pairs) return pair.bound;
      queue_.pop();
      for (Place* t : halves(*pair.t))
        for (Place* s : halves(*pair.s)) push(*t, *s, pair.bound);
    }
    return infinity;  // nothing is ever reached: not of closed curves
  }

 private:
  Place& place(int piece, double at, double half)
  {
    return places_.emplace_back(Stretch(spline_, piece, at, half));
  }
  /// Made once, as a place is in many pairs.
  const std::array<Place*, 2>& halves(Place& of)
  {
    const Stretch& s = of.stretch;
    if (of.halves[0] == nullptr)
      of.halves = {&place(s.piece, s.at - 0.5 * s.half, 0.5 * s.half),
                   &place(s.piece, s.at + 0.5 * s.half, 0.5 * s.half)};
    return of.halves;
  }

  void push(Place& t, Place& s, double parent)
  {
    const double bound = std::max({parent, apart(t, s), near(t, s)});
    sample(t, s);
    if (bound < infinity) queue_.push({&t, &s, bound});
  }

  /// t - s, less than half a period.
  double between(const Stretch& t, const Stretch& s) const
  {
    const double n = spline_.period(), apart = t.t() - s.t();
    return apart - n * std::round(apart / n);
  }

  /// An upper bound of the least: what it is in the middles.
  void sample(const Place& at_t, const Place& at_s)
  {
    const Stretch &t = at_t.stretch, &s = at_s.stretch;
    const Cone& cone = at_t.cone;
    if (t.piece == s.piece && t.at == s.at) {
      least_ = std::min(least_, touching(t.d[1].head<3>().norm(), t.d[1][3],
                                         0.5 * (cone.most(t.d[2].head<3>()) + t.d[2][3]), t.d[0][3]));
    } else {
      const Vec3 D = s.d[0].head<3>() - t.d[0].head<3>();
      const double R = s.d[0][3] - t.d[0][3];
      least_ = std::min(least_, touching(D.norm(), R, cone.most(D) + R, t.d[0][3]));
    }
  }

  /// Of stretches wherever they are. E = m . (c_s - c_t) + r_s - r_t: while t changes and m turns with the
  /// tangent, it changes by m' . (c_s - c_t) alone, as m . c'_t = -r'_t; while s does, by m . c'_s + r'_s,
  /// which is small where s is near t.
  static double apart(const Place& at_t, const Place& at_s)
  {
    const Stretch &t = at_t.stretch, &s = at_s.stretch;
    const Cone& cone = at_t.cone;
    const Vec3 D = s.d[0].head<3>() - t.d[0].head<3>(), speed = s.d[1].head<3>();
    const double R = s.d[0][3] - t.d[0][3], off = t.centre[0] + s.centre[0];
    const double turns = at_t.turns;
    const double slope = std::max(cone.most(speed) + s.d[1][3], cone.most(-speed) - s.d[1][3]);
    const double E = cone.most(D) + R + (D.norm() + off) * turns +
                     s.half * (slope + s.centre[1] * turns + 0.5 * s.half * (s.centre[2] + s.radius[2]));
    return touching(D.norm() - off, std::abs(R) + t.radius[0] + s.radius[0], E, t.thickest);
  }

  /// Of stretches within a piece of each other, by divided differences: c_s = c_t + c'(t) e + c2 e^2, whose
  /// first order is 0 in E, as m . c' = -r'. From the middle of t to both of them c' changes by at most |c''|
  /// times the way, and c2 is within half of |c'''| times it of c''/2.
  double near(const Place& at_t, const Place& at_s) const
  {
    const Stretch &t = at_t.stretch, &s = at_s.stretch;
    const double far = std::max(std::abs(between(t, s)) + s.half, t.half);
    if (far > 1.0) return -infinity;
    double A = 0.0, rA = 0.0, J = 0.0, rJ = 0.0;
    const int n = spline_.period();
    for (int k = t.piece + n - 1; k <= t.piece + n + 1; ++k) {
      const Stretch& piece = pieces_[static_cast<std::size_t>(k % n)];
      A = std::max(A, piece.centre[2]), rA = std::max(rA, piece.radius[2]);
      J = std::max(J, piece.centre[3]), rJ = std::max(rJ, piece.radius[3]);
    }
    const double C = t.d[1].head<3>().norm() - A * far, R = std::abs(t.d[1][3]) + rA * far;
    const Vec3 c2 = 0.5 * t.d[2].head<3>();
    const double off = 0.5 * J * far, off_R = 0.5 * rJ * far;
    const double E = at_t.cone.most(c2) + 0.5 * t.d[2][3] + off + off_R + (c2.norm() + off) * at_t.turns;
    return touching(C, R, E, t.thickest);
  }

  const BallSpline& spline_;
  std::vector<Stretch> pieces_;  ///< whole ones
  std::deque<Place> places_;     ///< all that were made; addresses stay
  std::priority_queue<Pair> queue_;
  double least_ = infinity;
};

}  // namespace

double reach_bound(const BallSpline& spline) { return ReachBound(spline).of_all(); }

bool meets_itself(const BallSpline& spline)
{
  return !(ReachBound(spline).of_all(std::numeric_limits<double>::min()) > 0.0);
}

double change_bound(const BallSpline& spline)
{
  // f(x) = F(x, t) where F_t = 0, F = |x - c| - r, so that along a unit vector w, with t' = -F_xt w/F_tt,
  //   D^3 f = F_xxx + 3 F_xxt t' + 3 F_xtt t'^2 + F_ttt t'^3.
  // On the surface, |x - c| = r and n . c' = -r', and w is across n: F_xxx = 0, |F_xxt| = |r'|/r^2,
  // |F_xt| <= |c'|/r, |F_xtt| <= |c''|/r + 2 |c'| |r'|/r^2.
  double most = 0.0;
  for (const Stretch& s : stretches(spline, fine)) {
    const double V = s.centre[1], A = s.centre[2], r = s.thinnest, slope = s.radius[1];
    const double bend = (s.slowest * s.slowest - slope * slope) / s.thickest -
                        (Cone(s.d).most(s.d[2].head<3>()) + s.d[2][3] + s.half * (s.centre[3] + s.radius[3]) +
                         A * normals_turn(s));
    if (!(r > 0.0 && bend > 0.0)) return infinity;
    const double ttt = (3.0 * V * A + 3.0 * slope * (V * V / r + A)) / r + s.centre[3] + s.radius[3];
    const double moves = V / (r * bend);
    most = std::max(most, moves * (3.0 * slope / (r * r) +
                                   moves * (3.0 * (A / r + 2.0 * V * slope / (r * r)) + moves * ttt)));
  }
  return most * (1.0 + 1e-12);
}

}  // namespace hauberk
