#include "enclosure.hpp"

#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <vector>

namespace hauberk::verification {
namespace {

constexpr int most_evaluations = 200000;
/// Cells to begin with, along each coordinate.
constexpr int coarse = 8;
/// An ellipse's surface is no probe.
constexpr int never = 100;

/// Points that ride on a surface at a constant distance from it.
class Probe {
 public:
  explicit Probe(const Primitive& of) : of_(of) {}

  int dimension() const { return of_.solid ? of_.solid->probe_dimension() : 1; }
  double offset() const { return of_.solid ? of_.solid->offset() : of_.r0; }

  ProbeDerivatives at(double u, double v) const
  {
    if (!of_.solid) return {core_point(of_, u), core_tangent(of_, u), Vec3::Zero(), second(u), {}, {}};
    const Mat3& turn = of_.place.rotation;
    const ProbeDerivatives d = of_.solid->probe(probe_angles(u, v));
    return {of_.place.position + turn * d.x, turn * d.u, turn * d.v, turn * d.uu, turn * d.uv, turn * d.vv};
  }

  ProbeBounds bounds(double u, double v, double half_u, double half_v) const
  {
    if (of_.solid) return of_.solid->probe_bounds(u, v, half_u, half_v);
    ProbeBounds out;
    out.u = core_speed(of_);
    out.uu = core_bend(of_);
    out.uuu = out.uu * static_cast<double>(std::max<std::size_t>(1, of_.curve.size()));
    return out;
  }

 private:
  /// Second derivative of a core.
  Vec3 second(double u) const
  {
    if (of_.curve.empty()) return of_.place.position - core_point(of_, u);
    Vec3 local = Vec3::Zero();
    for (std::size_t i = 0; i < of_.curve.size(); ++i) {
      const double k = static_cast<double>(i + 1);
      local -= k * k * (std::cos(k * u) * of_.curve[i][0] + std::sin(k * u) * of_.curve[i][1]);
    }
    return of_.place.rotation * local;
  }

  const Primitive& of_;
};

/// A signed distance, what is certain of it, and its gradient.
struct Height {
  double distance = 0.0, at_least = 0.0;
  Vec3 normal = Vec3::Zero();
};

Height height(const Primitive& of, const Vec3& x)
{
  Height out;
  if (!of.solid) {
    out.distance = out.at_least = signed_distance(of, x, &out.normal);
    return out;
  }
  const SolidDistance d = of.solid->distance(of.place.rotation.transpose() * (x - of.place.position));
  return {d.distance, d.at_least, of.place.rotation * d.normal};
}

/// Radius of the largest ball that is known to touch the surface from outside anywhere; 0: none. The points
/// outside of a torus that have several nearest ones are those of its axis, from R - r0 on.
double reach_outside(const Primitive& of)
{
  if (of.solid) return of.solid->smoothness().reach;
  return of.curve.empty() ? of.R - of.r0 : 0.0;
}

/// How slow the search is with the probe of one and the distance of the other: least where it has one
/// coordinate and a reach is known.
int slowness(const Primitive& probe, const Primitive& field)
{
  if (!probe.solid && !is_tube(probe)) return never;
  return (Probe(probe).dimension() == 1 ? 0 : 1) + (reach_outside(field) > 0.0 ? 0 : 2);
}

/// Balls that hold all of a solid's probe: where its distance is not certain they bound it from below.
class Cover {
 public:
  explicit Cover(const Primitive& of) : probe_(of)
  {
    const bool curve = probe_.dimension() == 1;
    const int across = curve ? 1 : count;
    const double half = std::numbers::pi / count;
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < across; ++j) {
        const double u = (2 * i + 1) * half, v = curve ? 0.0 : (2 * j + 1) * half, w = curve ? 0.0 : half;
        const ProbeBounds bounds = probe_.bounds(u, v, half, w);
        balls_.push_back({probe_.at(u, v).x, bounds.u * half + bounds.v * w});
      }
  }

  /// No point of the surface is nearer to x.
  double at_least(const Vec3& x) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls_) least = std::min(least, (x - ball.middle).norm() - ball.radius);
    return least - probe_.offset();
  }

 private:
  static constexpr int count = 48;
  struct Ball {
    Vec3 middle;
    double radius;
  };
  Probe probe_;
  std::vector<Ball> balls_;
};

struct Cell {
  double least = 0.0, u = 0.0, v = 0.0, half_u = 0.0, half_v = 0.0;
  bool along_u = true;  ///< where to halve it
};

struct Higher {
  bool operator()(const Cell& a, const Cell& b) const { return a.least > b.least; }
};

class Search {
 public:
  Search(const Primitive& probe, const Primitive& field)
      : probe_(probe), field_(field), reach_(reach_outside(field))
  {
  }

  Enclosure over_all(double width, double enough)
  {
    const bool curve = probe_.dimension() == 1;
    const double half = std::numbers::pi / coarse;
    for (int i = 0; i < coarse; ++i)
      for (int j = 0; j < (curve ? 1 : coarse); ++j)
        add((2 * i + 1) * half, curve ? 0.0 : (2 * j + 1) * half, half, curve ? 0.0 : half);
    while (evaluations_ < most_evaluations) {
      const Cell lowest = cells_.top();
      if (found_ - lowest.least <= width || lowest.least > enough) break;
      cells_.pop();
      const double half_u = lowest.along_u ? 0.5 * lowest.half_u : lowest.half_u;
      const double half_v = lowest.along_u ? lowest.half_v : 0.5 * lowest.half_v;
      for (const double side : {-1.0, 1.0})
        add(lowest.u + (lowest.along_u ? side * half_u : 0.0),
            lowest.v + (lowest.along_u ? 0.0 : side * half_v), half_u, half_v);
    }
    return {std::min(cells_.top().least, found_), found_};
  }

 private:
  void add(double u, double v, double half_u, double half_v)
  {
    ++evaluations_;
    const ProbeDerivatives at = probe_.at(u, v);
    const ProbeBounds bounds = probe_.bounds(u, v, half_u, half_v);
    const Height here = height(field_, at.x);
    found_ = std::min(found_, here.distance - probe_.offset());
    const double change_u = bounds.u * half_u, change_v = bounds.v * half_v, away = change_u + change_v;
    double least = certain_at(at.x, here) - away;
    if (here.at_least == here.distance && here.distance + away < reach_) {
      const double slack = 0.5 * away * away / (reach_ - here.distance - away);
      least = std::max(least, here.distance - slack - fall(at, bounds, here.normal, half_u, half_v));
    }
    cells_.push({least - probe_.offset(), u, v, half_u, half_v, change_u >= change_v});
  }

  /// Outside, where the plugin is not certain, no less than the balls around its surface say.
  double certain_at(const Vec3& x, const Height& here)
  {
    if (!field_.solid || here.at_least == here.distance || here.distance <= 0.0) return here.at_least;
    if (!cover_) cover_.emplace(field_);
    return std::max(here.at_least, std::min(cover_->at_least(x), here.distance));
  }

  /// Bound of -n . (y - x) over the cell by Taylor's formula to the third order.
  static double fall(const ProbeDerivatives& at, const ProbeBounds& bounds, const Vec3& n, double s, double w)
  {
    const double first = std::abs(n.dot(at.u)) * s + std::abs(n.dot(at.v)) * w;
    const double second = std::max(0.0, -n.dot(at.uu)) * s * s + 2.0 * std::abs(n.dot(at.uv)) * s * w +
                          std::max(0.0, -n.dot(at.vv)) * w * w;
    const double third = bounds.uuu * s * s * s + 3.0 * bounds.uuv * s * s * w +
                         3.0 * bounds.uvv * s * w * w + bounds.vvv * w * w * w;
    return first + second / 2.0 + third / 6.0;
  }

  Probe probe_;
  const Primitive& field_;
  double reach_;
  std::optional<Cover> cover_;
  double found_ = std::numeric_limits<double>::infinity();
  int evaluations_ = 0;
  std::priority_queue<Cell, std::vector<Cell>, Higher> cells_;
};

}  // namespace

Enclosure enclose(const Primitive& a, const Primitive& b, double width, double enough)
{
  const bool first = slowness(a, b) <= slowness(b, a);
  return Search(first ? a : b, first ? b : a).over_all(width, enough);
}

}  // namespace hauberk::verification
