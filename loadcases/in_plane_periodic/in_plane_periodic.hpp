#pragma once
/// Periodic sheet under a macroscopic in-plane strain, stretched or compressed along a direction.

#include <hauberk/load_case.hpp>
#include <hauberk/section.hpp>

#include <array>
#include <memory>
#include <vector>

namespace hauberk {

/// The reported value of a strain eps along n = (c, s).
enum class StrainMeasure {
  tensor,  ///< n^T eps n = exx c^2 + eyy s^2 + 2 exy c s
  /// (d . eps)/(d . d), d = (c^2, s^2, c s): what equation (12) of Tang et al. 2025 says when it is read
  /// literally, a target that only the strain along d counts for
  equation_12,
};
inline constexpr std::array strain_measures{StrainMeasure::tensor, StrainMeasure::equation_12};

/// Its name in experiment files and results.
inline const char* name_of(StrainMeasure measure)
{
  switch (measure) {
    case StrainMeasure::tensor:
      return "tensor";
    case StrainMeasure::equation_12:
      return "equation_12";
  }
  return "";
}

/// Elements at x = F (X + T) + u with F = I + [[exx, exy], [exy, eyy]] in the plane (z untouched).
///
/// Macroscopic unknowns are (exx, eyy, exy), coordinates of an element u = (ux, uy), and uz where elements
/// may leave the plane. Along an angle, with n = (c, s) and m = (-s, c), the shear n^T eps m and the lateral
/// strain m^T eps m may be held; what is not held is free.
class InPlanePeriodic final : public LoadCase {
 public:
  /// How far elements may leave their height at rest, after removing the mean.
  struct OutOfPlane {
    bool free = false;
    double half_height = 0.0;  ///< when not free; 0 fixes z; scaled by L
  };

  /// Which strains are zero at the locked state of an angle.
  struct Hold {
    bool shear = true;     ///< n^T eps m: principal axes stay at the load direction
    bool lateral = false;  ///< m^T eps m: the sheet cannot narrow
  };

  InPlanePeriodic(StrainMeasure measure, OutOfPlane out_of_plane, Hold hold);

 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override;
  int do_lattice_vectors() const override { return 2; }
  void do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override;
  bool do_admissible(std::span<const double> macro) const override;
  std::pair<double, double> do_stretch_range(std::span<const double> macro) const override;
  void do_load(double theta, std::span<double> t) const override;
  double do_value(double theta, std::span<const double> macro) const override;
  std::string do_measure() const override;
  int do_value_length_power() const override { return 0; }
  std::vector<std::pair<std::string, double>> do_companions(double theta,
                                                            std::span<const double> macro) const override;
  std::pair<std::string, std::string> do_sense_names() const override { return {"stretch", "compress"}; }
  void do_metric(std::span<double> m) const override;
  bool do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const override;
  std::vector<LinearInequality> do_inequalities(std::span<const Vec3> X) const override;
  Boundedness do_boundedness(std::span<const double> load, std::span<const Vec3> cycles) const override;
  std::vector<std::string> do_hold() const override;
  std::vector<MacroCondition> do_conditions(double theta) const override;
  Boundedness do_held_boundedness(double theta, std::span<const double> load,
                                  std::span<const Vec3> cycles) const override;
  std::vector<StricterLoadCase> do_stricter() const override;
  bool do_contains(const LoadCase& other) const override;

 private:
  std::vector<MacroInfo> macros_;
  StrainMeasure measure_;
  OutOfPlane out_of_plane_;
  Hold hold_;
};

/// The fields of the load case's own settings.
void in_plane_periodic_fields(std::vector<Field>& out);

/// Builds the load case from a section checked against these fields; `length` is L in file units.
std::unique_ptr<LoadCase> make_in_plane_periodic(const Node& section, double length, Problems& problems);

}  // namespace hauberk
