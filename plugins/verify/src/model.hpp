#pragma once
/// What the checker knows: plain copies of what the file says. Lengths in file units.

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::verification {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// The file lacks something or holds something of the wrong kind; the message names the place.
class Malformed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Place {
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
};

/// An ellipse with half-axes r0 (radial) and r1 (axial), revolved at distance R about its own z axis; or a
/// tube of radius r0 = r1 around a curve, the sum of c cos k u + s sin k u over k = 1, 2, ...
struct Torus {
  std::string name;
  Place place;  ///< in its element's frame, or in space
  double R = 0.0, r0 = 0.0, r1 = 0.0;
  std::vector<std::array<Vec3, 2>> curve{};  ///< (c, s) of each k; none: a torus
  int facets = 0;  ///< its surface is a mesh of facets x facets quadrilaterals; 0: the surface itself
};

struct Element {
  Place rest;
  std::vector<Torus> tori;
  /// Of a sphere about the element's origin that holds the element.
  double reach = 0.0;
};

struct Scene {
  std::vector<Element> elements;
  std::vector<Vec3> cell;  ///< two vectors, or none for a patch
  double length = 0.0;     ///< L
};

struct Contact {
  std::array<int, 2> elements{}, primitives{}, image{};
  std::array<Vec3, 2> points;
  Vec3 normal = Vec3::Zero();
  double gap = 0.0, force = 0.0;
  std::string wall;
};

/// What moves elements together.
enum class Load {
  strain,     ///< in_plane_periodic: exx, eyy, exy
  paraboloid  ///< paraboloid_bending: A, B, C
};

/// The macroscopic unknowns, in file units.
struct Macro {
  Vec3 values = Vec3::Zero();
  Load load = Load::strain;

  /// F = I + [[exx, exy], [exy, eyy]] in the plane, which moves images; a patch has none.
  Mat3 deformation() const
  {
    Mat3 f = Mat3::Identity();
    if (load == Load::paraboloid) return f;
    f(0, 0) += values[0];
    f(1, 1) += values[1];
    f(0, 1) = f(1, 0) = values[2];
    return f;
  }
};

struct Start {
  double value = 0.0;
  Macro macro;
};

struct Limit {
  std::string label;           ///< "limits/3 (30 deg, stretch)"
  double direction_deg = 0.0;  ///< not a number when the direction is one of components
  std::optional<Vec3> direction;
  Load load = Load::strain;
  std::string sense, measure, status, contact;
  std::optional<double> value, line_stretch, min_gap, force_balance;
  /// T of the objective 1/2 |macro - T load|^2; none: the load is constant.
  std::optional<double> finite_target;
  std::optional<Macro> macro;
  bool links_kept = false;
  std::vector<Start> starts;
  std::vector<Place> poses;
  std::vector<Contact> contacts;
};

/// Settings of the experiment that the checks depend on.
struct Setting {
  Load load = Load::strain;
  double clearance = 0.0;
  /// Half-height that elements keep to; infinite when free.
  double half_height = std::numeric_limits<double>::infinity();
  int facets = 0;  ///< of contact mesh, else 0
};

}  // namespace hauberk::verification
