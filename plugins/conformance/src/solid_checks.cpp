#include "solid_checks.hpp"

#include "maximise.hpp"
#include "verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::conformance {
namespace {

using std::numbers::pi;
/// Of distances, relative to the solid's radius: what an iteration leaves.
constexpr double solid_rounding = 1e-9;
/// Of central differences with the chord below.
constexpr double coarse = 1e-5;
constexpr double chord = 1e-4;
constexpr int samples = 40;
constexpr int searches = 5;  ///< of worst cases

ProbeAngles angles(double u, double v) { return {std::cos(u), std::sin(u), std::cos(v), std::sin(v)}; }

/// Everything of one solid that is compared with the rest of it.
class SolidCheck {
 public:
  SolidCheck(const Primitive& primitive, Random& random)
      : name_(primitive.name), solid_(*primitive.solid), random_(random), size_(solid_.radius())
  {
    require(size_ > 0.0 && std::isfinite(size_), "the solid '{}' has a radius of {}", name_, size_);
  }

  void run()
  {
    surface_is_zero();
    distances_are_those_of_samples();
    derivatives_of_the_distance();
    probe();
    kinks_of_probe();
    probe_bounds();
    smoothness();
  }

 private:
  double angle() { return random_.between(0.0, 2.0 * pi); }

  void surface_is_zero()
  {
    // Across a jump of curvature a chord leans by as much as the step is long.
    const double tilted = jumps_ ? 1e-3 : coarse;
    for (int k = 0; k < samples; ++k) {
      const double u = angle(), v = angle();
      const Vec3 x = solid_.surface_point(angles(u, v));
      require(x.norm() <= size_ * (1.0 + solid_rounding),
              "a surface point of '{}' is {:.9g} from its origin, its radius {:.9g}", name_, x.norm(), size_);
      const SolidDistance d = solid_.distance(x);
      require(
          std::abs(d.distance) <= solid_rounding * size_,
          "the distance of '{}' is {:.3g} at the point of its surface u = {:.6g}, v = {:.6g}: chart and field do "
          "not agree",
          name_, d.distance, u, v);
      // Chart and normal are perpendicular, and the surface turns to the outside.
      const double h = chord;
      const Vec3 along_u = solid_.surface_point(angles(u + h, v)) - solid_.surface_point(angles(u - h, v));
      const Vec3 along_v = solid_.surface_point(angles(u, v + h)) - solid_.surface_point(angles(u, v - h));
      for (const Vec3& t : {along_u, along_v})
        require(std::abs(t.dot(d.normal)) <= tilted * (t.norm() + h * size_),
                "the normal of '{}' is not perpendicular to its chart at u = {:.6g}, v = {:.6g}", name_, u,
                v);
      const double out = 1e-3 * solid_.thickness();
      const double beyond = solid_.distance(x + out * d.normal).distance;
      const double within = solid_.distance(x - out * d.normal).distance;
      require(
          std::abs(beyond - out) <= solid_rounding * size_ &&
              std::abs(within + out) <= solid_rounding * size_,
          "{:.3g} from the surface of '{}' along its normal the distance is {:.9g}, and as deep inside {:.9g}",
          out, name_, beyond, within);
    }
  }

  void distances_are_those_of_samples()
  {
    constexpr int n = 192;
    const std::vector<Vec3> points = solid_points(solid_, n);
    double longest = 0.0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        longest = std::max({longest, (points[(i + 1) % n * n + j] - points[i * n + j]).norm(),
                            (points[i * n + (j + 1) % n] - points[i * n + j]).norm()});
    for (int k = 0; k < samples; ++k) {
      const Vec3 x = random_.vector(1.5 * size_);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& y : points) nearest = std::min(nearest, (x - y).norm());
      const SolidDistance d = solid_.distance(x);
      require(d.at_least <= d.distance + solid_rounding * size_,
              "'{}' is certain of {:.6g}, which is more than its distance {:.6g}", name_, d.at_least,
              d.distance);
      require(
          d.at_least <= nearest + solid_rounding * size_,
          "the distance of '{}' from a point is at least {:.9g}, it says, and a point of its surface is {:.9g} from it",
          name_, d.at_least, nearest);
      const bool certain = d.distance > 0.0 && d.at_least >= d.distance - solid_rounding * size_;
      require(
          !certain || d.distance >= nearest - longest,
          "the distance of '{}' from a point is {:.6g}, it says, and samples of its surface are {:.6g} away, known to "
          "{:.2g}",
          name_, d.distance, nearest, longest);
    }
  }

  /// A point off the surface with one foot.
  Vec3 near_surface()
  {
    const Vec3 x = solid_.surface_point(angles(angle(), angle()));
    const double far = std::min(0.5 * solid_.smoothness().reach, size_);
    return x + random_.between(0.05, 0.4) * far * solid_.distance(x).normal;
  }

  void derivatives_of_the_distance()
  {
    for (int k = 0; k < samples; ++k) {
      const Vec3 x = near_surface();
      const SolidDistance d = solid_.distance(x);
      const double h = 1e-4 * solid_.thickness();
      Vec3 gradient;
      Mat3 hessian;
      for (int i = 0; i < 3; ++i) {
        const SolidDistance a = solid_.distance(x + h * Vec3::Unit(i)),
                            b = solid_.distance(x - h * Vec3::Unit(i));
        gradient[i] = (a.distance - b.distance) / (2.0 * h);
        hessian.col(i) = (a.normal - b.normal) / (2.0 * h);
      }
      require((gradient - d.normal).norm() <= coarse,
              "the normal of '{}' is not the gradient of its distance", name_);
      const Vec3 across = d.normal.cross(d.along);
      const Mat3 own =
          d.bend_along * d.along * d.along.transpose() + d.bend_across * across * across.transpose();
      const double bend = 1.0 / solid_.thickness();
      require(
          jumps_ || (hessian - own).norm() <= 100.0 * coarse * bend,
          "the curvatures of '{}' are not those of its distance: {:.6g} and {:.6g}, differences give {:.6g} more",
          name_, d.bend_along, d.bend_across, (hessian - own).norm());
    }
  }

  void probe()
  {
    const int dimension = solid_.probe_dimension();
    require(dimension == 1 || dimension == 2, "the probe of '{}' has dimension {}", name_, dimension);
    require(dimension == 1 ? solid_.offset() > 0.0 : solid_.offset() == 0.0,
            "the probe of '{}' has dimension {} and the offset {}", name_, dimension, solid_.offset());
    for (int k = 0; k < samples; ++k) {
      const double u = angle(), v = dimension == 2 ? angle() : 0.0;
      const auto at = [&](double a, double b) { return solid_.probe(angles(u + a, v + b)); };
      const ProbeDerivatives here = at(0.0, 0.0);
      require(std::abs(solid_.distance(here.x).distance + solid_.offset()) <= solid_rounding * size_,
              "a point of the probe of '{}' has the distance {:.9g}, its offset is {:.9g}", name_,
              solid_.distance(here.x).distance, solid_.offset());
      const Vec3 u_by = (at(chord, 0.0).x - at(-chord, 0.0).x) / (2.0 * chord);
      const Vec3 uu_by = (at(chord, 0.0).u - at(-chord, 0.0).u) / (2.0 * chord);
      const Vec3 v_by = (at(0.0, chord).x - at(0.0, -chord).x) / (2.0 * chord);
      const Vec3 uv_by = (at(0.0, chord).u - at(0.0, -chord).u) / (2.0 * chord);
      const Vec3 vv_by = (at(0.0, chord).v - at(0.0, -chord).v) / (2.0 * chord);
      const double off =
          std::max({(u_by - here.u).norm(), (v_by - here.v).norm(), jumps_ ? 0.0 : (uu_by - here.uu).norm(),
                    jumps_ ? 0.0 : (uv_by - here.uv).norm(), jumps_ ? 0.0 : (vv_by - here.vv).norm()});
      require(
          off <= 10.0 * coarse * size_,
          "derivatives of the probe of '{}' are not those of differences at u = {:.6g}, v = {:.6g}: {:.3g}",
          name_, u, v, off);
      folded(u, v, here.x);
    }
  }

  /// Most that the derivative of a curve turns near a place between `from` and from + 2 h: over a step of h
  /// the second difference is at most h^2 times the largest second derivative, over one with a jump in its
  /// middle h times the jump. Steps are halved towards where it is largest; `from` is moved there.
  template <class Curve>
  static double jump_within(const Curve& at, double& from, double h)
  {
    constexpr int halvings = 20;
    Vec3 a = at(from), b = at(from + h), c = at(from + 2.0 * h);
    double steepest = 0.0;
    for (int n = 0; n < halvings; ++n) {
      h *= 0.5;
      const Vec3 ab = at(from + h), bc = at(from + 3.0 * h);
      const double left = (a - 2.0 * ab + b).norm(), right = (b - 2.0 * bc + c).norm();
      if (left < right) {
        from += 2.0 * h;
        a = b, b = bc;
      } else {
        c = b, b = ab;
      }
      // A jump near the end of one step is near the middle of another.
      if (n > halvings - 4) steepest = std::max(steepest, std::max(left, right) / h);
    }
    return steepest;
  }

  /// Bounds of second derivatives say nothing of a probe whose first ones jump: lines of the chart are
  /// searched for a place where they do.
  void kinks_of_probe()
  {
    constexpr int pieces = 48;
    constexpr double most = 1e-4;  // of the size; rounding leaves 1e-8, a second derivative of 100 sizes 1e-5
    const bool line = solid_.probe_dimension() == 1;
    for (int k = 0; k < searches; ++k) {
      const double u = angle(), v = line ? 0.0 : angle();
      for (const bool along_u : {true, false}) {
        if (line && !along_u) continue;
        const auto at = [&](double by) {
          return solid_.probe(along_u ? angles(u + by, v) : angles(u, v + by)).x;
        };
        for (int i = 0; i < pieces; ++i) {
          double by = 2.0 * pi * i / pieces;
          const double jump = jump_within(at, by, pi / pieces);
          require(
              jump <= most * size_,
              "the first derivative of the probe of '{}' jumps by {:.3g} or more near {} = {:.9g}, where {} "
              "is {:.6g}: its bounds hold for continuous ones alone",
              name_, jump, along_u ? 'u' : 'v', (along_u ? u : v) + by, along_u ? 'v' : 'u', along_u ? v : u);
        }
      }
    }
  }

  void folded(double u, double v, const Vec3& x)
  {
    if (solid_.fold() == Fold::none) return;
    const bool pole = solid_.fold() == Fold::pole, line = solid_.probe_dimension() == 1;
    const Vec3 other = solid_.probe(line ? angles(-u, 0.0) : angles(pole ? u + pi : u, -v)).x;
    require((other - x).norm() <= solid_rounding * size_,
            "the probe of '{}' does not fold as it says at u = {:.6g}, v = {:.6g}", name_, u, v);
  }

  void probe_bounds()
  {
    const bool line = solid_.probe_dimension() == 1;
    for (int k = 0; k < samples; ++k) {
      const double u = angle(), v = line ? 0.0 : angle();
      const double hu = random_.scale(1e-3, pi), hv = line ? 0.0 : random_.scale(1e-3, pi);
      const ProbeBounds b = solid_.probe_bounds(u, v, hu, hv);
      for (int j = 0; j < samples; ++j) {
        const ProbeDerivatives d =
            solid_.probe(angles(u + random_.between(-hu, hu), v + (line ? 0.0 : random_.between(-hv, hv))));
        const double over = std::max(
            {d.u.norm() - b.u, d.v.norm() - b.v, d.uu.norm() - b.uu, d.uv.norm() - b.uv, d.vv.norm() - b.vv});
        require(over <= solid_rounding * size_,
                "a derivative of the probe of '{}' is longer than its bound by {:.3g}", name_, over);
      }
      third_derivatives(b, u, v);
      if (k < searches) worst_of_probe(u, v, hu, hv);
    }
  }

  /// The five derivatives of the probe that have bounds, over these.
  static std::array<double, 5> over_bounds(const ProbeDerivatives& d, const ProbeBounds& b, double floor)
  {
    return {d.u.norm() / (b.u + floor), d.v.norm() / (b.v + floor), d.uu.norm() / (b.uu + floor),
            d.uv.norm() / (b.uv + floor), d.vv.norm() / (b.vv + floor)};
  }

  /// Searches the worst point of the worst box of these half-widths.
  void worst_of_probe(double u, double v, double hu, double hv)
  {
    constexpr int sweeps = 30;
    const double floor = solid_rounding * size_;
    const auto ratios = [&](const std::vector<double>& x) {
      const ProbeBounds b = solid_.probe_bounds(x[0], x[1], hu, hv);
      const double a = std::clamp(x[2], -1.0, 1.0), c = std::clamp(x[3], -1.0, 1.0);
      return over_bounds(solid_.probe(angles(x[0] + a * hu, x[1] + c * hv)), b, floor);
    };
    for (std::size_t k = 0; k < 5; ++k) {
      const std::vector<double> worst =
          maximise([&](const std::vector<double>& x) { return ratios(x)[k]; }, {u, v, 0.0, 0.0},
                   {0.4, hv == 0.0 ? 0.0 : 0.4, 0.5, 0.5}, sweeps);
      const double ratio = ratios(worst)[k];
      require(ratio <= 1.0 + 1e-6, "a derivative of the probe of '{}' is {:.9g} times its bound", name_,
              ratio);
    }
  }

  /// The bounds of the curvatures, where they are nearest to being broken.
  void worst_curvature(const SolidSmoothness& s)
  {
    constexpr int sweeps = 30;
    const auto over = [&](const std::vector<double>& x) {
      const SolidDistance d = solid_.distance(solid_.surface_point(angles(x[0], x[1])));
      const double most = std::max(d.bend_along, d.bend_across),
                   least = std::min(d.bend_along, d.bend_across);
      const double concave = std::isfinite(s.reach) ? -least * s.reach : 0.0;
      return std::max(most / (s.convex + solid_rounding / size_), concave);
    };
    for (int k = 0; k < searches; ++k) {
      const double ratio = over(maximise(over, {angle(), angle()}, {0.4, 0.4}, sweeps));
      require(ratio <= 1.0 + 1e-5, "'{}' bends {:.9g} times as much as its smoothness allows", name_, ratio);
    }
  }

  /// Third derivatives of the probe at a place of a box, by differences of second ones, against its bounds.
  void third_derivatives(const ProbeBounds& b, double u, double v)
  {
    const auto by = [&](double du, double dv) {
      const ProbeDerivatives a = solid_.probe(angles(u + du, v + dv)),
                             c = solid_.probe(angles(u - du, v - dv));
      return std::array<double, 2>{(a.uu - c.uu).norm() / (2.0 * chord),
                                   (a.vv - c.vv).norm() / (2.0 * chord)};
    };
    const auto [uuu, uvv] = by(chord, 0.0);
    const auto [uuv, vvv] = by(0.0, chord);
    const double over = std::max({uuu - b.uuu, uuv - b.uuv, uvv - b.uvv, vvv - b.vvv});
    require(jumps_ || over <= coarse * size_,
            "a third derivative of the probe of '{}' is longer than its bound by {:.3g}", name_, over);
  }

  /// Normal curvature of the surface along the tangent nearest to `t` at the point nearest to x.
  double curvature_along(const Vec3& x, const Vec3& t) const
  {
    const SolidDistance d = solid_.distance(x - solid_.distance(x).distance * solid_.distance(x).normal);
    const Vec3 along = (t - t.dot(d.normal) * d.normal).normalized();
    const double a = along.dot(d.along), c = along.dot(d.normal.cross(d.along));
    return a * a * d.bend_along + c * c * d.bend_across;
  }

  /// A geodesic with the tangent t goes through x + s t, projected, up to the order s^3.
  void change_of_curvature(double most)
  {
    for (int k = 0; k < samples; ++k) {
      const Vec3 x = solid_.surface_point(angles(angle(), angle())), n = solid_.distance(x).normal;
      const Vec3 other = random_.vector(1.0), t = (other - other.dot(n) * n).normalized();
      const double h = 1e-3 * solid_.thickness();
      const double change =
          std::abs(curvature_along(x + h * t, t) - curvature_along(x - h * t, t)) / (2.0 * h);
      require(change <= most * (1.0 + 1e-3) + coarse / (size_ * solid_.thickness()),
              "the normal curvature of '{}' changes by {:.6g} along a geodesic, its bound is {:.6g}", name_,
              change, most);
    }
  }

  /// A line on the surface between two places of the chart, and its principal curvatures there, in order.
  struct Stretch {
    double u = 0.0, v = 0.0, du = 0.0, dv = 0.0;
    double length = 0.0;  ///< of the shortest way on the surface, at most
    double change = 0.0;  ///< of either curvature from end to end
    double chord = 0.0;
    double steepness() const { return chord > 0.0 ? change / chord : 0.0; }
  };

  Stretch stretch(double u, double v, double du, double dv, double bend) const
  {
    const Vec3 from = solid_.surface_point(angles(u, v)), to = solid_.surface_point(angles(u + du, v + dv));
    const SolidDistance a = solid_.distance(from), b = solid_.distance(to);
    const auto [least_a, most_a] = std::minmax(a.bend_along, a.bend_across);
    const auto [least_b, most_b] = std::minmax(b.bend_along, b.bend_across);
    // A way that bends by `bend` at most is no longer than the circle of that curvature over its chord.
    const double far = (to - from).norm(), half = 0.5 * bend * far;
    const double length = half < 1.0 ? 2.0 / bend * std::asin(half) : std::numeric_limits<double>::infinity();
    return {u, v, du, dv, length, std::max(std::abs(least_a - least_b), std::abs(most_a - most_b)), far};
  }

  /// Along any way on the surface either principal curvature changes by at most the bound times its length:
  /// the derivative of the second fundamental form is symmetric in all three of its arguments (Codazzi), so
  /// that no value of it on unit vectors is larger than the largest on one vector thrice (S. Banach, Ueber
  /// homogene Polynome in (L2), Studia Math. 7, 1938). Lines of the chart are halved towards where they
  /// change most: a jump that one of them crosses shows at any distance from the samples.
  void jumps_of_curvature(const SolidSmoothness& s)
  {
    if (!(s.reach > 0.0)) return;  // nothing says how sharply it bends the concave way
    constexpr int pieces = 48, halvings = 30;
    constexpr double step = 2.0 * pi / pieces;
    const double bend = std::max(s.convex, 1.0 / s.reach);
    const double floor = coarse / solid_.thickness();
    const auto keep = [&](const Stretch& one) {
      require(
          !(one.change > s.change * one.length * (1.0 + 1e-3) + floor),
          "a principal curvature of '{}' changes by {:.6g} within {:.3g} along its surface, near u = {:.6g}, v = "
          "{:.6g}; its smoothness allows {:.6g} there (where curvature jumps, say so)",
          name_, one.change, one.length, one.u, one.v, s.change * one.length);
    };
    for (int k = 0; k < searches; ++k) {
      const double u = angle(), v = angle();
      for (const bool along_u : {true, false}) {
        const double du = along_u ? step : 0.0, dv = along_u ? 0.0 : step;
        Stretch worst;
        for (int i = 0; i < pieces; ++i) {
          const Stretch one = stretch(u + i * du, v + i * dv, du, dv, bend);
          keep(one);
          if (one.steepness() > worst.steepness()) worst = one;
        }
        for (int i = 0; i < halvings && worst.chord > 1e-7 * size_; ++i) {
          const double hu = 0.5 * worst.du, hv = 0.5 * worst.dv;
          const Stretch a = stretch(worst.u, worst.v, hu, hv, bend),
                        b = stretch(worst.u + hu, worst.v + hv, hu, hv, bend);
          keep(a);
          keep(b);
          worst = a.steepness() > b.steepness() ? a : b;
        }
      }
    }
  }

  void smoothness()
  {
    const SolidSmoothness s = solid_.smoothness();
    require(s.convex >= 0.0 && s.reach >= 0.0 && s.change >= 0.0, "'{}' has smoothness {}, {}, {}", name_,
            s.convex, s.reach, s.change);
    constexpr int n = 48;
    const std::vector<Vec3> points = solid_points(solid_, n);
    std::vector<Vec3> normals;
    for (const Vec3& x : points) {
      const SolidDistance d = solid_.distance(x);
      normals.push_back(d.normal);
      const double most = std::max(d.bend_along, d.bend_across),
                   least = std::min(d.bend_along, d.bend_across);
      require(most <= s.convex * (1.0 + 1e-6) + solid_rounding / size_,
              "'{}' bends by {:.6g}, its bound is {:.6g}", name_, most, s.convex);
      require(!std::isfinite(s.reach) ? least >= -1e-6 * s.convex : -least <= (1.0 + 1e-6) / s.reach,
              "'{}' bends the concave way by {:.6g}, its reach is {:.6g}", name_, -least, s.reach);
    }
    for (std::size_t i = 0; i < points.size(); i += 3) {
      for (std::size_t j = 1; j < points.size(); j += 2) {
        const Vec3 d = points[j] - points[i];
        const double height = d.dot(normals[i]), square = d.squaredNorm();
        const bool within =
            std::isfinite(s.reach)
                ? 2.0 * s.reach * height > square * (1.0 + 1e-6) + solid_rounding * size_ * size_
                : height > 1e-6 * size_;
        require(
            !within,
            "a ball of radius {:.6g} that touches '{}' from outside holds another point of it, {:.6g} away",
            s.reach, name_, d.norm());
      }
    }
    worst_curvature(s);
    if (jumps_) return;
    change_of_curvature(s.change);
    jumps_of_curvature(s);
  }

  const std::string& name_;
  const Solid& solid_;
  Random& random_;
  double size_;
  bool jumps_ = !std::isfinite(solid_.smoothness().change);
};

}  // namespace

std::vector<Vec3> solid_points(const Solid& solid, int n)
{
  std::vector<Vec3> out;
  out.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      out.push_back(solid.surface_point(angles(2.0 * pi * i / n, 2.0 * pi * j / n)));
  return out;
}

void check_solid(const Primitive& primitive, Random& random) { SolidCheck(primitive, random).run(); }

void check_motion(const Primitive& from, const Primitive& to, Random& random)
{
  const Solid &a = *from.solid, &b = *to.solid;
  const std::shared_ptr<const Solid> made = a.with_sizes(b.sizes());
  const double speed = a.speed(b.sizes()), size = std::max(a.radius(), b.radius());
  if (!made || !std::isfinite(speed)) return;
  for (int k = 0; k < samples; ++k) {
    const ProbeAngles at = angles(random.between(0.0, 2.0 * pi), random.between(0.0, 2.0 * pi));
    const Vec3 x = b.surface_point(at);
    require(std::abs(made->distance(x).distance) <= solid_rounding * size,
            "'{}' makes another solid of sizes than the shape does: {:.6g} apart", from.name,
            made->distance(x).distance);
    const double moved =
        std::max(std::abs(a.distance(x).distance), std::abs(b.distance(a.surface_point(at)).distance));
    require(moved <= speed + solid_rounding * size,
            "the surface of '{}' moves by {:.6g} where sizes change, its speed is {:.6g}", from.name, moved,
            speed);
  }
}

void require_scaled(const Primitive& small, const Primitive& large, double factor, Random& random)
{
  const double size = small.solid->radius();
  for (int k = 0; k < samples; ++k) {
    const Vec3 x = random.vector(1.5 * size);
    const double a = small.solid->distance(x).distance, b = large.solid->distance(factor * x).distance;
    require(std::abs(b - factor * a) <= solid_rounding * factor * size,
            "with all lengths times {}, a distance of '{}' goes from {:.12g} to {:.12g}; expected {:.12g}",
            factor, small.name, a, b, factor * a);
  }
}

}  // namespace hauberk::conformance
