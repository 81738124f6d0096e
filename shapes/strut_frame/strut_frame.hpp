#pragma once
/// Cages of straight struts with round ends: one body for every edge of a graph in space.

#include <hauberk/section.hpp>
#include <hauberk/shape.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// Nodes and the struts between them, by index.
struct Graph {
  std::vector<Vec3> nodes;
  std::vector<std::array<int, 2>> struts;
};

/// The edges of a polyhedron with edges of length 1 about the origin, by its name.
struct Polyhedron {
  const char* name;
  const char* about;
  Graph (*graph)();
};
std::span<const Polyhedron> polyhedra();

/// Lines (`l`) and outlines of faces (`f`) of a Wavefront OBJ file, each edge once. Throws InputError with
/// the line.
Graph read_obj_lines(const std::string& path);

/// Struts of one radius between the nodes of a graph times `size`. Parameters: size, r.
class StrutFrame final : public Shape {
 public:
  /// Throws InputError where a strut has no length, a node is missing, or two struts are one.
  explicit StrutFrame(Graph graph);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  /// A strut of the graph: its middle, half its length, and axes of which the last one is along it.
  struct Strut {
    Vec3 middle;
    double half = 0.0;
    Mat3 axes;
  };
  std::vector<ParameterInfo> parameters_;
  std::vector<Strut> struts_;
};

/// The fields of the shape's section of an experiment.
void strut_frame_fields(std::vector<Field>& out);

/// Builds the shape from a section checked against these fields.
std::unique_ptr<Shape> make_strut_frame(const Node& section, Problems& problems);

}  // namespace hauberk
