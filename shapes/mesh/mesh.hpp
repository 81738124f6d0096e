#pragma once
/// An element of one closed surface of triangles.

#include "common/mesh_file.hpp"

#include <hauberk/section.hpp>
#include <hauberk/shape.hpp>
#include <hauberk/triangle_surface.hpp>

#include <memory>
#include <span>
#include <vector>

namespace hauberk {

/// The surface of a file times the parameter `scale`. The element's frame is that of the file; the primitive
/// sits in the middle of the surface's box.
class Mesh final : public Shape {
 public:
  /// Throws InputError where the triangles are no closed surface, see TriangleSurface.
  explicit Mesh(MeshFile file);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  std::vector<ParameterInfo> parameters_;
  Vec3 center_ = Vec3::Zero();  ///< in the file's unit
  std::shared_ptr<const TriangleSurface> surface_;
};

/// The fields of the shape's section of an experiment.
void mesh_fields(std::vector<Field>& out);

/// Builds the shape from a section checked against these fields.
std::unique_ptr<Shape> make_mesh(const Node& section, Problems& problems);

}  // namespace hauberk
