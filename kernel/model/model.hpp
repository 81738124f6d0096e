#pragma once
/// The model: a scene in scaled lengths under one load case, and states of it.

#include "geometry/spine.hpp"
#include "model/scene.hpp"

#include <hauberk/load_case.hpp>

#include <Eigen/Dense>

#include <span>

namespace hauberk {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Integer combination of lattice vectors; the third index is 0 where there are two of them.
using Image = std::array<int, 3>;

/// A pair of linked cycles: A of the cell, B of the cell's image `image`.
struct Link {
  int a = 0, b = 0;  ///< bodies; from Model::bodies.size() on, loops of several (Model::loop)
  Image image{};
  int number = 0;  ///< see linking_number and linking_numbers
};

/// Immutable description of what is simulated; lengths scaled by `length`. Thread safe to read.
struct Model {
  double length = 1.0;     ///< L in file units
  double clearance = 0.0;  ///< scaled
  const LoadCase* load = nullptr;
  std::vector<Body> bodies;
  std::vector<int> first_body;  ///< per element, and one past the end
  std::vector<double> reach;    ///< per element: radius about its origin that holds it
  std::vector<Pose> rest;
  std::vector<int> source;  ///< per element: the one that it is a copy of; itself where copies differ in size
  std::vector<Vec3> lattice;
  std::vector<LinearInequality> walls;
  Matrix held;  ///< dofs x equalities: orthonormal directions that no motion has
  /// Per element; none where no element has a loop that several of its primitives form together.
  std::vector<std::shared_ptr<const Spine>> spines;
  std::vector<int> first_loop;  ///< per element, and one past the end, where there are spines
  std::vector<Link> links;      ///< at rest
  /// Elements of what bends with links between them, ascending, and the rest translation of the image that
  /// the second is.
  std::vector<std::array<int, 2>> linked;
  std::vector<Vec3> linked_translations;
  /// Per body: d(position, R, r0, r1, harmonics, rotation)/d(element parameters), row-major, file units; see
  /// PrimitiveJacobian.
  std::vector<PrimitiveJacobian> jacobians;
  std::vector<int> parameter_count;  ///< per element

  int macro_count = 0, coordinate_count = 0;
  Vector metric;  ///< squared displacement per squared unknown: weights of the norm of a step
  /// G of the squared size macro . G macro that the published objective takes; empty: the identity.
  Matrix macro_square;

  /// d (scaled position, R, r0, r1, harmonics of a body, and its turn; quantity 0, 1, ...) / d parameter of
  /// its element (file units).
  double geometry_derivative(std::size_t body, int quantity, int parameter) const
  {
    const std::size_t n = parameter_count[bodies[body].element];
    const std::size_t entry = quantity * n + parameter;
    const PrimitiveJacobian& J = jacobians[body];
    const bool turn = entry + rotation_dofs * n >= J.size();  // an angle, which no length scales
    return turn ? J[entry] : J[entry] / length;
  }
  /// What 1 of the scaled value, of a scaled macroscopic unknown, is in file units: L to their length powers.
  double value_unit() const;
  double macro_unit(int k) const;
  int element_count() const { return static_cast<int>(rest.size()); }
  int element_dofs() const { return coordinate_count + 3; }
  int dofs() const { return macro_count + element_count() * element_dofs(); }
  /// Its Hessian is stored sparse: it has more unknowns than pay for a dense one. What is held couples all
  /// elements, and is left to whoever solves with it.
  bool sparse() const;
  int offset(int element) const { return macro_count + element * element_dofs(); }
  Vec3 translation(const Image& image) const
  {
    Vec3 t = Vec3::Zero();
    for (std::size_t k = 0; k < lattice.size(); ++k) t += image[k] * lattice[k];
    return t;
  }
};

/// The indices of an image for people: two, or three where the third is not 0.
std::vector<int> shown(const Image& image);

/// Derivatives in the parameters of a body's element from those in its scaled geometric quantities and its
/// turn, in the order of `geometry_derivative`.
Vector parameter_gradient(const Model& m, int body, const std::vector<double>& geometry);

/// Unknowns: macro, element coordinates, rotations.
struct State {
  Vector macro;
  Vector e;                    ///< coordinate_count per element
  std::vector<Mat3> rotation;  ///< per element

  /// The macroscopic unknowns as load cases take them; refers to this state.
  std::span<const double> macro_values() const
  {
    return {macro.data(), static_cast<std::size_t>(macro.size())};
  }
};

/// Builds the model and finds its links. Throws InputError when a primitive is bad or the cell far too small.
Model make_model(const SceneSpec& spec, const LoadCase& load, double clearance_in_file_units);

/// Rest: macro = 0, e = 0, rest rotations.
State rest_state(const Model& model);

/// Poses of elements (image (0,0)) in a state.
std::vector<Pose> poses(const Model& model, const State& state);

/// Pose of one element's image.
Pose image_pose(const Model& model, const State& state, int element, const Image& image);

/// state advanced by alpha dy; rotations by exp(alpha w).
State advanced(const Model& model, const State& state, const Vector& dy, double alpha);

/// dy with advanced(from, dy, 1) = to.
Vector difference(const Model& model, const State& from, const State& to);

/// The part of a step, or of a gradient, that the load case's equalities leave: x - held held^T x. (Element
/// coordinates have the metric 1, so that one projection serves both.)
Vector free_part(const Model& model, const Vector& x);

/// Norm of a step: root of the metric-weighted sum of squares.
double step_norm(const Model& model, const Vector& dy);

/// Largest displacement that any surface point of any element makes to first order, without the macroscopic
/// part.
double largest_motion(const Model& model, const Vector& dy);

/// Why a state is no sheet on the scale of its elements (LoadCase::not_a_sheet); empty where it is one.
std::string not_a_sheet(const Model& model, const State& state);

}  // namespace hauberk
