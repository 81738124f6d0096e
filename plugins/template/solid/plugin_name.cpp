/// A ring of oval wire, by a chart and a field from which the kit makes a solid. (The kernel has this surface
/// built in, as torus_union with r0 = w and r1 = h: something to compare with while you change it.)

#include <hauberk/error.hpp>
#include <hauberk/kit/plugin_table.hpp>
#include <hauberk/kit/solid_shape.hpp>

#include <fmt/format.h>

namespace {

using namespace hauberk;
using kit::Point, kit::Turn, kit::square;

/// Sizes q: R from the axis z to the middle of the wire, half the wire's width w and half its height h. The
/// section is the ellipse ((rho - R)/w)^2 + (z/h)^2 = 1.
struct PluginName {
  static constexpr const char* kind = "plugin_name";
  static constexpr std::array size_names{"R", "w", "h"};
  static constexpr bool revolved = true;  // u turns the chart about z

  /// The whole surface over [0, 2 pi]^2, by cosine and sine of both coordinates.
  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    const S rho = q[0] + q[1] * v.c;
    return {rho * u.c, rho * u.s, q[2] * v.s};
  }

  /// Negative inside, zero on the surface; it need not be a distance.
  template <class S>
  static S field(const Point<S>& x, const S* q)
  {
    using kit::hypot;
    return square((hypot(x[0], x[1]) - q[0]) / q[1]) + square(x[2] / q[2]) - 1.0;
  }

  /// Closed polygons inside, by which links are counted: this one leaves the circle by R/800 at most.
  static std::vector<std::vector<Vec3>> cores(const double* q)
  {
    constexpr int corners = 64;
    std::vector<Vec3> core;
    for (int k = 0; k < corners; ++k) {
      const Turn<double> u = kit::turn(360.0 * degree * k / corners);
      core.emplace_back(q[0] * u.c, q[0] * u.s, 0.0);
    }
    return {core};
  }

  static std::vector<ParameterInfo> parameters()
  {
    return {{"R", "length", 5.0, 1e-12, 1e12, "radius of the ring, to the middle of its wire"},
            {"w", "length", 0.7, 1e-12, 1e12, "half the width of the wire, along the ring's radius"},
            {"h", "length", 0.5, 1e-12, 1e12, "half the height of the wire, along the ring's axis"}};
  }

  static void check(const double* q)
  {
    for (const int k : {1, 2})
      if (!(0.01 * q[0] < q[k] && q[k] < q[0]))
        throw InputError(fmt::format("parameter '{}' = {} must be between R/100 and R, and R is {}",
                                     size_names[k], q[k], q[0]));
  }
};

std::unique_ptr<Shape> make(const Node& /*section*/, Problems& /*problems*/)
{
  return std::make_unique<kit::SolidShape<PluginName>>("ring");
}

}  // namespace

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = hauberk::kit::shape_table(
    {"plugin_name", "0.1.0", "Rings of oval wire.", "your publication"}, hauberk::kit::no_fields, make);
