#include "limits/body_images.hpp"

#include "geometry/closed_curve.hpp"
#include "model/near_pairs.hpp"

#include <hauberk/solid.hpp>
#include <hauberk/triangle_surface.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>

namespace hauberk {
namespace {

using Complex3 = Eigen::Vector3cd;

bool same_length(double a, double b) { return std::abs(a - b) <= same_geometry; }

bool same_sizes(const Body& a, const Body& b)
{
  return a.kind == b.kind && same_length(a.R, b.R) && same_length(a.r0, b.r0) && same_length(a.r1, b.r1);
}

/// c cos k u + s sin k u = Re (c - i s) e^(i k u)
Complex3 amplitude(const Harmonic& h, const Mat3& turn)
{
  return (turn * h.c).cast<std::complex<double>>() -
         std::complex<double>(0, 1) * (turn * h.s).cast<std::complex<double>>();
}

/// Whether the curve a, moved by `turn`, is b run through from another point, or backwards: with the
/// amplitudes Z_k of the first and W_k of the second, Z_k = W_k e^(i k phi) for all k and one phi, or the
/// conjugate of that.
bool same_curve(const ClosedCurve& a, const ClosedCurve& b, const Mat3& turn)
{
  if (a.size() != b.size()) return false;
  std::vector<Complex3> Z, W;
  std::size_t leading = 0;  // the largest harmonic tells phi up to 2 pi/k
  for (std::size_t k = 0; k < a.size(); ++k) {
    Z.push_back(amplitude(a.harmonics()[k], turn));
    W.push_back(amplitude(b.harmonics()[k], Mat3::Identity()));
    if (W[k].norm() > W[leading].norm()) leading = k;
  }
  for (const bool backwards : {false, true}) {
    if (backwards) {
      for (Complex3& z : Z) z = z.conjugate().eval();
    }
    const double order = static_cast<double>(leading + 1);
    const double phase = std::arg(W[leading].dot(Z[leading]));  // `dot` conjugates its first factor
    for (std::size_t m = 0; m <= leading; ++m) {
      const double phi = (phase + 2.0 * std::numbers::pi * static_cast<double>(m)) / order;
      double difference = 0.0;
      for (std::size_t k = 0; k < Z.size(); ++k)
        difference += (Z[k] - W[k] * std::polar(1.0, static_cast<double>(k + 1) * phi)).norm();
      if (difference <= same_geometry) return true;
    }
  }
  return false;
}

bool same_harmonics(const ClosedCurve& a, const ClosedCurve& b)
{
  if (a.size() != b.size()) return false;
  double difference = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    difference += (a.harmonics()[k].c - b.harmonics()[k].c).norm();
    difference += (a.harmonics()[k].s - b.harmonics()[k].s).norm();
  }
  return difference <= same_geometry;
}

bool same_surface(const TriangleSurface& a, const TriangleSurface& b)
{
  return &a == &b || (a.points() == b.points() && a.triangles() == b.triangles());
}

/// Two solids of one kind and, to rounding, with the same sizes; and two bodies that are none.
bool alike(const Body& a, const Body& b)
{
  if (!a.solid || !b.solid) return !a.solid && !b.solid;
  const std::vector<double>&own = a.solid->sizes(), &other = b.solid->sizes();
  return a.solid->kind() == b.solid->kind() &&
         std::equal(own.begin(), own.end(), other.begin(), other.end(), [](double x, double y) {
           return std::abs(x - y) <= same_geometry * std::max(std::abs(x), std::abs(y));
         });
}

/// Meshes lie upon each other where their frames do: facets know neither mirrors nor turns about the axis.
bool carries_mesh(const Body& a, const Body& b, const Mat3& S)
{
  if ((S * a.axes - b.axes).norm() > same_geometry) return false;
  if (!a.surface != !b.surface || !a.curve != !b.curve) return false;
  if (!alike(a, b)) return false;
  return a.surface ? same_surface(*a.surface, *b.surface) : !a.curve || same_harmonics(*a.curve, *b.curve);
}

/// Whether an isometry about its origin carries a solid to itself, as far as points of its surface tell: they
/// all come to lie on it. Points of a regular grid might come to lie on each other, so u goes on by the
/// golden section, which no turn of a regular body repeats.
bool carries_to_itself(const Solid& solid, const Mat3& turn, double tolerance)
{
  constexpr int points = 97;
  constexpr double golden = 0.61803398874989485, first = 0.137;
  for (int k = 0; k < points; ++k) {
    const double u = 2.0 * std::numbers::pi * (first + golden * k),
                 v = 2.0 * std::numbers::pi * (k + 0.5) / points;
    const Vec3 x = solid.surface_point({std::cos(u), std::sin(u), std::cos(v), std::sin(v)});
    if (!(std::abs(solid.distance(turn * x).distance) <= tolerance)) return false;
  }
  return true;
}

bool carries_solid(const Body& a, const Body& b, const Mat3& S, SolidTurns& turns)
{
  if (!alike(a, b)) return false;
  const Mat3 turn = b.axes.transpose() * S * a.axes;
  return (turn - Mat3::Identity()).norm() <= same_geometry || turns.carry_to_itself(a, turn);
}

bool carries(const Body& a, const Body& b, const Mat3& S, SolidTurns& turns)
{
  if (!same_sizes(a, b) || (S * a.center - b.center).norm() > same_geometry) return false;
  if (a.facets || b.facets) return carries_mesh(a, b, S);
  if (a.solid || b.solid) return carries_solid(a, b, S, turns);
  if (a.curve) return same_curve(*a.curve, *b.curve, b.axes.transpose() * S * a.axes);
  if (a.is_point() && same_length(a.r0, a.r1)) return true;  // a ball
  const Vec3 axis = S * a.axes.col(2);
  return std::min((axis - b.axes.col(2)).norm(), (axis + b.axes.col(2)).norm()) <= same_geometry;
}

std::span<const Body> bodies_of(const Model& m, int element)
{
  const std::size_t e = element;
  const std::size_t first = m.first_body[e];
  return std::span(m.bodies).subspan(first, static_cast<std::size_t>(m.first_body[e + 1]) - first);
}

/// Kind, sizes and distance from the origin of all bodies; sorted, so that their order does not matter.
std::vector<std::array<double, 5>> invariants(const Model& m, int element)
{
  std::vector<std::array<double, 5>> out;
  for (const Body& b : bodies_of(m, element))
    out.push_back({static_cast<double>(b.kind), b.R, b.r0, b.r1, b.center.norm()});
  // Rounding must not change the order of equal sizes.
  const auto rounded = [](const std::array<double, 5>& x) {
    std::array<double, 5> y{};
    for (std::size_t k = 0; k < x.size(); ++k) y[k] = std::round(x[k] / (100.0 * same_geometry));
    return y;
  };
  std::sort(out.begin(), out.end(),
            [&rounded](const auto& x, const auto& y) { return rounded(x) < rounded(y); });
  return out;
}

bool same_invariants(const std::vector<std::array<double, 5>>& a, const std::vector<std::array<double, 5>>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), same_length);
  });
}

/// Whether the body is a torus, whose axis says how it lies; balls, curves, meshes and solids have none.
bool has_axis(const Body& b) { return !b.curve && !b.surface && !b.solid && !b.is_point(); }

/// How two bodies lie to each other, as a number that no isometry changes, seen from the first.
double mutual(const Body& a, const Frame& at_a, const Body& b, const Frame& at_b)
{
  const Vec3 d = at_b.center - at_a.center;
  double sum = 1.0 + d.norm();
  if (has_axis(a)) sum += std::pow(at_a.axes.col(2).dot(d), 2);
  if (has_axis(a) && has_axis(b)) sum += std::pow(at_a.axes.col(2).dot(at_b.axes.col(2)), 2);
  return sum;
}

/// Per element a number that says how its neighbours lie around it, equal for elements that a symmetry
/// carries to each other. Neighbours fade out with distance, so that rounding cannot make one appear.
std::vector<double> surroundings(const Model& m)
{
  constexpr double margin = 0.5;  // L: beyond the touch of bounding spheres
  const State rest = rest_state(m);
  std::vector<double> out(m.rest.size(), 0.0);
  for (const ElementPair& pair : near_pairs(m, rest, margin)) {
    const std::size_t i = pair.i, j = pair.j;
    const Pose own = m.rest[i];
    const Pose other{m.rest[j].position + m.translation(pair.image), m.rest[j].rotation};
    const double far = m.reach[i] + m.reach[j] + margin;
    const double nearness = std::max(0.0, 1.0 - (other.position - own.position).norm() / far);
    for (const Body& a : bodies_of(m, pair.i)) {
      for (const Body& b : bodies_of(m, pair.j)) {
        const Frame at_a = world_frame(a, own), at_b = world_frame(b, other);
        out[i] += nearness * nearness * mutual(a, at_a, b, at_b);
        out[j] += nearness * nearness * mutual(b, at_b, a, at_a);
      }
    }
  }
  return out;
}

/// Divides kinds by surroundings. Values closer than `same` stay together, however many: what tolerances of
/// places make of one value must not be torn apart, and what is together by chance does no harm.
void divide_by_surroundings(const Model& m, std::vector<int>& kinds)
{
  constexpr double same = 1e-6;
  const std::vector<double> around = surroundings(m);
  std::vector<std::tuple<int, double, std::size_t>> order;
  for (std::size_t i = 0; i < kinds.size(); ++i) order.emplace_back(kinds[i], around[i], i);
  std::sort(order.begin(), order.end());
  int kind = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& [shape, value, i] = order[k];
    if (k > 0) {
      const auto& [last_shape, last_value, last] = order[k - 1];
      if (shape != last_shape || value - last_value > same * (1.0 + std::abs(value))) ++kind;
    }
    kinds[i] = kind;
  }
}

}  // namespace

bool SolidTurns::carry_to_itself(const Body& body, const Mat3& turn)
{
  constexpr double rounding = 1e-14;
  const Solid& solid = *body.solid;
  for (const Known& k : known_)
    if ((k.turn - turn).norm() <= rounding && k.sizes == solid.sizes() && k.kind == solid.kind())
      return k.carries;
  known_.push_back(
      {solid.kind(), solid.sizes(), turn, carries_to_itself(solid, turn, same_geometry * body.unit)});
  return known_.back().carries;
}

bool carries_bodies(const Model& m, int i, int j, const Mat3& S, SolidTurns& turns)
{
  const std::span<const Body> from = bodies_of(m, i), to = bodies_of(m, j);
  if (from.size() != to.size()) return false;
  std::vector<bool> taken(to.size(), false);
  for (const Body& a : from) {
    std::size_t k = 0;
    while (k < to.size() && (taken[k] || !carries(a, to[k], S, turns))) ++k;
    if (k == to.size()) return false;
    taken[k] = true;
  }
  return true;
}

std::vector<int> element_kinds(const Model& m)
{
  std::vector<int> kinds;
  std::vector<std::vector<std::array<double, 5>>> known;
  for (int i = 0; i < m.element_count(); ++i) {
    std::vector<std::array<double, 5>> own = invariants(m, i);
    const auto at = std::find_if(known.begin(), known.end(),
                                 [&own](const auto& other) { return same_invariants(own, other); });
    kinds.push_back(static_cast<int>(at - known.begin()));
    if (at == known.end()) known.push_back(std::move(own));
  }
  divide_by_surroundings(m, kinds);
  return kinds;
}

}  // namespace hauberk
