#include <hauberk/error.hpp>
#include <hauberk/shape.hpp>

#include <Eigen/LU>
#include <cmath>
#include <sstream>

namespace hauberk {
namespace {

/// Largest deviation of a primitive's rotation from orthonormal; rounding of a few products stays far below.
constexpr double rotation_tolerance = 1e-9;

void check_parameters(const std::vector<ParameterInfo>& infos, std::span<const double> p)
{
  if (p.size() != infos.size()) {
    throw PluginError("shape: expected " + std::to_string(infos.size()) + " parameters, found " +
                      std::to_string(p.size()));
  }
  for (std::size_t k = 0; k < p.size(); ++k) {
    const ParameterInfo& info = infos[k];
    if (p[k] >= info.lower && p[k] <= info.upper) continue;  // false for not-a-number as well
    std::ostringstream message;
    message << "parameter '" << info.name << "' = " << p[k] << " is outside [" << info.lower << ", "
            << info.upper << "]";
    throw InputError(message.str());
  }
}

/// Empty when the primitive is sound, else what is wrong with it.
std::string defect(const Primitive& primitive)
{
  if (!primitive.position.allFinite()) return "has a position that is not finite";
  const Mat3& Q = primitive.rotation;
  // Negated so that not-a-number counts as a defect.
  if (!((Q * Q.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff() <= rotation_tolerance) ||
      !(Q.determinant() > 0.0)) {
    return "has axes that are no rotation";
  }
  for (const double s : primitive.size) {
    if (!std::isfinite(s) || s <= 0.0) return "has a size that is not finite and positive";
  }
  if (primitive.kind == PrimitiveKind::circle_tube && primitive.r0() != primitive.r1()) {
    return "is a circle tube with two radii";
  }
  return {};
}

}  // namespace

std::vector<Primitive> Shape::primitives(std::span<const double> p) const
{
  check_parameters(do_parameters(), p);
  std::vector<Primitive> out;
  do_primitives(p, out);
  if (out.empty()) throw PluginError("shape: no primitives returned");
  for (const Primitive& primitive : out) {
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
  const std::size_t expected = primitive_dofs * p.size();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::string which = "shape: Jacobian of primitive " + std::to_string(i);
    if (out[i].size() != expected) {
      throw PluginError(which + " has " + std::to_string(out[i].size()) + " entries, expected " +
                        std::to_string(expected));
    }
    for (const double v : out[i]) {
      if (!std::isfinite(v)) throw PluginError(which + " is not finite");
    }
  }
  return out;
}

}  // namespace hauberk
