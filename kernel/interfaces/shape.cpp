#include "geometry/closed_curve.hpp"

#include <hauberk/error.hpp>
#include <hauberk/shape.hpp>
#include <hauberk/solid.hpp>
#include <hauberk/triangle_surface.hpp>

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Largest deviation of a primitive's rotation from orthonormal; rounding of a few products stays far below.
constexpr double rotation_tolerance = 1e-9;

void check_parameters(const std::vector<ParameterInfo>& infos, std::span<const double> p)
{
  if (p.size() != infos.size()) {
    throw PluginError(fmt::format("shape: expected {} parameters, found {}", infos.size(), p.size()));
  }
  for (std::size_t k = 0; k < p.size(); ++k) {
    const ParameterInfo& info = infos[k];
    if (p[k] >= info.lower && p[k] <= info.upper) continue;  // false for not-a-number as well
    throw InputError(fmt::format("parameter '{}' = {:g} is outside [{:g}, {:g}]", info.name, p[k], info.lower,
                                 info.upper));
  }
}

/// Radius of a tube over the mean radius of its curve: links of thinner ones would take too long to count.
constexpr double thinnest = 1e-4;

std::string curve_defect(const Primitive& primitive)
{
  for (const Harmonic& h : primitive.curve) {
    if (!h.c.allFinite() || !h.s.allFinite()) return "has a harmonic that is not finite";
  }
  if (primitive.r0() != primitive.r1()) return "is a curve tube with two radii";
  if (!(primitive.r0() >= thinnest * primitive.R())) {
    return fmt::format("is a tube of radius {:g}, too thin for its curve, which takes {:g} and more",
                       primitive.r0(), thinnest * primitive.R());
  }
  const double bend = ClosedCurve(primitive.curve, 1.0).tightest_bend();
  if (!(bend > primitive.r0())) {
    return fmt::format("is a tube of radius {:g} around a curve that bends with a radius of {:g}",
                       primitive.r0(), bend);
  }
  return {};
}

/// Of a solid that states no thickness.
std::string too_sharp(const Primitive& primitive)
{
  const std::vector<std::string> names = primitive.solid->size_names();
  const std::vector<double>& sizes = primitive.solid->sizes();
  std::string text;
  for (std::size_t k = 0; k < std::min(names.size(), sizes.size()); ++k)
    text += fmt::format("{}'{}' = {:g}", k == 0 ? "" : ", ", names[k], sizes[k]);
  return fmt::format(
      "primitive '{}', of kind {} with {}, bends so sharply that no bound of its curvature was found; make it "
      "less thin or flat",
      primitive.name, primitive.solid->kind(), text);
}

/// Empty when the primitive is sound, else what is wrong with it.
std::string defect(const Primitive& primitive)
{
  // A number that is none of the enumerators would be taken for whatever a switch does by default.
  if (*name_of(primitive.kind) == '\0')
    return fmt::format("is of the unknown kind {}", static_cast<int>(primitive.kind));
  if (!primitive.position.allFinite()) return "has a position that is not finite";
  const Mat3& Q = primitive.rotation;
  // Negated so that not-a-number counts as a defect.
  if (!((Q * Q.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff() <= rotation_tolerance) ||
      !(Q.determinant() > 0.0)) {
    return "has axes that are no rotation";
  }
  if ((primitive.kind == PrimitiveKind::solid) != (primitive.solid != nullptr))
    return primitive.solid ? "has a solid, but is none" : "is a solid without one";
  for (const double s : primitive.size) {
    if (!std::isfinite(s) || s <= 0.0) return "has a size that is not finite and positive";
  }
  if ((primitive.kind == PrimitiveKind::curve_tube) == primitive.curve.empty())
    return primitive.curve.empty() ? "is a curve tube without harmonics"
                                   : "has harmonics, but is no curve tube";
  if ((primitive.kind == PrimitiveKind::triangle_mesh) != (primitive.surface != nullptr))
    return primitive.surface ? "has a surface of triangles, but is no triangle mesh"
                             : "is a triangle mesh without surface";
  if (primitive.kind == PrimitiveKind::curve_tube) return curve_defect(primitive);
  if (primitive.kind == PrimitiveKind::circle_tube && primitive.r0() != primitive.r1()) {
    return "is a circle tube with two radii";
  }
  return {};
}

}  // namespace

int geometric_dofs(const Primitive& primitive)
{
  const std::size_t further =
      primitive.solid ? primitive.solid->sizes().size() : harmonic_dofs * primitive.curve.size();
  return primitive_dofs + static_cast<int>(further);
}

std::vector<Primitive> Shape::primitives(std::span<const double> p) const
{
  check_parameters(do_parameters(), p);
  std::vector<Primitive> out;
  do_primitives(p, out);
  if (out.empty()) throw PluginError("shape: no primitives returned");
  for (Primitive& primitive : out) {
    if (!primitive.curve.empty()) primitive.size[0] = mean_radius(primitive.curve);
    if (primitive.surface)
      primitive.size[1] = primitive.size[2] = primitive.R() * primitive.surface->thickness();
    if (primitive.solid) {
      const double thickness = primitive.solid->thickness();
      if (thickness == 0.0) throw InputError(too_sharp(primitive));
      primitive.size = {primitive.solid->radius(), thickness, thickness};
    }
    const std::string what = defect(primitive);
    if (!what.empty()) throw PluginError("shape: primitive '" + primitive.name + "' " + what);
  }
  return out;
}

std::vector<PrimitiveJacobian> Shape::jacobians(std::span<const double> p) const
{
  check_parameters(do_parameters(), p);
  std::vector<PrimitiveJacobian> out;
  do_jacobians(p, out);
  if (out.empty()) throw PluginError("shape: no Jacobians returned");
  const std::vector<Primitive> shapes = primitives(p);
  if (out.size() != shapes.size()) {
    throw PluginError(
        fmt::format("shape: {} Jacobians returned for {} primitives", out.size(), shapes.size()));
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t without = static_cast<std::size_t>(geometric_dofs(shapes[i])) * p.size();
    const std::size_t with = without + rotation_dofs * p.size();
    const std::string which = fmt::format("shape: Jacobian of primitive {}", i);
    if (out[i].size() != without && out[i].size() != with) {
      throw PluginError(fmt::format("{} has {} entries, expected {}, or {} with those of its rotation", which,
                                    out[i].size(), without, with));
    }
    for (const double v : out[i]) {
      if (!std::isfinite(v)) throw PluginError(which + " is not finite");
    }
    out[i].resize(with, 0.0);
  }
  return out;
}

}  // namespace hauberk
