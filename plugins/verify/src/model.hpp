#pragma once
/// What the checker knows: plain copies of what the file says. Lengths in file units.

#include <hauberk/solid.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::verification {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// A number for each macroscopic unknown: three, of solids six.
using Macros = Eigen::VectorXd;
/// Which copy of the cell: multiples of its vectors; the third is 0 for sheets.
using Image = std::array<int, 3>;

/// The file lacks something or holds something of the wrong kind; the message names the place.
class Malformed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The file holds something that this check has no rule for, such as a load case of somebody else's plugin;
/// the message says what. Nothing is wrong with that, and nothing that depends on it can be checked.
class Unknown : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Place {
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
};

/// A closed surface of triangles, whose points have a mean distance of 1 from the origin.
struct Surface {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::vector<int>> loops;  ///< see homology_loops
  double reach = 0.0;                   ///< largest distance of a point from the origin
};

/// An ellipse with half-axes r0 (radial) and r1 (axial), revolved at distance R about its own z axis; or a
/// tube of radius r0 = r1 around a curve, the sum of c cos k u + s sin k u over k = 1, 2, ...;
/// or R times a surface of triangles, and then r0 = r1 is its thickness; or a plugin's solid of radius R, and
/// then r0 = r1 is how far its probe is from its surface, or its thickness where the probe is the surface.
struct Primitive {
  std::string name;
  Place place;  ///< in its element's frame, or in space
  double R = 0.0, r0 = 0.0, r1 = 0.0;
  std::vector<std::array<Vec3, 2>> curve{};  ///< (c, s) of each k; none: a torus
  std::shared_ptr<const Surface> surface{};  ///< null: a torus, or a tube around a curve
  std::shared_ptr<const Solid> solid{};      ///< null: none of a plugin
  std::string solid_kind{};                  ///< what the file calls it
  std::map<std::string, double> sizes{};     ///< of the solid, as the file has them
  int facets = 0;  ///< its surface is a mesh of facets x facets quadrilaterals; 0: the surface itself
};

/// A closed polygon inside of an element that follows several of its primitives.
struct Loop {
  std::vector<Vec3> corners;    ///< in its element's frame
  std::vector<int> primitives;  ///< ascending
};

struct Element {
  Place rest;
  std::map<std::string, double> parameters;
  std::vector<Primitive> tori;
  std::vector<Loop> loops;  ///< see loops_together
  /// Of a sphere about the element's origin that holds the element.
  double reach = 0.0;
};

struct Scene {
  std::vector<Element> elements;
  std::vector<Vec3> cell;  ///< two vectors of a sheet, three of a solid, one of a strip, none of a patch
  double length = 0.0;     ///< L
};

struct Contact {
  std::array<int, 2> elements{}, primitives{};
  Image image{};
  std::array<Vec3, 2> points;
  Vec3 normal = Vec3::Zero();
  double gap = 0.0, force = 0.0;
  std::string wall;
};

/// What moves elements together.
enum class Load {
  strain,      ///< in_plane_periodic: exx, eyy, exy
  paraboloid,  ///< paraboloid_bending: A, B, C
  roll,        ///< cylinder_roll: kxx, kyy, kxy
  strip,       ///< strip_roll: exx, k
  solid        ///< volumetric_periodic: exx, eyy, ezz, eyz, exz, exy
};

/// Of a sheet in space, whose value is a curvature.
inline bool is_bent(Load load)
{
  return load == Load::paraboloid || load == Load::roll || load == Load::strip;
}

/// Vectors that a scene's cell has under a load.
inline std::size_t cell_dimension(Load load)
{
  return load == Load::strain ? 2 : load == Load::solid ? 3 : load == Load::strip ? 1 : 0;
}

/// The macroscopic unknowns, in file units.
struct Macro {
  Macros values = Macros::Zero(3);
  Load load = Load::strain;

  /// F = I + [[exx, exy], [exy, eyy]] in the plane, I + the symmetric matrix of all six in space, or I + exx
  /// along x of a strip, which moves images; a patch has none.
  Mat3 deformation() const
  {
    Mat3 f = Mat3::Identity();
    if (load == Load::paraboloid || load == Load::roll) return f;
    f(0, 0) += values[0];
    if (load == Load::strip) return f;
    f(1, 1) += values[1];
    f(0, 1) = f(1, 0) = values[values.size() - 1];
    if (load == Load::strain) return f;
    f(2, 2) += values[2];
    f(1, 2) = f(2, 1) = values[3];
    f(0, 2) = f(2, 0) = values[4];
    return f;
  }
};

struct Start {
  double value = 0.0;
  Macro macro;
};

/// A state of all elements.
struct MovedState {
  Macro macro;
  std::vector<Place> places;
};

/// What a component that is held at zero takes: d value / d component.
struct Reaction {
  std::string name;
  double value = 0.0;
};

struct Limit {
  std::string label;  ///< "limits/3 (30 deg, stretch)"
  std::string where;  ///< its JSON pointer
  std::string load_case;
  double direction_deg = 0.0;  ///< not a number when the direction is one of components
  std::optional<Macros> direction;
  Load load = Load::strain;
  std::string sense, measure, status, contact;
  /// Whether listed forces stand for stretches of tube, so that they balance nothing exactly.
  bool is_of_resultants() const { return contact == "arc"; }
  std::optional<double> value, line_stretch, min_gap, force_balance, infimum, z_range;
  std::vector<std::string> hold;  ///< what is held, as the experiment names it
  std::vector<Reaction> reactions;
  /// T of the objective 1/2 |macro - T load|^2; none: the load is constant.
  std::optional<double> finite_target;
  std::optional<Macro> macro;
  bool links_kept = false;
  bool kink = false;  ///< contact forces are said not to be unique
  std::vector<Start> starts;
  std::vector<Place> poses;
  std::vector<Contact> contacts;
  std::vector<MovedState> witness;
};

/// Settings of the experiment that the checks depend on.
struct Setting {
  Load load = Load::strain;
  double clearance = 0.0;
  /// Half-height that elements keep to, of rolls about the rolled sheet; infinite when free.
  double half_height = std::numeric_limits<double>::infinity();
  int facets = 0;     ///< of contact mesh, else 0
  std::string where;  ///< of the experiment that it is from
  /// What a limit holds, and along which direction; see held_components.
  std::vector<std::string> hold{};
  double direction_deg = 0.0;

  /// Every element keeps its x and y.
  bool places() const { return std::find(hold.begin(), hold.end(), "places") != hold.end(); }
};

}  // namespace hauberk::verification
