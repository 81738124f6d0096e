#pragma once
/// A strip that repeats along x without end, rolled onto a cylinder whose axis is along x.

#include <hauberk/load_case.hpp>
#include <hauberk/section.hpp>

#include <memory>
#include <vector>

namespace hauberk {

/// Elements on a sheet that rolls up across its length and is strained along it.
///
/// Macroscopic unknowns are exx, the strain along the axis, and k, the curvature around it. The element with
/// rest position (X, Y, Z) in the image displaced by (T, 0, 0) has the place s = Y + u_y, z = Z + u_z on the
/// flat sheet, and is at
///
///     x = (1 + exx) (X + T) + u_x,
///     y = sin(k s)/k - z sin(k s),
///     h = (1 - cos(k s))/k + z cos(k s).
///
/// With q = (k s)^2 and c_j(q) = 1/j! - q/(j + 2)! + q^2/(j + 4)! - ... that is y = (s - k s z) c_1, h = k
/// s^2 c_2
/// + z c_0, entire in k, so that rest is a point as any other, and the same as cylinder_roll's for K = k e_y
/// e_y^T. Coordinates of an element are displacements along the axis, around it and along the sheet's normal.
///
/// The value is the curvature along the angle theta of the flat sheet, k sin^2 theta: at 90 degrees, around
/// the axis, one over the radius of the roll. Elements stay on the sheet, or may leave it along its normal,
/// which is fitted to them then.
class StripRoll final : public LoadCase {
 public:
  /// `places`: no element moves along the sheet. `lifts`: elements may leave it along its normal.
  StripRoll(bool places, bool lifts);

 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return lift() + (lifts_ ? 1 : 0); }
  int do_lattice_vectors() const override { return 1; }
  bool do_bends() const override { return true; }
  void do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override;
  double do_acceleration_bound(std::span<const double> macro, std::span<const double> dmacro,
                               std::span<const double> e, std::span<const double> de, const Vec3& X,
                               const Vec3& T) const override;
  void do_load(double theta, std::span<double> t) const override;
  int do_value_length_power() const override { return -1; }
  std::string do_measure() const override { return "roll_curvature"; }
  std::pair<std::string, std::string> do_sense_names() const override { return {"up", "down"}; }
  void do_metric(std::span<double> m) const override;
  bool do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const override;
  std::vector<LinearEquality> do_equalities(std::span<const Vec3> X) const override;
  std::vector<std::string> do_hold() const override;
  std::vector<StricterLoadCase> do_stricter() const override;
  bool do_contains(const LoadCase& other) const override;
  std::string do_not_a_sheet(const SheetState& state) const override;

 private:
  /// Coordinates along the sheet, after which comes the one along its normal.
  int lift() const { return places_ ? 0 : 2; }
  /// (u_x, s, z) of an element with rest position X; `e` are its coordinates, or rates of them, which have X
  /// = 0. The first is the displacement alone.
  Vec3 on_sheet(std::span<const double> e, const Vec3& X) const;

  bool places_, lifts_;
  std::vector<MacroInfo> macros_;
};

/// The fields of the load case's own settings.
void strip_roll_fields(std::vector<Field>& out);

/// Builds the load case; `length` is L in file units.
std::unique_ptr<LoadCase> make_strip_roll(const Node& section, double length, Problems& problems);

}  // namespace hauberk
