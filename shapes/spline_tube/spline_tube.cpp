#include "spline_tube.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>

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

std::shared_ptr<const SplineSolid> SplineTube::solid(std::span<const double> sizes) const
{
  constexpr std::size_t most = 64;
  const std::lock_guard lock(mutex_);
  for (const auto& known : made_)
    if (std::ranges::equal(known->sizes(), sizes)) return known;
  auto made =
      std::make_shared<const SplineSolid>(std::vector<double>(sizes.begin(), sizes.end()), reference_);
  if (const std::string problem = made->problem(); !problem.empty()) throw InputError(problem);
  made_.push_front(std::move(made));
  if (made_.size() > most) made_.pop_back();
  return made_.front();
}

void SplineTube::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  Primitive tube;
  tube.name = "tube";
  tube.kind = PrimitiveKind::solid;
  tube.solid = solid(p);
  out.assign(1, tube);
}

void SplineTube::do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const
{
  const std::size_t n = p.size();
  out.assign(1, PrimitiveJacobian((primitive_dofs + n) * n, 0.0));
  for (std::size_t k = 0; k < n; ++k) out[0][(primitive_dofs + k) * n + k] = 1.0;
}

}  // namespace hauberk
