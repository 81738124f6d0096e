#include "turned.hpp"

#include <utility>

namespace hauberk::test {

Turned::Turned(std::vector<Primitive> primitives) : primitives_(std::move(primitives))
{
  for (const Primitive& primitive : primitives_)
    for (const char* component : {".wx", ".wy", ".wz"})
      parameters_.push_back({primitive.name + component, "1", 0.0, -3.0, 3.0, "radians", true});
}

void Turned::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  out = primitives_;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Mat3 A = rotation_exp({p[3 * k], p[3 * k + 1], p[3 * k + 2]});
    out[k].position = A * out[k].position;
    out[k].rotation = A * out[k].rotation;
  }
}

void Turned::do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const
{
  std::vector<Primitive> here;
  do_primitives(p, here);
  out.clear();
  for (std::size_t k = 0; k < here.size(); ++k) {
    const Mat3 turns = rotation_exp_jacobian({p[3 * k], p[3 * k + 1], p[3 * k + 2]});
    const std::size_t first = geometric_dofs(here[k]);
    PrimitiveJacobian J((first + rotation_dofs) * p.size(), 0.0);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Vec3 omega = turns.col(i), moved = omega.cross(here[k].position);
      for (std::size_t row = 0; row < 3; ++row) {
        J[row * p.size() + 3 * k + static_cast<std::size_t>(i)] = moved[row];
        J[(first + row) * p.size() + 3 * k + static_cast<std::size_t>(i)] = omega[row];
      }
    }
    out.push_back(std::move(J));
  }
}

}  // namespace hauberk::test
