#pragma once
/// Interface for load cases: macroscopic unknowns, how they move elements, the load and the value reported.

#include <hauberk/direction.hpp>
#include <hauberk/linalg.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// Most coordinates of one element.
inline constexpr int max_coordinates = 3;

/// A macroscopic unknown. Lengths inside are scaled by the scene's characteristic length L.
struct MacroInfo {
  std::string name;
  int length_power = 0;  ///< value in file units = scaled value * L^length_power (strain 0, curvature -1)
};

/// Position of one element (or image) as a function of (macro, e), with derivatives.
struct PositionMap {
  static constexpr int n = max_macro + max_coordinates;
  Vec3 x = Vec3::Zero();
  /// dx/d(macro, e): column k < macro_count is macro k, column macro_count + k is element coordinate k.
  Eigen::Matrix<double, 3, n> J = Eigen::Matrix<double, 3, n>::Zero();
  /// Second derivatives of each component; left unset and not read unless `curved`.
  std::array<std::array<std::array<double, n>, n>, 3> H;
  bool curved = false;
};

/// A part of a linear condition on element coordinates.
struct LinearTerm {
  int element;
  int coordinate;
  double coefficient;
};

/// coefficient . element coordinates + offset >= 0, a contact with a wall (scaled length).
struct LinearInequality {
  using Term = LinearTerm;
  std::string name;
  std::vector<LinearTerm> terms;
  double offset = 0.0;
};

/// coefficient . element coordinates = 0: holds what would otherwise drift, like the place of a patch. It
/// holds at rest, and its reaction is no contact force.
struct LinearEquality {
  std::string name;
  std::vector<LinearTerm> terms;
};

/// A condition on the macroscopic unknowns that a limit keeps at its locked state: coefficients . macro = 0.
/// Its component X = coefficients . macro has the unit of the value, so that the reaction, d value / dX, has
/// none.
struct MacroCondition {
  std::string name;
  std::array<double, max_macro> coefficients{};  ///< the first macro_count() count
};

/// A state of a cell or patch as one asks whether it still is a sheet. Scaled lengths.
struct SheetState {
  std::span<const double> macro;
  std::span<const double> e;                   ///< coordinate_count() numbers for each element
  std::span<const Vec3> X;                     ///< rest positions
  std::span<const double> radius;              ///< of a sphere about an element's origin that holds it
  std::span<const std::array<int, 2>> linked;  ///< elements, each pair and image once
  /// Of each linked pair: the rest translation of the image that its second element is; zero in a patch.
  std::span<const Vec3> translations{};
};

/// Whether contact can stop the load, decided from the link graph alone.
enum class Boundedness { attained, unbounded, not_attained };

enum class Sense { positive, negative };  ///< stretch or up; compress or down

class LoadCase;

/// A load case that leaves elements less freedom than another one.
struct StricterLoadCase {
  std::string name;  ///< what it holds more, for people: "z fixed"
  std::unique_ptr<const LoadCase> load;
};

/// A family of loads on one cell or patch. Immutable after construction, so all calls are thread safe.
/// Angles are in radians; lengths are scaled by L. A load case knows angles; what a direction of components
/// means follows from its metric and is the same for all of them.
class LoadCase {
 public:
  virtual ~LoadCase() = default;

  const std::vector<MacroInfo>& macros() const { return do_macros(); }
  int macro_count() const { return static_cast<int>(do_macros().size()); }
  /// Free coordinates of an element besides its rotation (0 .. 3).
  int coordinate_count() const { return do_coordinate_count(); }
  /// Lattice vectors of the cell: 1 (a strip, along x), 2 (a sheet) or 3; 0 for patches.
  int lattice_vectors() const { return do_lattice_vectors(); }
  /// True if images of the cell exist (lattice vectors are needed).
  bool periodic() const { return lattice_vectors() > 0; }
  /// True if the value is how far a sheet is bent: its elements count while they form a sheet (not_a_sheet),
  /// and stay where the load case puts the sheet, while those of other lattices are known up to a
  /// translation. Of lattices those of one vector may bend; their images are displaced linearly in the
  /// unknowns.
  bool bends() const { return do_bends(); }

  /// Position of the element with rest position X, in the image displaced by the lattice translation T at
  /// rest (zero for the element itself). At macro = 0 and e = 0 this must be X + T.
  void position(std::span<const double> macro, std::span<const double> e, const Vec3& X, const Vec3& T,
                PositionMap& out) const;

  /// Upper bound of |d^2 x/ds^2| over s in [0, 1] on the path (macro + s dmacro, e + s de). Zero for
  /// load cases that are affine in (macro, e).
  double acceleration_bound(std::span<const double> macro, std::span<const double> dmacro,
                            std::span<const double> e, std::span<const double> de, const Vec3& X,
                            const Vec3& T) const
  {
    return do_acceleration_bound(macro, dmacro, e, de, X, T);
  }

  /// True where the macroscopic state is admissible (F positive definite). The set must be convex, so that
  /// a step is admissible when both its ends are.
  bool admissible(std::span<const double> macro) const { return do_admissible(macro); }

  /// Smallest and largest factor by which macro lengthens a lattice translation; outside 1e-3 .. 1e3:
  /// runaway.
  std::pair<double, double> stretch_range(std::span<const double> macro) const
  {
    return do_stretch_range(macro);
  }

  /// Load dual to the reported value: t = d value / d macro, for Sense::positive.
  ///
  /// An angle's load is the load case's own. Along components d the load is t_k = m_k d_k / |d|, with the
  /// metric m and |d|^2 = sum m_k d_k^2: the value is the inner product of macro with the unit vector along
  /// d. `t` has macro_count() entries. Throws PluginError when d has another number of components, or when
  /// its norm is not a positive number.
  void load(const Direction& direction, std::span<double> t) const;
  /// The reported value at macro: for components t . macro.
  double value(const Direction& direction, std::span<const double> macro) const;
  /// Name of the measure ("tensor", "normal_curvature"), reported with every value.
  std::string measure() const { return do_measure(); }
  /// The same for a direction: components have the measure "metric".
  std::string measure(const Direction& direction) const
  {
    return direction.is_angle() ? do_measure() : "metric";
  }
  /// Power of length of the value (0 strain, -1 curvature).
  int value_length_power() const { return do_value_length_power(); }
  /// Further values reported beside that of an angle, e.g. {"line_stretch", |F n| - 1}; none for components.
  std::vector<std::pair<std::string, double>> companions(const Direction& direction,
                                                         std::span<const double> macro) const;
  /// Names of all that a limit holds: conditions on macroscopic unknowns, which angles alone have, and what
  /// no motion changes (the places of elements).
  std::vector<std::string> hold(const Direction& direction) const;
  /// The conditions on the macroscopic unknowns among what is held, linearly independent. The path from rest
  /// may break them, the locked state keeps them. Rest keeps all of them (they are homogeneous). Throws
  /// PluginError when one is not finite or zero.
  std::vector<MacroCondition> conditions(const Direction& direction) const;
  /// Names of the senses in experiment files, positive first: {"stretch", "compress"}.
  std::pair<std::string, std::string> sense_names() const { return do_sense_names(); }
  /// Name of a sense of a direction. Components have one of their own, "along"; against them is "against".
  std::string sense_name(const Direction& direction, Sense sense) const;
  /// Whether components make sense: all unknowns have the unit of the value.
  bool takes_components() const;

  /// Weights of a frame-independent norm of the macro unknowns (1, 1, 2 for exx, eyy, exy). The kernel
  /// multiplies them by the squared displacement that a unit of such an unknown gives to elements: |X|^2 for
  /// a strain, |X|^4 for a curvature.
  void metric(std::span<double> m) const { do_metric(m); }

  /// The macroscopic unknowns of the state that the isometry with orthogonal part O makes of one with
  /// `macro`: `out` has macro_count() entries and depends linearly on `macro`. It means that position(out,
  /// e', O X, O T) = O position(macro, e, X, T) has a solution e' for all e, X, T, and that walls and what
  /// equalities hold are mapped to themselves. False: O is no symmetry of this load case, or none is known;
  /// `out` is then left undefined. The identity is always one. O may be improper (det O = -1).
  bool transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const;

  /// Load cases that leave less freedom, one step each: `contains` holds for every one of them, and two steps
  /// in either order make the same load case. Their locked states are where limits of this one begin once
  /// more. Empty where there is none, or none is known.
  std::vector<StricterLoadCase> stricter() const { return do_stricter(); }

  /// Whether every state that a limit of `other` may end in is one that the limit of this one at the same
  /// direction may, with the same macroscopic unknowns and the same value: this one holds no more, and moves
  /// elements the same way. False: it is not, or it is not known.
  bool contains(const LoadCase& other) const { return &other == this || do_contains(other); }

  /// Walls that act on element coordinates, for elements with rest positions X.
  std::vector<LinearInequality> inequalities(std::span<const Vec3> X) const { return do_inequalities(X); }

  /// Conditions that every motion keeps, for elements with rest positions X; linearly independent.
  std::vector<LinearEquality> equalities(std::span<const Vec3> X) const { return do_equalities(X); }

  /// Whether links alone bound load . macro for a load on the macroscopic unknowns, whatever it comes from;
  /// `cycles` are rest translations of independent link cycles.
  Boundedness boundedness(std::span<const double> load, std::span<const Vec3> cycles) const
  {
    return do_boundedness(load, cycles);
  }
  /// The same for a load along an angle, in one of its senses, under the conditions held there.
  Boundedness held_boundedness(double theta, std::span<const double> load, std::span<const Vec3> cycles) const
  {
    return do_held_boundedness(theta, load, cycles);
  }
  /// The same for a direction and sense, with what is held there.
  Boundedness boundedness(const Direction& direction, Sense sense, std::span<const Vec3> cycles) const;

  /// Why the elements of a state no longer form a sheet on the scale of one element: what is passed, where,
  /// and what is allowed, for people and without units. Empty where they form one. Such a state is no limit,
  /// and no path leads through it: a computation ends there.
  std::string not_a_sheet(const SheetState& state) const { return do_not_a_sheet(state); }

 protected:
  // What every load case gives.
  virtual const std::vector<MacroInfo>& do_macros() const = 0;
  virtual int do_coordinate_count() const = 0;
  virtual int do_lattice_vectors() const = 0;
  virtual void do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X,
                           const Vec3& T, PositionMap& out) const = 0;
  virtual void do_load(double theta, std::span<double> t) const = 0;

  // What follows from it, exactly where the comment says no more; the conformance kit checks every one.

  /// Load . macro, as the load does not depend on the state and rest has the value 0.
  virtual double do_value(double theta, std::span<const double> macro) const;
  /// "value".
  virtual std::string do_measure() const { return "value"; }
  /// That of the unknowns; throws PluginError where they differ.
  virtual int do_value_length_power() const;
  /// "positive" and "negative".
  virtual std::pair<std::string, std::string> do_sense_names() const { return {"positive", "negative"}; }
  /// Of lattices: the squared norm of d F / d macro, with F the map of lattice translations, position(T) -
  /// position(0); 1, 1, 2 for exx, eyy, exy. Of patches 1 each, which is a norm, but depends on the frame
  /// where an unknown is a mixed component.
  virtual void do_metric(std::span<double> m) const;
  /// Zero: right for positions that are affine in (macro, e).
  virtual double do_acceleration_bound(std::span<const double>, std::span<const double>,
                                       std::span<const double>, std::span<const double>, const Vec3&,
                                       const Vec3&) const
  {
    return 0.0;
  }
  /// Of lattices: the symmetric part of F is positive definite, a convex set that holds no state with a
  /// reflected or flat cell. Of patches: everything finite.
  virtual bool do_admissible(std::span<const double> macro) const;
  /// Of lattices: the singular values of F. Of patches 1 and 1: a load that nothing stops then ends where
  /// steps run out.
  virtual std::pair<double, double> do_stretch_range(std::span<const double> macro) const;
  /// Attained, which is the safe answer: the load is tried, and what leaves every bound is found so.
  virtual Boundedness do_boundedness(std::span<const double>, std::span<const Vec3>) const
  {
    return Boundedness::attained;
  }
  /// The load is that of the angle theta in one of its senses, and `do_conditions(theta)` hold. Attained,
  /// too.
  virtual Boundedness do_held_boundedness(double, std::span<const double>, std::span<const Vec3>) const
  {
    return Boundedness::attained;
  }

  /// Patches do, lattices do not.
  virtual bool do_bends() const { return !periodic(); }

  // What a load case may have beside. Without it there is none of it, or it is not known.
  virtual std::vector<std::pair<std::string, double>> do_companions(double, std::span<const double>) const
  {
    return {};
  }
  virtual bool do_transform(const Mat3&, std::span<const double>, std::span<double>) const { return false; }
  virtual std::vector<StricterLoadCase> do_stricter() const { return {}; }
  virtual bool do_contains(const LoadCase&) const { return false; }
  virtual std::vector<LinearInequality> do_inequalities(std::span<const Vec3>) const { return {}; }
  virtual std::vector<LinearEquality> do_equalities(std::span<const Vec3>) const { return {}; }
  virtual std::vector<std::string> do_hold() const { return {}; }
  virtual std::vector<MacroCondition> do_conditions(double) const { return {}; }
  virtual std::string do_not_a_sheet(const SheetState&) const { return {}; }
};

}  // namespace hauberk
