#include "geometry/core.hpp"
#include "geometry/spine.hpp"

#include <hauberk/error.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace hauberk {
namespace {

constexpr double touching = 1e-9;  ///< L: surfaces no farther apart touch
/// Squared distances of circles are polynomials of degree 1 in the sines and cosines of each angle, those of
/// curves of the degree of their harmonics: this many points a degree separate their minima.
constexpr int points_per_degree = 48;
/// Joins nearer than this part of the tubes' radii are one.
constexpr double same_point = 1e-3;

/// Point of a core with its derivatives, element frame.
CurvePoint core_at(const Body& b, double u)
{
  const CurvePoint p = core_at(b, Angle(u));
  return {b.center + b.axes * p.x, b.axes * p.xu, b.axes * p.xuu};
}

/// Parts of a set of cells, each joined with the neighbours that are named to it.
class Parts {
 public:
  explicit Parts(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0U); }
  std::size_t of(std::size_t k)
  {
    while (up_[k] != k) k = up_[k] = up_[up_[k]];
    return k;
  }
  void join(std::size_t a, std::size_t b) { up_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> up_;
};

/// Keeps the deepest of joins that belong to one part.
struct Candidate {
  std::size_t part;
  double depth;
  Join join;
};

/// Descents from neighbouring cells may end at one point, which differs by less than `near` then.
std::vector<Join> one_of_each_part(const std::vector<Candidate>& candidates, double near)
{
  std::vector<Candidate> kept;
  for (const Candidate& c : candidates) {
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Candidate& k) {
      return k.part == c.part || (k.join.common - c.join.common).norm() < near;
    });
    if (same == kept.end()) {
      kept.push_back(c);
    } else if (c.depth < same->depth) {
      *same = c;
    }
  }
  std::vector<Join> out;
  out.reserve(kept.size());
  for (const Candidate& c : kept) out.push_back(c.join);
  return out;
}

/// Descends from a point of the grid to the nearest minimum of |a(u) - b(v)|: Newton's method, halved where
/// it does not fall, along the gradient where the Hessian is not positive.
double nearest_cores(const Body& A, const Body& B, double& u, double& v)
{
  constexpr int most_steps = 60;
  double value = (core_at(A, u).x - core_at(B, v).x).squaredNorm();
  for (int k = 0; k < most_steps; ++k) {
    const CurvePoint a = core_at(A, u), b = core_at(B, v);
    const Vec3 d = a.x - b.x;
    const Eigen::Vector2d gradient(d.dot(a.xu), -d.dot(b.xu));
    Eigen::Matrix2d hessian;
    hessian << a.xu.squaredNorm() + d.dot(a.xuu), -a.xu.dot(b.xu), -a.xu.dot(b.xu),
        b.xu.squaredNorm() - d.dot(b.xuu);
    const double speeds = a.xu.squaredNorm() + b.xu.squaredNorm();
    if (!(speeds > 0.0)) break;  // segments stand still at their ends
    Eigen::Vector2d step = -gradient / speeds;
    if (hessian(0, 0) > 0.0 && hessian.determinant() > 1e-12 * hessian.squaredNorm())
      step = -hessian.inverse() * gradient;
    bool fell = false;
    for (double part = 1.0; part > 1e-6 && !fell; part *= 0.5) {
      const double next = (core_at(A, u + part * step[0]).x - core_at(B, v + part * step[1]).x).squaredNorm();
      if (!(next < value)) continue;
      fell = true;
      value = next;
      u += part * step[0];
      v += part * step[1];
    }
    if (!fell) break;
  }
  return std::sqrt(value);
}

std::vector<Join> joins_of_tubes(const Body& A, const Body& B)
{
  const int na = points_per_degree * core_degree(A), nb = points_per_degree * core_degree(B);
  std::vector<Vec3> a, b;
  for (int i = 0; i < na; ++i) a.push_back(core_at(A, full_turn * i / na).x);
  for (int j = 0; j < nb; ++j) b.push_back(core_at(B, full_turn * j / nb).x);
  const auto cell = [=](int i, int j) {
    return static_cast<std::size_t>((i + na) % na) * static_cast<std::size_t>(nb) +
           static_cast<std::size_t>((j + nb) % nb);
  };
  std::vector<double> distance(static_cast<std::size_t>(na) * static_cast<std::size_t>(nb));
  for (int i = 0; i < na; ++i)
    for (int j = 0; j < nb; ++j) distance[cell(i, j)] = (a[i] - b[j]).norm();
  const double together = A.r0 + B.r0 + touching;
  const double slack = 0.5 * full_turn * (core_bounds(A).first / na + core_bounds(B).first / nb);
  Parts parts(distance.size());
  for (int i = 0; i < na; ++i) {
    for (int j = 0; j < nb; ++j) {
      if (distance[cell(i, j)] > together) continue;
      for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}})
        if (distance[cell(i + di, j + dj)] <= together) parts.join(cell(i, j), cell(i + di, j + dj));
    }
  }
  std::vector<Candidate> found;
  for (int i = 0; i < na; ++i) {
    for (int j = 0; j < nb; ++j) {
      const double here = distance[cell(i, j)];
      if (here > together + slack) continue;
      bool lowest = true;
      for (int di = -1; di <= 1; ++di)
        for (int dj = -1; dj <= 1; ++dj) lowest = lowest && here <= distance[cell(i + di, j + dj)];
      if (!lowest) continue;
      double u = full_turn * i / na, v = full_turn * j / nb;
      const double nearest = nearest_cores(A, B, u, v);
      if (nearest > together) continue;
      const Vec3 xa = core_at(A, u).x, xb = core_at(B, v).x;
      found.push_back(
          {parts.of(cell(i, j)), nearest - together, {u, v, xa + A.r0 / (A.r0 + B.r0) * (xb - xa)}});
    }
  }
  return one_of_each_part(found, same_point * std::min(A.r0, B.r0));
}

/// How far a point is in an elliptical torus: below 1 inside, 1 on the surface.
double level(const Body& torus, const Vec3& x)
{
  const Vec3 p = torus.axes.transpose() * (x - torus.center);
  return std::hypot((std::hypot(p.x(), p.y()) - torus.R) / torus.r0, p.z() / torus.r1);
}

double angle_about(const Body& torus, const Vec3& x)
{
  const Vec3 p = torus.axes.transpose() * (x - torus.center);
  return std::atan2(p.y(), p.x());
}

/// Points of the solid of a body by coordinate u, and polar coordinates (s in [0, 1], w) of its section.
Vec3 solid_point(const Body& b, double u, double s, double w)
{
  const CurvePoint p = core_at(b, u);
  if (!b.curve && !b.solid)
    return p.x + s * (b.r0 * std::cos(w) * (p.x - b.center) / b.R + b.r1 * std::sin(w) * b.axes.col(2));
  const double speed = p.xu.norm();
  const Vec3 t =
      speed > 0.0 ? Vec3(p.xu / speed) : Vec3(Vec3::UnitZ());  // a segment stands still at its ends
  Eigen::Index least = 0;
  t.cwiseAbs().minCoeff(&least);
  const Vec3 n = t.cross(Vec3::Unit(least)).normalized();
  return p.x + s * b.r0 * (std::cos(w) * n + std::sin(w) * t.cross(n));
}

/// The search of lowest_level.
class LevelSearch {
 public:
  LevelSearch(const Body& b, const Body& field, const std::array<double, 3>& at,
              const std::array<double, 3>& first_step)
      : b_(b), field_(field), first_step_(first_step), step_(first_step), at_(at), value_(level_at(at))
  {
  }

  void run()
  {
    constexpr int most_halvings = 40, many_sweeps = 100, most_sweeps = 20000;
    int sweeps = 0;
    for (int halved = 0; halved < most_halvings;) {
      if (++sweeps > most_sweeps) {
        throw InputError(
            "an element of several primitives has tubes so flat that it is not known where they join: its "
            "loops are not known");
      }
      const std::array<double, 3> before = at_;
      bool fell = sweep();
      if (fell) go_on_from(before);
      // A bent valley would take a million sweeps.
      if (sweeps > many_sweeps && sweeps % 8 == 0) fell = curved_step() || fell;
      if (fell) continue;
      for (double& s : step_) s *= 0.5;
      ++halved;
    }
  }

  const std::array<double, 3>& at() const { return at_; }
  double value() const { return value_; }

 private:
  double level_at(const std::array<double, 3>& p) const
  {
    return level(field_, solid_point(b_, p[0], p[1], p[2]));
  }

  bool falls_at(std::array<double, 3> next)
  {
    next[1] = std::clamp(next[1], 0.0, 1.0);
    const double there = level_at(next);
    if (!(there < value_)) return false;
    value_ = there;
    at_ = next;
    return true;
  }

  /// A step along each coordinate, either way.
  bool sweep()
  {
    bool fell = false;
    for (std::size_t k = 0; k < at_.size(); ++k) {
      for (const double way : {1.0, -1.0}) {
        std::array<double, 3> next = at_;
        next[k] += way * step_[k];
        fell = falls_at(next) || fell;
      }
    }
    return fell;
  }

  /// On along the way that a sweep came, twice as far each time, up to a first step, as long as it falls
  /// (Hooke and Jeeves 1961).
  void go_on_from(const std::array<double, 3>& before)
  {
    std::array<double, 3> way{};
    for (std::size_t k = 0; k < way.size(); ++k) way[k] = at_[k] - before[k];
    for (;;) {
      std::array<double, 3> next = at_;
      for (std::size_t k = 0; k < way.size(); ++k) {
        if (std::abs(way[k]) > first_step_[k]) return;
        next[k] += way[k];
        way[k] *= 2.0;
      }
      if (!falls_at(next)) return;
    }
  }

  /// Newton's step for the square of the level, by differences, in the coordinates that are free, no longer
  /// than a first step; halved until it falls.
  bool curved_step()
  {
    constexpr double h = 1e-4;
    std::vector<std::size_t> free{0, 2};
    if (at_[1] > h && at_[1] < 1.0 - h) free.push_back(1);
    const auto n = static_cast<Eigen::Index>(free.size());
    const auto square = [&](Eigen::Index i, double di, Eigen::Index j, double dj) {
      std::array<double, 3> p = at_;
      p[free[i]] += di;
      p[free[j]] += dj;
      const double v = level_at(p);
      return v * v;
    };
    Eigen::VectorXd gradient(n);
    Eigen::MatrixXd hessian(n, n);
    const double here = value_ * value_;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double up = square(i, h, i, 0.0), down = square(i, -h, i, 0.0);
      gradient[i] = (up - down) / (2.0 * h);
      hessian(i, i) = (up - 2.0 * here + down) / (h * h);
      for (Eigen::Index j = 0; j < i; ++j) {
        hessian(i, j) = hessian(j, i) =
            (square(i, h, j, h) - square(i, h, j, -h) - square(i, -h, j, h) + square(i, -h, j, -h)) /
            (4.0 * h * h);
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hessian);
    const double floor = 1e-9 * eigen.eigenvalues().cwiseAbs().maxCoeff();
    if (!(floor > 0.0)) return false;
    const Eigen::VectorXd along = eigen.eigenvectors().transpose() * gradient;
    const Eigen::VectorXd step =
        -eigen.eigenvectors() * along.cwiseQuotient(eigen.eigenvalues().cwiseAbs().cwiseMax(floor));
    double share = 1.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double most = first_step_[free[i]];
      share = std::min(share, most / std::max(most, std::abs(step[i])));
    }
    for (int halved = 0; halved < 8; ++halved, share *= 0.5) {
      std::array<double, 3> next = at_;
      for (Eigen::Index i = 0; i < n; ++i) next[free[i]] += share * step[i];
      if (falls_at(next)) return true;
    }
    return false;
  }

  const Body &b_, &field_;
  const std::array<double, 3> first_step_;
  std::array<double, 3> step_, at_;
  double value_;
};

/// Lowest level of `field` over the solid of `b` near a point of its grid: steps along each coordinate,
/// halved where none falls, with one of Newton's among them.
double lowest_level(const Body& b, const Body& field, std::array<double, 3>& at,
                    const std::array<double, 3>& first_step)
{
  LevelSearch search(b, field, at, first_step);
  search.run();
  at = search.at();
  return search.value();
}

/// Where at least one cross-section is an ellipse, that of `field`.
std::vector<Join> joins_by_points(const Body& b, const Body& field)
{
  constexpr int rings = 3, around = 12;  // of a section
  const int along = points_per_degree * core_degree(b);
  const auto cell = [=](int i, int ring, int k) {
    return static_cast<std::size_t>(((i + along) % along * rings + ring) * around + (k + around) % around);
  };
  const auto at = [=](int i, int ring, int k) {
    return std::array{full_turn * i / along, (ring + 0.0) / (rings - 1), full_turn * k / around};
  };
  std::vector<double> levels(static_cast<std::size_t>(along * rings * around));
  for (int i = 0; i < along; ++i)
    for (int ring = 0; ring < rings; ++ring)
      for (int k = 0; k < around; ++k) {
        const auto [u, s, w] = at(i, ring, k);
        levels[cell(i, ring, k)] = level(field, solid_point(b, u, s, w));
      }
  const auto neighbours = [&](int i, int ring, int k, const auto& f) {
    for (const int d : {-1, 1}) {
      f(cell(i + d, ring, k));
      f(cell(i, ring, k + d));
      if (ring + d >= 0 && ring + d < rings) f(cell(i, ring + d, k));
    }
    if (ring == 0) f(cell(i, 0, k + around / 2));
  };
  const double inside = 1.0 + touching / std::min(field.r0, field.r1);
  Parts parts(levels.size());
  std::vector<Candidate> found;
  const auto each = [&](const auto& f) {
    for (int i = 0; i < along; ++i)
      for (int ring = 0; ring < rings; ++ring)
        for (int k = 0; k < around; ++k) f(i, ring, k);
  };
  each([&](int i, int ring, int k) {
    const std::size_t here = cell(i, ring, k);
    if (levels[here] > inside) return;
    neighbours(i, ring, k, [&](std::size_t other) {
      if (levels[other] <= inside) parts.join(here, other);
    });
  });
  // A level changes along a way by no more than the way over the smaller half-axis.
  const double slack = full_turn *
                       ((is_round(b) && !b.is_circle_tube() ? core_bounds(b).first : b.R + b.r0) / along +
                        std::max(b.r0, b.r1) * (1.0 / around + 1.0 / full_turn)) /
                       std::min(field.r0, field.r1);
  each([&](int i, int ring, int k) {
    const std::size_t here = cell(i, ring, k);
    if (levels[here] > inside + slack) return;
    bool lowest = true;
    neighbours(i, ring, k, [&](std::size_t other) { lowest = lowest && levels[here] <= levels[other]; });
    if (!lowest) return;
    std::array<double, 3> p = at(i, ring, k);
    const double deepest =
        lowest_level(b, field, p, {0.5 * full_turn / along, 0.25, 0.5 * full_turn / around});
    if (deepest > inside) return;
    const Vec3 x = solid_point(b, p[0], p[1], p[2]);
    found.push_back({parts.of(here), deepest, {p[0], angle_about(field, x), x}});
  });
  return one_of_each_part(found, same_point * std::min({b.r0, b.r1, field.r0, field.r1}));
}

}  // namespace

std::vector<Join> joins(const Body& A, const Body& B)
{
  if (A.surface || B.surface) return {};
  if ((A.center - B.center).norm() > A.bound + B.bound + touching) return {};
  if (is_round(A) && is_round(B)) return joins_of_tubes(A, B);
  if ((A.solid && !is_round(A)) || (B.solid && !is_round(B)))
    throw InputError("an element of several primitives has a solid that is no tube: its loops are not known");
  if (!B.curve && !B.solid) return joins_by_points(A, B);
  std::vector<Join> out = joins_by_points(B, A);
  for (Join& j : out) std::swap(j.u, j.v);
  return out;
}

}  // namespace hauberk
