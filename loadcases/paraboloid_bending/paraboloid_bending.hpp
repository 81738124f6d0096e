#pragma once
/// A finite patch whose elements stay on a paraboloid, bent along a direction.

#include <hauberk/load_case.hpp>
#include <hauberk/section.hpp>

#include <memory>
#include <vector>

namespace hauberk {

/// Elements at (x, y, Z + A x^2 + B y^2 + C x y), (x, y) = (X + u_x, Y + u_y), apex at the origin.
///
/// Macroscopic unknowns are (A, B, C), 1/length; coordinates of an element u = (u_x, u_y). The value is the
/// normal curvature along n = (c, s) at the apex, 2 (A c^2 + B s^2 + C c s). Alone this would be unbounded:
/// the patch would slide to where the paraboloid is flat, or turn to its softest direction. So it keeps its
/// mean (x, y), and sum of X x (x - X) about z is zero.
///
/// With H = [[2 A, C], [C, 2 B]] and m = (-s, c), the twist n^T H m and the transverse curvature m^T H m may
/// be held at zero. With places held every (x, y) stays at rest (equation (14) of Tang et al. 2025): elements
/// have no coordinates but their rotation, and positions are affine in (A, B, C).
///
/// A paraboloid keeps no lengths: where no contact stops it, a patch turns into a hairpin, which is a state
/// of rings hung on each other and none of a fabric. So a state counts while it is a sheet on the scale of
/// its elements: the largest curvature times the largest radius of an element stays below
/// `most_sheet_curvature`, and linked elements stay nearer along the surface than `most_sheet_stretch` times
/// their distance at rest, or times the mean of their radii where that is longer.
class ParaboloidBending final : public LoadCase {
 public:
  struct Hold {
    bool places = false, twist = false, transverse = false;
  };

  explicit ParaboloidBending(Hold hold);

 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return hold_.places ? 0 : 2; }
  int do_lattice_vectors() const override { return 0; }
  void do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override;
  double do_acceleration_bound(std::span<const double> macro, std::span<const double> dmacro,
                               std::span<const double> e, std::span<const double> de, const Vec3& X,
                               const Vec3& T) const override;
  bool do_admissible(std::span<const double> macro) const override;
  std::pair<double, double> do_stretch_range(std::span<const double> macro) const override;
  void do_load(double theta, std::span<double> t) const override;
  double do_value(double theta, std::span<const double> macro) const override;
  std::string do_measure() const override { return "normal_curvature"; }
  int do_value_length_power() const override { return -1; }
  std::pair<std::string, std::string> do_sense_names() const override { return {"up", "down"}; }
  void do_metric(std::span<double> m) const override;
  bool do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const override;
  std::vector<LinearEquality> do_equalities(std::span<const Vec3> X) const override;
  Boundedness do_boundedness(std::span<const double> load, std::span<const Vec3> cycles) const override;
  std::vector<std::string> do_hold() const override;
  std::vector<MacroCondition> do_conditions(double theta) const override;
  std::string do_not_a_sheet(const SheetState& state) const override;
  bool do_contains(const LoadCase& other) const override;

 private:
  Hold hold_;
  std::vector<MacroInfo> macros_;
};

/// The fields of the load case's own settings.
void paraboloid_bending_fields(std::vector<Field>& out);

/// Builds the load case; `length` is L in file units.
std::unique_ptr<LoadCase> make_paraboloid_bending(const Node& section, double length, Problems& problems);

}  // namespace hauberk
