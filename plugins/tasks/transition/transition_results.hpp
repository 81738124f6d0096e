#pragma once
/// What a transition experiment found: contact of two elements along a rigid motion of one of them, by
/// several formulations. Lengths are in the unit of the experiment.

#include <hauberk/linalg.hpp>

#include <boost/json/object.hpp>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// A local minimum of the distance at one sample.
struct TransitionMinimum {
  int contact = 0;                   ///< number along the path; the same contact keeps it
  std::array<int, 2> primitives{};   ///< of the fixed and of the moving element
  double distance = 0.0;             ///< of the surfaces
  std::optional<double> eigenvalue;  ///< published: of the squared gap's Hessian, squared length
  double relative_curvature = 0.0;   ///< smallest, times L
  Vec3 on_fixed = Vec3::Zero(), on_moving = Vec3::Zero();  ///< nearest points, in the frames of the elements
};

/// Contact energy and generalised force of one formulation at one sample, without the stiffness.
struct TransitionForce {
  double energy = 0.0;             ///< no unit
  std::array<double, 6> wrench{};  ///< on the moving element: force (1/length), torque about its origin
  double along = 0.0;              ///< component along the path, -dE/ds
};

struct TransitionSample {
  double s = 0.0;        ///< place on the path, 0 to 1
  double degrees = 0.0;  ///< rotation from rest
  double shift = 0.0;    ///< translation since s = 0
  std::vector<TransitionMinimum> minima;
  std::vector<TransitionForce> forces;  ///< by curve
};

/// Largest discontinuity of a quantity along a path, relative to its largest value there.
struct TransitionJump {
  double relative = 0.0;
  double at = 0.0;          ///< s, to the width of the last interval
  double resolution = 0.0;  ///< what a discontinuity elsewhere is smaller than, likewise relative
};

/// One formulation along one path.
struct TransitionCurve {
  std::string contact;      ///< as asked for: nearest, published, arc, auto
  std::string formulation;  ///< what it means at this activation distance
  double largest_energy = 0.0;
  double largest_force = 0.0;  ///< norm of (force times L, torque)
  TransitionJump energy, force;
  /// Arc only: largest error of energy and force by quadrature, relative to their largest values.
  std::optional<std::pair<double, double>> quadrature;
  int evaluations = 0;  ///< of energy, force and stiffness, in the search for discontinuities
};

struct TransitionPath {
  std::string name;
  std::string axis;  ///< what varies: "rotation (degrees)" or "translation (mm)"
  bool rotates = false;
  std::vector<TransitionSample> samples;
  std::vector<TransitionCurve> curves;
};

struct TransitionResult {
  double activation_distance = 0.0, range = 0.0, clearance = 0.0, length = 0.0;
  double eigenvalue_threshold = 0.0;  ///< published: below it a contact is faded
  std::string length_unit;
  std::string message;  ///< what could not be computed; empty: nothing
  std::vector<TransitionPath> paths;
};

/// The part `transition` of results.json; share/doc/results.md explains every field.
boost::json::object transition_json(const TransitionResult& result);

/// A row per path and sample: s, degrees, shift, number of minima, smallest distance and eigenvalues, then
/// energy, force along the path and wrench by formulation.
std::string transition_csv(const TransitionResult& result);

/// A row per path, sample and local minimum.
std::string transition_minima_csv(const TransitionResult& result);

/// A column per path with panels that share the axis: distances, published eigenvalues, relative curvatures,
/// energy, force along the path. Lines differ by dashes too. Same results, same bytes.
std::string transition_svg(const TransitionResult& result, const std::string& title);

}  // namespace hauberk
