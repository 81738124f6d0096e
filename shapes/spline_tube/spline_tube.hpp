#pragma once
/// Closed tubes around a spline through nodes, with a radius that varies along it.

#include "spline_solid.hpp"

#include <hauberk/kit/lazy.hpp>
#include <hauberk/section.hpp>
#include <hauberk/shape.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// One solid. Parameters p0.x, p0.y, p0.z, p0.r, p1.x, ...: place and radius at each node, those of the
/// section without values of their own.
class SplineTube final : public Shape {
 public:
  /// x, y, z and r of at least three nodes.
  explicit SplineTube(std::vector<double> nodes);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  /// Throws InputError where the balls have no smooth surface, with the nodes where that is.
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  std::vector<ParameterInfo> parameters_;
  std::shared_ptr<const PeriodicSpline<3>> reference_;
  kit::KeptSolids<SplineSolid> solids_;
};

/// The fields of the shape's section of an experiment.
void spline_tube_fields(std::vector<Field>& out);

/// Builds the shape from a section checked against these fields.
std::unique_ptr<Shape> make_spline_tube(const Node& section, Problems& problems);

}  // namespace hauberk
