#pragma once
/// A finite patch that is rolled onto a cylinder, whose axis is across the direction of loading.

#include <hauberk/load_case.hpp>
#include <hauberk/section.hpp>

#include <memory>
#include <vector>

namespace hauberk {

/// Elements on a sheet that rolls up without stretching along lines through its middle.
///
/// Macroscopic unknowns are the components kxx, kyy, kxy of a symmetric tensor K, the curvature of the sheet
/// at the origin, which is below the mean of a patch. The point y of the flat sheet goes to where a walk of
/// length |y| ends that leaves the origin along y and turns about the constant axis w = (K y)_y e_x - (K y)_x
/// e_y by |w| on its whole way: with R(w) the rotation by |w| about w,
///
///     x(y, z) = integral over s in [0, 1] of R(s w) y + z R(w) e_z.
///
/// For K = kappa n n^T that is the roll of curvature kappa along n, exactly: with y = s n + t m it is
/// (sin(kappa s)/kappa, t, (1 - cos(kappa s))/kappa) along (n, m, e_z), whatever the size of kappa s. (For K
/// = kappa I it is the sphere.) All is entire in K, so that rest is a point as any other. With k = K y, p = y
/// . K y, q = |k|^2 and c_j(q) = 1/j! - q/(j + 2)! + q^2/(j + 4)! - ... Rodrigues' formula and its integral
/// give
///
///     x = (y - (c_3 p + c_1 z) k,  c_2 p + c_0 z).
///
/// Coordinates of an element are displacements along the sheet, in y, and along its normal, in z: to first
/// order those in the sheet's own frame (tangent, axis, normal), and elements stay on the sheet, or at their
/// distance from it, however far they slide.
///
/// Along the angle theta, with n = (cos theta, sin theta) and m across it, the value is n^T K n. A limit may
/// hold the twist n^T K m and the transverse curvature m^T K m at zero; with both it ends on a roll, and the
/// value is one over its radius.
class CylinderRoll final : public LoadCase {
 public:
  /// What is zero at a limit. Places hold along components, too, and elements have no coordinates along the
  /// sheet then; the others hold along angles only.
  struct Hold {
    bool places = false, twist = true, transverse = true;
  };

  /// `lifts`: elements may leave the sheet along its normal.
  CylinderRoll(Hold hold, bool lifts);

 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return lift() + (lifts_ ? 1 : 0); }
  int do_lattice_vectors() const override { return 0; }
  void do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override;
  double do_acceleration_bound(std::span<const double> macro, std::span<const double> dmacro,
                               std::span<const double> e, std::span<const double> de, const Vec3& X,
                               const Vec3& T) const override;
  void do_load(double theta, std::span<double> t) const override;
  std::string do_measure() const override { return "roll_curvature"; }
  std::pair<std::string, std::string> do_sense_names() const override { return {"up", "down"}; }
  void do_metric(std::span<double> m) const override;
  bool do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const override;
  std::vector<LinearEquality> do_equalities(std::span<const Vec3> X) const override;
  std::vector<std::string> do_hold() const override;
  std::vector<MacroCondition> do_conditions(double theta) const override;
  std::vector<StricterLoadCase> do_stricter() const override;
  bool do_contains(const LoadCase& other) const override;
  std::string do_not_a_sheet(const SheetState& state) const override;

 private:
  /// Coordinates along the sheet, after which comes the one along its normal.
  int lift() const { return hold_.places ? 0 : 2; }
  /// The place (y, z) on the sheet of an element with rest position X; `e` are its coordinates, or rates of
  /// them, which have X = 0.
  Vec3 on_sheet(std::span<const double> e, const Vec3& X) const;

  Hold hold_;
  bool lifts_;
  std::vector<MacroInfo> macros_;
};

/// The fields of the load case's own settings.
void cylinder_roll_fields(std::vector<Field>& out);

/// Builds the load case; `length` is L in file units.
std::unique_ptr<LoadCase> make_cylinder_roll(const Node& section, double length, Problems& problems);

}  // namespace hauberk
