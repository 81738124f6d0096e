#include "export/distance_field.hpp"

#include "geometry/body.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace hauberk::exporting {
namespace {

constexpr int core_points = 512;

/// Cubes along the side of a block; a block whose middle is farther from the surface than its corners is
/// passed over, since fields change by at most the distance.
constexpr int block = 8;

/// Marching tetrahedra on a grid of cubes, each divided along its diagonal into six (Kuhn's triangulation),
/// so that neighbours meet in whole triangles. Every edge of the grid that changes sign has one point of the
/// surface.
class Marching {
 public:
  /// `chord` is named where more than `most_triangles` would come of it.
  Marching(std::span<const Primitive> primitives, double cell, double chord, double most_triangles)
      : cell_(cell), chord_(chord), most_(most_triangles)
  {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Primitive& p : primitives) {
      fields_.emplace_back(p);
      fields_.back().extend(low, high, 1.5 * cell);
    }
    origin_ = low;
    for (int k = 0; k < 3; ++k) {
      const double cubes = std::ceil((high[k] - low[k]) / (cell * block));
      constexpr double most_along = 6e4;  // so that places of nodes have their 19 bits
      if (!(cubes <= most_along)) refuse();
      blocks_[k] = std::max(1, static_cast<int>(cubes));
    }
    constexpr double most_blocks = 5e7;
    if (static_cast<double>(blocks_[0]) * blocks_[1] * blocks_[2] > most_blocks) refuse();
  }

  Mesh draw()
  {
    for (int k = 0; k < blocks_[2]; ++k)
      for (int j = 0; j < blocks_[1]; ++j)
        for (int i = 0; i < blocks_[0]; ++i) {
          draw_block({i * block, j * block, k * block});
          if (static_cast<double>(mesh_.triangles.size()) > most_) refuse();
        }
    return std::move(mesh_);
  }

 private:
  using Node = std::array<int, 3>;

  [[noreturn]] void refuse() const
  {
    throw InputError(
        fmt::format("--chord {:g}: one element would take more than {:.0g} triangles; give a larger chord",
                    chord_, most_));
  }

  double field(const Vec3& x) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const DistanceField& f : fields_) least = std::min(least, f(x));
    return least;
  }
  Vec3 place(const Node& n) const { return origin_ + cell_ * Vec3(n[0], n[1], n[2]); }

  void draw_block(const Node& first)
  {
    const Vec3 middle = place(first) + Vec3::Constant(0.5 * block * cell_);
    const double reach = std::sqrt(3.0) * 0.5 * block * cell_;
    if (std::abs(field(middle)) > reach) return;
    constexpr int n = block + 1;
    std::array<double, n * n * n> values{};
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          values[(k * n + j) * n + i] = field(place({first[0] + i, first[1] + j, first[2] + k}));
    for (int k = 0; k < block; ++k)
      for (int j = 0; j < block; ++j)
        for (int i = 0; i < block; ++i)
          draw_cube({first[0] + i, first[1] + j, first[2] + k}, &values[(k * n + j) * n + i]);
  }

  /// `value` points to the value of the cube's first corner in a block.
  void draw_cube(const Node& at, const double* value)
  {
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    constexpr int n = block + 1;
    constexpr std::array<int, 3> stride{1, n, n * n};
    for (const auto& order : orders) {
      std::array<Node, 4> corner;
      std::array<double, 4> f;
      corner[0] = at;
      int offset = 0;
      f[0] = value[0];
      for (int k = 0; k < 3; ++k) {
        corner[k + 1] = corner[k];
        ++corner[k + 1][order[k]];
        offset += stride[order[k]];
        f[k + 1] = value[offset];
      }
      draw_tetrahedron(corner, f);
    }
  }

  void draw_tetrahedron(const std::array<Node, 4>& corner, const std::array<double, 4>& f)
  {
    std::array<int, 4> in{}, out{};
    int inside = 0, outside = 0;
    for (int k = 0; k < 4; ++k) (f[k] < 0.0 ? in[inside++] : out[outside++]) = k;
    if (inside == 0 || outside == 0) return;
    const auto on = [&](int a, int b) { return point(corner[a], f[a], corner[b], f[b]); };
    const Vec3 outwards = mean(corner, out, outside) - mean(corner, in, inside);
    if (inside == 1) return add(on(in[0], out[0]), on(in[0], out[1]), on(in[0], out[2]), outwards);
    if (outside == 1) return add(on(in[0], out[0]), on(in[1], out[0]), on(in[2], out[0]), outwards);
    const int a = on(in[0], out[0]), b = on(in[0], out[1]), c = on(in[1], out[1]), d = on(in[1], out[0]);
    add(a, b, c, outwards);
    add(a, c, d, outwards);
  }

  Vec3 mean(const std::array<Node, 4>& corner, const std::array<int, 4>& which, int count) const
  {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < count; ++k) sum += place(corner[which[k]]);
    return sum / count;
  }

  void add(int a, int b, int c, const Vec3& outwards)
  {
    const auto& x = mesh_.points;
    if ((x[b] - x[a]).cross(x[c] - x[a]).dot(outwards) < 0.0) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  /// The point of the surface on an edge of the grid, made once. It stays off the corners, so that no
  /// triangle vanishes.
  int point(const Node& a, double fa, const Node& b, double fb)
  {
    const bool forward = a < b;
    const Node& low = forward ? a : b;
    const Node& high = forward ? b : a;
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key = key << 19 | static_cast<std::uint64_t>(low[k]);
    for (int k = 0; k < 3; ++k) key = key << 1 | static_cast<std::uint64_t>(high[k] - low[k]);
    const auto [entry, is_new] = known_.try_emplace(key, static_cast<int>(mesh_.points.size()));
    if (!is_new) return entry->second;
    constexpr double corner = 1e-3;
    const Vec3 x = place(a), d = place(b) - x;  // the field is negative at a
    double t0 = 0.0, t1 = 1.0, f0 = fa, f1 = fb;
    for (int step = 0; step < 40 && t1 - t0 > 1e-9; ++step) {
      // Regula falsi in even steps, bisection in odd ones: fast where the field is smooth, and sure where it
      // is not.
      const double t = step % 2 == 0 && f1 > f0 ? t0 - f0 * (t1 - t0) / (f1 - f0) : 0.5 * (t0 + t1);
      const double f = field(x + t * d);
      (f < 0.0 ? t0 : t1) = t;
      (f < 0.0 ? f0 : f1) = f;
      if (std::abs(f) < 1e-10 * cell_) {
        t0 = t1 = t;
      }
    }
    mesh_.points.push_back(x + std::clamp(0.5 * (t0 + t1), corner, 1.0 - corner) * d);
    return entry->second;
  }

  double cell_, chord_, most_;
  std::vector<DistanceField> fields_;
  Vec3 origin_ = Vec3::Zero();
  std::array<int, 3> blocks_{};
  std::unordered_map<std::uint64_t, int> known_;
  Mesh mesh_;
};

}  // namespace

DistanceField::DistanceField(const Primitive& primitive) : primitive_(primitive)
{
  if (primitive.surface)
    throw InputError(
        "a triangle mesh that overlaps other primitives of its element cannot be joined with them; export it by "
        "itself, or give the element as one mesh");
  radius_ = make_body(primitive, 0, 0, 1.0).bound;
  if (primitive.curve.empty()) return;
  curve_.emplace(primitive.curve, 1.0);
  for (int k = 0; k < core_points; ++k) {
    const double u = 2.0 * std::numbers::pi * k / core_points;
    core_.push_back(curve_->at(Angle(u)).x);
  }
}

double DistanceField::operator()(const Vec3& x) const
{
  const Vec3 local = primitive_.rotation.transpose() * (x - primitive_.position);
  if (primitive_.solid) return primitive_.solid->distance(local).distance;
  if (!core_.empty()) return around_curve(local);
  const double away = std::hypot(local.x(), local.y()) - primitive_.R();
  const double r0 = primitive_.r0(), r1 = primitive_.r1();
  // |(a/r0, z/r1)| - 1 changes by at most 1/min(r0, r1) per length.
  return std::min(r0, r1) * (std::hypot(away / r0, local.z() / r1) - 1.0);
}

double DistanceField::around_curve(const Vec3& x) const
{
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < core_.size(); ++k) {
    const double square = (core_[k] - x).squaredNorm();
    if (square < least) {
      least = square;
      nearest = k;
    }
  }
  // The foot on the curve, by Newton's method from the nearest of many points.
  double u = 2.0 * std::numbers::pi * static_cast<double>(nearest) / core_points;
  double best = std::sqrt(least);
  for (int step = 0; step < 4; ++step) {
    const CurvePoint at = curve_->at(Angle(u));
    const double slope = at.xu.dot(at.x - x), bend = at.xu.squaredNorm() + at.xuu.dot(at.x - x);
    best = std::min(best, (at.x - x).norm());
    if (!(bend > 0.0)) break;
    u -= slope / bend;
  }
  return best - primitive_.r0();
}

void DistanceField::extend(Vec3& low, Vec3& high, double by) const
{
  low = low.cwiseMin(primitive_.position - Vec3::Constant(radius_ + by));
  high = high.cwiseMax(primitive_.position + Vec3::Constant(radius_ + by));
}

Mesh zero_set(std::span<const Primitive> primitives, double chord, double most_triangles)
{
  // The longest edge of a tetrahedron, sqrt(3) cells, is to be a chord of the thinnest tube. Every ball that
  // fits into the tube has to hold nodes of the grid: else the tube falls into beads.
  const double thin = sharpest_radius(primitives), fine = std::min(chord, 0.25 * thin);
  return Marching(primitives, std::sqrt(8.0 * thin * fine / 3.0), chord, most_triangles).draw();
}

}  // namespace hauberk::exporting
