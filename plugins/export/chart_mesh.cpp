#include "export/chart_mesh.hpp"

#include "geometry/solid_chart.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace hauberk::exporting {
namespace {

constexpr double pi = std::numbers::pi;

using Values = std::vector<double>;

Values evenly(double length, std::size_t pieces)
{
  Values out;
  for (std::size_t k = 0; k < pieces; ++k)
    out.push_back(length * static_cast<double>(k) / static_cast<double>(pieces));
  return out;
}

/// The values of u and of v, and the facets between their points.
class ChartMesh {
 public:
  /// `poles`: the chart covers the surface between poles, otherwise both ways.
  ChartMesh(const Solid& solid, bool poles, double chord, double most)
      : solid_(solid), poles_(poles), chord_(chord), most_(most)
  {
    constexpr std::size_t first = 8, seen_at = 32;
    // Other values than those of either are where the other bends most only by chance: both are divided by
    // what many lines show, then by what the lines of the mesh show.
    const Values many_u = evenly(2.0 * pi, seen_at), many_v = evenly(length_v(), seen_at);
    us_ = divided(evenly(2.0 * pi, first), 2.0 * pi,
                  [&](double a, double b) { return sagitta_u(a, b, many_v); });
    vs_ = divided(evenly(length_v(), first), length_v(),
                  [&](double a, double b) { return sagitta_v(a, b, us_); });
    us_ = divided(us_, 2.0 * pi, [&](double a, double b) { return sagitta_u(a, b, vs_); });
    const double triangles = 2.0 * static_cast<double>(us_.size()) * static_cast<double>(vs_.size());
    if (triangles > most_) refuse_chord(triangles, chord_);
  }

  Mesh mesh() const { return poles_ ? between_poles() : closed_both_ways(); }

 private:
  Vec3 at(double u, double v) const { return solid_.surface_point(chart_angles(u, v)); }
  double length_v() const { return poles_ ? pi : 2.0 * pi; }

  /// Distance of the middle of an arc from its chord.
  static double sagitta(const Vec3& a, const Vec3& middle, const Vec3& b)
  {
    const Vec3 along = b - a, to = middle - a;
    const double square = along.squaredNorm();
    return square > 0.0 ? (to - to.dot(along) / square * along).norm() : to.norm();
  }
  double sagitta_u(double a, double b, const Values& vs) const
  {
    double most = 0.0;
    for (const double v : vs) most = std::max(most, sagitta(at(a, v), at(0.5 * (a + b), v), at(b, v)));
    return most;
  }
  double sagitta_v(double a, double b, const Values& us) const
  {
    double most = 0.0;
    for (const double u : us) most = std::max(most, sagitta(at(u, a), at(u, 0.5 * (a + b)), at(u, b)));
    return most;
  }

  /// Values from 0 to `length`, without it, between which no chord leaves the surface by more than half of
  /// what is asked for.
  Values divided(Values values, double length, const std::function<double(double, double)>& leaves) const
  {
    Values out;
    values.push_back(length);
    for (std::size_t k = 0; k + 1 < values.size(); ++k) divide(values[k], values[k + 1], leaves, out);
    return out;
  }
  void divide(double from, double to, const std::function<double(double, double)>& leaves, Values& out) const
  {
    constexpr double least = 1e-6;  // radians: jumps of the chart have no chord
    if (static_cast<double>(out.size()) > most_) refuse_chord(16.0 * static_cast<double>(out.size()), chord_);
    if (to - from < least || leaves(from, to) <= 0.5 * chord_) {
      out.push_back(from);
      return;
    }
    divide(from, 0.5 * (from + to), leaves, out);
    divide(0.5 * (from + to), to, leaves, out);
  }

  Mesh closed_both_ways() const
  {
    Mesh mesh;
    for (const double u : us_)
      for (const double v : vs_) mesh.points.push_back(at(u, v));
    close_both_ways(mesh, 0, static_cast<int>(us_.size()), static_cast<int>(vs_.size()));
    return mesh;
  }

  Mesh between_poles() const
  {
    Mesh mesh;
    const auto nu = static_cast<int>(us_.size()), rows = static_cast<int>(vs_.size()) - 1;
    for (const double u : us_)
      for (int j = 1; j <= rows; ++j) mesh.points.push_back(at(u, vs_[static_cast<std::size_t>(j)]));
    const int first = nu * rows, last = first + 1;
    mesh.points.push_back(at(0.0, 0.0));
    mesh.points.push_back(at(0.0, pi));
    const auto number = [&](int i, int j) { return (i % nu) * rows + j; };
    for (int i = 0; i < nu; ++i) {
      mesh.triangles.push_back({first, number(i, 0), number(i + 1, 0)});
      for (int j = 0; j + 1 < rows; ++j) {
        mesh.triangles.push_back({number(i, j), number(i, j + 1), number(i + 1, j + 1)});
        mesh.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i + 1, j)});
      }
      mesh.triangles.push_back({last, number(i + 1, rows - 1), number(i, rows - 1)});
    }
    return mesh;
  }

  const Solid& solid_;
  bool poles_;
  double chord_, most_;
  Values us_, vs_;
};

}  // namespace

std::optional<Mesh> chart_mesh(const Solid& solid, double chord, double most_triangles)
{
  const ChartCover cover = chart_cover(solid);
  if (cover == ChartCover::other) return std::nullopt;
  Mesh mesh = ChartMesh(solid, cover == ChartCover::between_poles, chord, most_triangles).mesh();
  turn_outwards(mesh);
  return mesh;
}

}  // namespace hauberk::exporting
