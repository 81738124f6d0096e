#pragma once
/// Surfaces of triangles for tests, and a shape of one.

#include <hauberk/shape.hpp>
#include <hauberk/triangle_surface.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace hauberk::test {

struct Triangles {
  std::vector<Vec3> points;
  std::vector<TriangleSurface::Triangle> triangles;

  TriangleSurface surface() const { return {points, triangles}; }
};

/// Tube through closed sections, section(i, j): point j of `around` of section i of `along`.
inline Triangles tube(int along, int around, const std::function<Vec3(int, int)>& section)
{
  Triangles out;
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) out.points.push_back(section(i, j));
  }
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const int i1 = (i + 1) % along, j1 = (j + 1) % around;
      const int a = i * around + j, b = i1 * around + j, c = i1 * around + j1, d = i * around + j1;
      out.triangles.push_back({a, b, c});
      out.triangles.push_back({a, c, d});
    }
  }
  return out;
}

/// Rectangular frame of square bars, in the plane of x and y: inner half-length and half-width, and the bars'
/// width.
inline Triangles frame(double length = 3.5, double width = 2.0, double bar = 1.5)
{
  return tube(4, 4, [=](int i, int j) {
    const double out = j == 0 || j == 3 ? bar : 0.0, up = j < 2 ? -0.5 : 0.5;
    const double sx = i == 0 || i == 3 ? 1.0 : -1.0, sy = i < 2 ? 1.0 : -1.0;
    return Vec3(sx * (length + out), sy * (width + out), up * bar);
  });
}

/// Octagonal ring of octagonal section: points of a torus of R = 5 and r = 0.7, with corners on the x axis.
inline Triangles octagon()
{
  constexpr double pi = 3.14159265358979323846;
  return tube(8, 8, [](int i, int j) {
    const double u = pi * i / 4.0, v = pi + pi * (j + 0.5) / 4.0, rho = 5.0 + 0.7 * std::cos(v);
    return Vec3(rho * std::cos(u), rho * std::sin(u), 0.7 * std::sin(v));
  });
}

/// Tube of radius r around the curve that goes once along a circle of radius R and `turns` times around it,
/// at a distance a.
inline Triangles coil(double R, double a, int turns, double r, int along)
{
  constexpr double pi = 3.14159265358979323846;
  const auto core = [=](double u) {
    const double rho = R + a * std::cos(turns * u);
    return Vec3(rho * std::cos(u), rho * std::sin(u), a * std::sin(turns * u));
  };
  constexpr int around = 5;
  return tube(along, around, [=](int i, int j) -> Vec3 {
    const double u = 2.0 * pi * i / along, v = 2.0 * pi * j / around;
    const Vec3 x = core(u), t = (core(u + 1e-5) - core(u - 1e-5)).normalized();
    const Vec3 n = (x - R * Vec3(std::cos(u), std::sin(u), 0.0)).cross(t).normalized();
    return x + r * (std::cos(v) * n + std::sin(v) * n.cross(t));
  });
}

inline Triangles tetrahedron()
{
  return {{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)},
          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

inline Triangles moved(Triangles t, const Vec3& by)
{
  for (Vec3& x : t.points) x += by;
  return t;
}

inline Triangles together(Triangles a, const Triangles& b)
{
  const auto shift = static_cast<int>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

/// One surface times the parameter `scale`.
class Solid final : public Shape {
 public:
  explicit Solid(const Triangles& triangles)
      : parameters_{{"scale", "1", 1.0, 1e-9, 1e9, "size", true}},
        surface_(std::make_shared<const TriangleSurface>(triangles.points, triangles.triangles))
  {
  }

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    Primitive solid;
    solid.name = "solid";
    solid.kind = PrimitiveKind::triangle_mesh;
    solid.size.fill(p[0] * surface_->mean_distance());
    solid.surface = surface_;
    out.push_back(std::move(solid));
  }
  void do_jacobians(std::span<const double> /*p*/, std::vector<PrimitiveJacobian>& out) const override
  {
    out.push_back({0.0, 0.0, 0.0, surface_->mean_distance(), 0.0, 0.0});
  }

 private:
  std::vector<ParameterInfo> parameters_;
  std::shared_ptr<const TriangleSurface> surface_;
};

}  // namespace hauberk::test
