#include "spline_tube.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

namespace hauberk {

SplineTube::SplineTube(std::vector<double> nodes) : reference_(carried_reference(nodes))
{
  constexpr double smallest = 1e-12, largest = 1e12;
  for (std::size_t k = 0; k < nodes.size(); k += 4) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      parameters_.push_back({fmt::format("p{}.{}", k / 4, "xyz"[axis]), "length", nodes[k + axis], -largest,
                             largest, "place of a node", true});
    parameters_.push_back(
        {fmt::format("p{}.r", k / 4), "length", nodes[k + 3], smallest, largest, "radius at it", true});
  }
}

void SplineTube::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  Primitive tube;
  tube.name = "tube";
  tube.kind = PrimitiveKind::solid;
  tube.solid = solids_.get(p, [&] {
    auto made = std::make_shared<const SplineSolid>(std::vector<double>(p.begin(), p.end()), reference_);
    if (const std::string problem = made->problem(); !problem.empty()) throw InputError(problem);
    return made;
  });
  out.assign(1, tube);
}

void SplineTube::do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const
{
  const std::size_t n = p.size();
  out.assign(1, PrimitiveJacobian((primitive_dofs + n) * n, 0.0));
  for (std::size_t k = 0; k < n; ++k) out[0][(primitive_dofs + k) * n + k] = 1.0;
}

}  // namespace hauberk
